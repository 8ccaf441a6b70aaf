# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Many task wrenches on one grasp at once: maps, surfaces, corners.

The kernel solves them on all cores; the proof is that of ``proof``, for all of them in a few array
operations. Whatever misses it is solved again by itself, by whichever solver proves it. The cores
are shared by Python threads around compiled code that releases the lock: unlike numba's own
parallel loops these may be used from several threads and in forked processes.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import os

from grasp_quality import kernel, proof
from grasp_quality.friction_cone import usage_of_shares
from grasp_quality.problem import build_problem, NO_WRENCH
from grasp_quality.solve import solve
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import TimeLimit
from grasp_quality.wrench import as_wrench
import numpy as np

BETWEEN_LOOKS = 256  # wrenches that a core solves between two looks at the time limit
SMALL = 128  # wrenches that are not worth a thread


@dataclass(frozen=True, eq=False)
class Batch:
    """
    Answers to many task wrenches.

    Attributes
    ----------
    alpha : (N,) array
        0 where infeasible.
    feasible : (N,) bool array
    forces : (N, k, 4) array [N, N, N, N m]
        Zero where infeasible.
    handed_over : int
        How many the kernel could not prove.

    """

    alpha: np.ndarray
    feasible: np.ndarray
    forces: np.ndarray
    handed_over: int


def solve_wrenches(grasp, wrenches, external_wrench=None, time_limit_s=None):
    """
    Find the largest alpha of every task wrench.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    wrenches : (N, 6) array [N, N m]
        None of them zero.
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object, about the object frame's origin; zero if None.
    time_limit_s : float, optional
        Of all of them together [s].

    Returns
    -------
    Batch

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    limit = TimeLimit.of(time_limit_s)
    load = NO_WRENCH if external_wrench is None else as_wrench(external_wrench, 'external wrench')
    count, k = len(wrenches), len(grasp)
    if grasp.bound == 'l2' or grasp.joint_limits is not None or not count:
        alpha, forces, proved = np.zeros(count), np.zeros((count, k, 4)), np.zeros(count, bool)
    else:
        alpha, forces, proved = _by_kernel(grasp, wrenches, load, limit)
    feasible = proved.copy()
    for i in np.flatnonzero(~proved):
        solution = solve(build_problem(grasp, TaskWrench(wrenches[i]), load), limit)
        alpha[i], feasible[i] = solution.alpha, solution.feasible
        forces[i] = solution.forces if solution.feasible else 0.0
    return Batch(alpha, feasible, forces, int(count - proved.sum()))


def _by_kernel(grasp, wrenches, load, limit):
    """Alpha (N,), forces (N, k, 4) and which of them are proved (N,)."""
    scaled = grasp.scaled_wrench(wrenches)
    size = np.sqrt((scaled * scaled).sum(axis=1))
    tasks, load = scaled / size[:, None], grasp.scaled_wrench(load)
    count, k = len(tasks), len(grasp)
    G, curvature, groups = grasp.blocks
    reach = grasp.cap_total
    alpha, shares = np.empty(count), np.empty((count, k, 4))
    multipliers, converged = np.empty((count, 6)), np.empty(count, bool)
    cores = len(os.sched_getaffinity(0)) if count > SMALL else 1
    ends = np.linspace(0, count, cores + 1).astype(int)
    parts = [slice(begin, end) for begin, end in zip(ends[:-1], ends[1:])]

    def solve_part(part):
        for begin in range(part.start, part.stop, BETWEEN_LOOKS):
            rows = slice(begin, min(begin + BETWEEN_LOOKS, part.stop))
            kernel.solve_wrenches(
                G, curvature, groups, max(grasp.groups) + 1, tasks[rows], load, reach,
                alpha[rows], shares[rows], multipliers[rows], converged[rows])
            if limit is not None:
                limit.remaining_s()

    if cores == 1:
        solve_part(parts[0])
    else:
        with ThreadPoolExecutor(cores) as pool:
            list(pool.map(solve_part, parts))
    shares = shares[:, :, (1, 2, 0, 3)]
    # a wrong lambda only ever gives a bound that does not prove
    alpha, shares, proved = _prove(grasp, tasks, load, reach, alpha, shares, multipliers)
    return alpha / size, shares * grasp.force_units, proved & converged


def _prove(grasp, tasks, load, reach, alpha, shares, multipliers):
    """
    Judge all answers, as ``proof.prove`` judges one.

    Returns
    -------
    (N,) array alpha, (N, k, 4) array shares inside the bound, (N,) bool array

    """
    G = grasp.scaled_matrix.reshape(6, -1)
    used = _over_groups(shares[:, :, 2], grasp.groups, np.sum).max(axis=1)
    excess = np.maximum(1.0, used)
    shares = shares / excess[:, None, None]
    if not load.any():
        alpha = alpha / excess
    balance = shares.reshape(len(tasks), -1) @ G.T + load - alpha[:, None] * tasks
    left, size = np.sqrt((balance * balance).sum(axis=1)), np.sqrt(load @ load)
    residual = left / max(reach, size)
    imbalance = left / np.maximum(  # tasks have norm one
        np.maximum(np.abs(alpha), size), proof.SMALL_CAP * grasp.least_cap)
    usage = usage_of_shares(shares, unloaded=proof.ROUNDING).max(axis=1)
    with np.errstate(divide='ignore', invalid='ignore'):
        multipliers = multipliers / (multipliers * tasks).sum(axis=1)[:, None]
        h = (multipliers @ G).reshape(len(tasks), -1, 4)
        worth = h[:, :, 2] + np.sqrt(h[:, :, 0] ** 2 + h[:, :, 1] ** 2 + h[:, :, 3] ** 2)
        upper = multipliers @ load + _over_groups(
            np.maximum(worth, 0.0), grasp.groups, np.max).sum(axis=1)
        gap = (upper - alpha) / np.maximum(alpha, 1e-3 * reach)
    proved = (gap <= proof.GAP_TOLERANCE) & (residual <= proof.RESIDUAL_TOLERANCE) \
        & (imbalance <= proof.IMBALANCE_TOLERANCE) \
        & (usage <= 1.0 + proof.USAGE_TOLERANCE)
    return np.clip(alpha, 0.0, np.where(proved, upper, np.inf)), shares, proved


def _over_groups(values, groups, reduce):
    """Reduce (N, k) over the contacts of every group: (N, number of groups)."""
    members = [[i for i, g in enumerate(groups) if g == group] for group in range(max(groups) + 1)]
    return np.stack([reduce(values[:, rows], axis=1) for rows in members], axis=1)

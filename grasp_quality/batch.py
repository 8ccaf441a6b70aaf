# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Many task wrenches at once: maps, surfaces, corners, and the inside of ``many``.

The kernel solves them on all cores, ``judge`` proves them. Whatever misses the proof is solved
again by itself, by whichever solver proves it. The cores are shared by Python threads around
compiled code that releases the lock: unlike numba's own parallel loops these may be used from
several threads and in forked processes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import os
from threading import Lock, Thread
from typing import TypeVar

from grasp_quality import judge, kernel, kernel_solver, proof
from grasp_quality.arrays import Array, Bools, Codes, Ints
from grasp_quality.barrier import NEGLIGIBLE
from grasp_quality.grasp import Grasp
from grasp_quality.infeasibility import INFEASIBILITY_TOLERANCE
from grasp_quality.problem import build_problem, NO_WRENCH
from grasp_quality.scaled import Scaled
from grasp_quality.solve import solve
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import Limit, TimeLimit
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike

Part = TypeVar('Part')
AT_ONCE = 256  # problems that a core solves between two looks at the time limit
SMALL = 128  # problems that are not worth a thread
TOLERANCES = (
    proof.GAP_TOLERANCE, proof.RESIDUAL_TOLERANCE, proof.IMBALANCE_TOLERANCE,
    proof.USAGE_TOLERANCE, INFEASIBILITY_TOLERANCE, proof.SMALL_CAP, proof.ROUNDING)


@dataclass(frozen=True, eq=False)
class Batch:
    """
    Answers to many task wrenches.

    Attributes
    ----------
    alpha : (N,) array
        0 where infeasible.
    feasible : (N,) bool array
    forces : (N, k, 4) array [N, N, N, N m], or None where not asked for
        Zero where infeasible.
    handed_over : int
        How many the kernel could not prove.

    """

    alpha: Array
    feasible: Bools
    forces: Array | None
    handed_over: int


def solve_wrenches(grasp: Grasp, wrenches: Array, external_wrench: ArrayLike | None = None,
                   time_limit_s: Limit = None, forces: bool = True) -> Batch:
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
    forces : bool
        Whether to return the contact forces too.

    Returns
    -------
    Batch

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    limit = TimeLimit.of(time_limit_s)
    load = NO_WRENCH if external_wrench is None else as_wrench(external_wrench, 'external_wrench')
    count = len(wrenches)
    answers = Answers.empty(count, len(grasp) if forces else 0)
    if kernel_solver.handles_grasp(grasp):
        scaled = Scaled.of(grasp)
        loads = np.broadcast_to(load, (count, 6))

        def job(part: slice) -> None:
            solve_part(scaled, np.zeros(len(wrenches[part]), np.int64), wrenches[part],
                       loads[part], answers.part(part))

        on_all_cores(job, [slice(begin, begin + AT_ONCE) for begin in range(0, count, AT_ONCE)],
                     count, limit)
    feasible = answers.status == judge.OPTIMAL
    unproved = np.flatnonzero(answers.status == judge.UNPROVED)
    for i in unproved:
        solution = solve(build_problem(grasp, TaskWrench(wrenches[i]), load), limit)
        answers.alpha[i], feasible[i] = solution.alpha, solution.feasible
        if forces and solution.feasible:
            answers.forces[i] = solution.forces
    return Batch(answers.alpha, feasible, answers.forces if forces else None, len(unproved))


@dataclass(frozen=True, eq=False)
class Answers:
    """Arrays that answers are written into: alpha, upper, status (N,), forces (N or 0, k, 4)."""

    alpha: Array
    upper: Array
    status: Codes
    forces: Array

    @classmethod
    def empty(cls, count: int, contacts: int) -> Answers:
        """Nothing proved yet; no forces where there are no contacts to have them."""
        return cls(np.zeros(count), np.full(count, np.inf),
                   np.full(count, judge.UNPROVED, np.int8),
                   np.zeros((count if contacts else 0, contacts, 4)))

    def part(self, rows: slice) -> Answers:
        """View some rows."""
        return Answers(self.alpha[rows], self.upper[rows], self.status[rows], self.forces[rows])


def solve_part(scaled: Scaled, which: Ints, wrenches: Array, loads: Array, answers: Answers,
               barrier_weight: float = 0.0) -> None:
    """
    Solve and judge some problems on this thread.

    Parameters
    ----------
    scaled : Scaled
        Grasps of one pattern.
    which : (N,) int64 array
        Grasp of each problem.
    wrenches, loads : (N, 6) arrays [N, N m]
        Tasks and external wrenches, each about the origin of its grasp's object frame.
    answers : Answers
        Written into, all of it.
    barrier_weight : float
        eps of eq. (11); what has no proved answer without it gets none with it.

    """
    count, k = len(which), len(scaled.groups)
    # copies: a read-only array is another type to numba, and would compile once more
    tasks = scaled.wrenches(np.array(wrenches), which)
    loads = scaled.wrenches(np.array(loads), which)
    sizes = np.sqrt((tasks * tasks).sum(axis=1))
    tasks /= sizes[:, None]
    shares, multipliers = np.empty((count, k, 4)), np.empty((count, 6))
    nus = np.empty((count, scaled.group_count))
    problem = (scaled.blocks, which, scaled.groups, scaled.group_count, tasks, loads,
               scaled.reaches, scaled.least_caps)
    kernel.solve_many(*problem, 1.0, np.zeros((1, k)), answers.alpha, shares, multipliers, nus,
                      answers.status)
    judge.judge_many(TOLERANCES, *problem, scaled.units, sizes, answers.alpha, shares, multipliers,
                     answers.status, answers.upper, answers.forces)
    if barrier_weight > 0.0:
        before = answers.status.copy()
        idle = answers.upper * sizes <= NEGLIGIBLE * scaled.reaches[which]
        before[idle & (before == judge.OPTIMAL)] = judge.UNPROVED  # alpha has no inside
        rest = before != judge.OPTIMAL
        frictional = np.any(scaled.units[:, :, (0, 1, 3)] > 0.0, axis=2)[which]  # (N, k)
        weights = np.where(frictional, 1.0, 0.5) * (barrier_weight * sizes)[:, None]
        kernel.solve_many(*problem, 1.0, weights, answers.alpha, shares, multipliers, nus,
                          answers.status)
        judge.judge_centres(
            TOLERANCES, *problem, scaled.units, sizes, barrier_weight, answers.alpha, shares,
            multipliers, nus, answers.upper, answers.status, answers.forces)
        answers.alpha[rest], answers.status[rest] = 0.0, before[rest]
        if len(answers.forces):
            answers.forces[rest] = 0.0


def on_all_cores(job: Callable[[Part], None], parts: Sequence[Part], problems: int,
                 limit: TimeLimit | None = None) -> None:
    """Run job(part) for all parts, on threads of their own where there are many problems."""
    waiting, lock = iter(parts), Lock()
    errors: list[BaseException] = []

    def work() -> None:
        while not errors:
            with lock:
                part = next(waiting, None)
            if part is None:
                return
            try:
                job(part)
                if limit is not None:
                    limit.remaining_s()
            except BaseException as error:  # raised again where the question was asked
                errors.append(error)

    cores = len(os.sched_getaffinity(0)) if problems > SMALL else 1
    threads = [Thread(target=work) for _ in range(min(cores, len(parts)) - 1)]
    for thread in threads:
        thread.start()
    work()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]

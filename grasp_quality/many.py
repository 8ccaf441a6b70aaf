# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Many grasps, many tasks, one call: what a planner that ranks candidates asks.

Every answer carries the same proof as that of ``evaluate``. One problem that nothing can prove
does not spoil the others: it is marked, with alpha 0 and no forces.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import enum
from itertools import pairwise

from grasp_quality import judge
from grasp_quality.arrays import checked_number, floats, frozen
from grasp_quality.barrier import with_margin
from grasp_quality.batch import Answers, AT_ONCE, on_all_cores, solve_part
from grasp_quality.exceptions import InvalidTaskError, SolverError, SolverTimeoutError
from grasp_quality.grasp import Grasp
from grasp_quality.grasp_set import GraspSet
from grasp_quality.problem import build_problem
from grasp_quality.scaled import Scaled
from grasp_quality.solve import solve
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import Limit, TimeLimit
import numpy as np
from numpy.typing import ArrayLike, NDArray


class Outcome(enum.IntEnum):
    """Outcome of one of many problems; positive when it is an answer."""

    UNPROVED = 0             # no solver gave an answer that its proof confirms
    OPTIMAL = 1
    INFEASIBLE = 2
    OPTIMAL_NO_INTERIOR = 3  # see Status.OPTIMAL_NO_INTERIOR


@dataclass(frozen=True, eq=False)
class ManySolution:
    """
    Answers to many problems; ``...`` stands for the shape that tasks and grasps broadcast to.

    Attributes
    ----------
    alpha : (...) array
        0 on every outcome but the optimal ones.
    alpha_upper : (...) array
        Dual bound, as in ``Solution``; inf where unproved.
    status : (...) int8 array
        Values of ``Outcome``.
    forces : (..., k, 4) array [N, N, N, N m] or None
        On request; k is the largest contact count, and what is not there is zero.
    handed_over : int
        How many the batch kernel did not prove itself.

    """

    alpha: NDArray[np.float64]
    alpha_upper: NDArray[np.float64]
    status: NDArray[np.int8]
    forces: NDArray[np.float64] | None
    handed_over: int

    @property
    def feasible(self) -> NDArray[np.bool_]:
        """Which problems have forces: the optimal ones."""
        found: NDArray[np.bool_] = (
            (self.status == Outcome.OPTIMAL) | (self.status == Outcome.OPTIMAL_NO_INTERIOR))
        return found


def evaluate_many(
        grasps: GraspSet | Iterable[Grasp], tasks: TaskWrench | ArrayLike,
        external_wrench: ArrayLike | None = None, barrier_weight: float = 0.0,
        forces: bool = False, time_limit_s: Limit = None) -> ManySolution:
    """
    Tell how much of a task wrench each of many grasps can apply.

    Parameters
    ----------
    grasps : GraspSet, or iterable of Grasp
        M grasps, of equal or of different contact counts.
    tasks : TaskWrench or array_like [N, N m]
        (6,): one for all; (M, 6): one each; (T, 1, 6): all tasks with all grasps, for answers
        (T, M). None of them zero.
    external_wrench : array_like [N, N m], optional
        What the world applies besides the fingers; of the same shapes as ``tasks``.
    barrier_weight : float
        eps >= 0 of eq. (11), in the unit of alpha.
    forces : bool
        Whether to return the contact forces too.
    time_limit_s : float, optional
        For all of it [s].

    Returns
    -------
    ManySolution

    Raises
    ------
    InvalidContactError, InvalidGraspError, InvalidTaskError, SolverTimeoutError

    """
    limit = TimeLimit.of(time_limit_s)
    eps = checked_number(barrier_weight, 'barrier_weight', InvalidTaskError, minimum=0.0)
    grasps = grasps if isinstance(grasps, GraspSet) else GraspSet.of(grasps)
    wrenches = _wrenches(tasks.wrench if isinstance(tasks, TaskWrench) else tasks, 'tasks')
    loads = _wrenches(np.zeros(6) if external_wrench is None else external_wrench,
                      'external_wrench')
    zero = np.argwhere(~wrenches.any(axis=-1))
    if len(zero):
        raise InvalidTaskError(f'tasks must not be zero, but that at {zero[0].tolist()} is')
    try:
        shape = np.broadcast_shapes(wrenches.shape[:-1], loads.shape[:-1], (len(grasps),))
    except ValueError as exc:
        raise InvalidTaskError(
            f'tasks {wrenches.shape} and external_wrench {loads.shape} must broadcast against '
            f'{len(grasps)} grasps: give (6,), ({len(grasps)}, 6) or (T, 1, 6)') from exc
    if shape[-1] != len(grasps):
        raise InvalidTaskError(
            f'{shape[-1]} tasks do not fit one grasp: give (T, 1, 6), or use wrench_map')
    which = np.broadcast_to(np.arange(len(grasps)), shape).ravel()
    wrenches = np.broadcast_to(wrenches, (*shape, 6)).reshape(-1, 6)
    loads = np.broadcast_to(loads, (*shape, 6)).reshape(-1, 6)
    answers = Answers.empty(len(which), int(np.diff(grasps.starts).max()) if forces else 0)
    by_kernel(grasps, which, wrenches, loads, answers, limit, eps)
    unproved = np.flatnonzero(answers.status == judge.UNPROVED)
    for n in unproved:
        _alone(grasps[int(which[n])], wrenches[n], loads[n], eps, limit, answers, int(n))
    return ManySolution(
        frozen(answers.alpha.reshape(shape)), frozen(answers.upper.reshape(shape)),
        frozen(answers.status.reshape(shape)),
        frozen(answers.forces.reshape(*shape, -1, 4)) if forces else None, len(unproved))


def by_kernel(grasps: GraspSet, which: NDArray[np.int64], wrenches: NDArray[np.float64],
              loads: NDArray[np.float64], answers: Answers, limit: TimeLimit | None,
              eps: float = 0.0) -> None:
    """Answer what the kernel can, pattern by pattern; the rest stays marked as unproved."""
    jobs = []
    pattern = _pattern_of(grasps)
    for number in range(int(pattern.max()) + 1):
        problems = np.flatnonzero(pattern[which] == number)
        problems = problems[np.argsort(which[problems], kind='stable')]
        jobs += [problems[begin:begin + AT_ONCE] for begin in range(0, len(problems), AT_ONCE)]

    def job(problems: NDArray[np.int64]) -> None:
        members, local = np.unique(which[problems], return_inverse=True)
        scaled = Scaled.of_rows(grasps, members)
        part = Answers.empty(len(problems), len(scaled.groups) if len(answers.forces) else 0)
        solve_part(scaled, local, wrenches[problems], loads[problems], part, eps)
        answers.alpha[problems], answers.upper[problems] = part.alpha, part.upper
        answers.status[problems] = part.status
        if len(answers.forces):
            answers.forces[problems, :len(scaled.groups)] = part.forces

    on_all_cores(job, jobs, len(which), limit)


def _pattern_of(grasps: GraspSet) -> NDArray[np.int64]:
    """Return which pattern, contact count and groups, each grasp has, from 0; -1 for l2."""
    M, k = len(grasps), len(grasps.groups) // len(grasps)
    if (grasps.starts == np.arange(M + 1) * k).all() and (
            grasps.groups.reshape(M, k) == grasps.groups[:k]).all():
        pattern = np.zeros(M, np.int64)
    else:
        numbers: dict[bytes, int] = {}
        starts = grasps.starts.tolist()
        pattern = np.array([
            numbers.setdefault(grasps.groups[begin:end].tobytes(), len(numbers))
            for begin, end in pairwise(starts)])
    return np.where(grasps.is_l2, -1, pattern)


def _alone(grasp: Grasp, wrench: NDArray[np.float64], load: NDArray[np.float64], eps: float,
           limit: TimeLimit | None, answers: Answers, n: int) -> None:
    """Answer one problem by ``solve``; leave it marked as unproved where nothing proves it."""
    problem = build_problem(grasp, TaskWrench(wrench), load)
    try:
        solution = solve(problem, limit)
        if eps > 0.0 and solution.feasible:
            solution = with_margin(problem, solution, eps, limit)
    except SolverTimeoutError:
        raise
    except SolverError:
        return
    answers.alpha[n], answers.upper[n] = solution.alpha, solution.alpha_upper
    answers.status[n] = Outcome[solution.status.name]
    if len(answers.forces) and solution.feasible:
        answers.forces[n, :len(solution.forces)] = solution.forces


def _wrenches(value: ArrayLike, name: str) -> NDArray[np.float64]:
    wrenches = floats(value, name, 'wrenches (..., 6)', InvalidTaskError)
    if not wrenches.ndim or wrenches.shape[-1] != 6:
        raise InvalidTaskError(f'{name} must have shape (..., 6), got {wrenches.shape}')
    if not np.isfinite(wrenches).all():
        row = np.argwhere(~np.isfinite(wrenches))[0]
        raise InvalidTaskError(f'{name} must be finite, but entry {row.tolist()} is not')
    return wrenches

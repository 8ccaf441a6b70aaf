# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Several wrenches at once: the task polytope (eq. 18) and the ellipsoid through its axes.

Each wrench is solved by itself. Convexity guarantees conv{0, alpha_i F_i}; the parallelotope that
eq. (19) of the paper claims is held only at ``parallelotope_scale``, the least alpha over its
corners (docs/derivations.md).
"""

from collections.abc import Callable
import itertools
import math
from typing import Any

from grasp_quality.arrays import Array, frozen, SMALLEST
from grasp_quality.batch import solve_wrenches
from grasp_quality.grasp import Grasp
from grasp_quality.solution import PolytopeSolution, Solution
from grasp_quality.status import Status
from grasp_quality.task import TaskEllipsoid, TaskPolytope, TaskWrench
from grasp_quality.time_limit import Limit
import numpy as np
from numpy.typing import ArrayLike

MAX_PARALLELOTOPE = 8  # wrenches; the corners are 2^8


def evaluate_polytope(grasp: Grasp, task: TaskPolytope,
                      solve_one: Callable[[TaskWrench], Solution],
                      external_wrench: ArrayLike | None, time_limit_s: Limit) -> PolytopeSolution:
    """Solve every wrench by ``solve_one(TaskWrench)``, and weigh; see ``measures.evaluate``."""
    solutions = [solve_one(TaskWrench(wrench)) for wrench in task.wrenches]
    summary = _summary(grasp, solutions, task.weights)
    if not task.parallelotope or len(solutions) > MAX_PARALLELOTOPE:
        return PolytopeSolution(**summary)
    if not all(s.feasible and s.holdable for s in solutions):
        return PolytopeSolution(**summary, parallelotope_scale=0.0)
    reached = summary['alphas'][:, None] * task.wrenches  # (n, 6)
    scale = _largest_scale(grasp, reached, external_wrench, time_limit_s)
    return PolytopeSolution(**summary, parallelotope_scale=scale)


def evaluate_ellipsoid(grasp: Grasp, task: TaskEllipsoid,
                       solve_one: Callable[[TaskWrench], Solution]) -> PolytopeSolution:
    """Solve both ends of every principal axis; only min alpha / sqrt(n) is guaranteed."""
    ends = task.ends
    solutions = [solve_one(TaskWrench(wrench)) for wrench in ends]
    summary = _summary(grasp, solutions, np.full(len(ends), 1.0 / len(ends)))
    held = all(s.feasible and s.holdable for s in solutions)
    guaranteed = float(summary['alphas'].min()) / math.sqrt(len(task.axes)) if held else 0.0
    return PolytopeSolution(**summary, guaranteed_scale=guaranteed)


def _summary(grasp: Grasp, solutions: list[Solution], weights: Array) -> dict[str, Any]:
    alphas = np.array([s.alpha for s in solutions])
    feasible = all(s.feasible for s in solutions)
    flat = [s for s in solutions if s.status is Status.OPTIMAL_NO_INTERIOR]
    return {
        'status': Status.INFEASIBLE if not feasible else (
            Status.OPTIMAL_NO_INTERIOR if flat else Status.OPTIMAL),
        'quality': float(weights @ alphas) if feasible else 0.0,
        'alphas': frozen(alphas),
        'forces': frozen(np.array([s.forces for s in solutions]) if feasible
                         else np.zeros((0, len(grasp), 4))),
        'solutions': tuple(solutions)}


def _largest_scale(grasp: Grasp, reached: Array, external_wrench: ArrayLike | None,
                   time_limit_s: Limit) -> float:
    """Least alpha over the corners sum_{i in S} alpha_i F_i, at most 1."""
    reached = reached[np.abs(reached).max(axis=1) >= SMALLEST]
    size = np.abs(reached).max(initial=0.0)
    corners = [np.sum(subset, axis=0) for count in range(2, len(reached) + 1)
               for subset in itertools.combinations(reached, count)]
    # opposite wrenches cancel; the zero wrench is held
    corners = [corner for corner in corners if np.abs(corner).max() > 1e-9 * size]
    if not corners:
        return 1.0
    alphas = solve_wrenches(
        grasp, np.array(corners), external_wrench, time_limit_s, forces=False).alpha
    return min(1.0, float(alphas.min()))

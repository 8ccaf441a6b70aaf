# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The measures that users call: tasks in, answers out.

Each is a few solves of conic programs put together; the mathematics of one solve is in
``problem``, ``solve`` and ``proof``, the barrier term in ``barrier``.
"""

from __future__ import annotations

import dataclasses
from typing import cast, overload

from grasp_quality import friction_cone
from grasp_quality.arguments import require_grasp, require_start
from grasp_quality.arrays import Array, checked, checked_number, frozen
from grasp_quality.barrier import with_margin
from grasp_quality.batch import solve_wrenches
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.polytope import evaluate_ellipsoid, evaluate_polytope
from grasp_quality.problem import build_problem
from grasp_quality.reserve import with_reserve
from grasp_quality.solution import ConeSolution, PolytopeSolution, Solution, WrenchMap
from grasp_quality.solve import solve
from grasp_quality.task import (
    check_rows, Task, TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench)
from grasp_quality.time_limit import Limit, TimeLimit
import numpy as np
from numpy.typing import ArrayLike


@overload
def evaluate(grasp: Grasp, task: TaskWrench, external_wrench: ArrayLike | None = ...,
             barrier_weight: float = ..., time_limit_s: Limit = ..., alpha_reserve: float = ...,
             start: Solution | None = ...) -> Solution: ...


@overload
def evaluate(grasp: Grasp, task: TaskCone, external_wrench: ArrayLike | None = ...,
             barrier_weight: float = ..., time_limit_s: Limit = ..., alpha_reserve: float = ...,
             start: Solution | None = ...) -> ConeSolution: ...


@overload
def evaluate(grasp: Grasp, task: TaskPolytope | TaskEllipsoid,
             external_wrench: ArrayLike | None = ..., barrier_weight: float = ...,
             time_limit_s: Limit = ..., alpha_reserve: float = ...,
             start: Solution | None = ...) -> PolytopeSolution: ...


@overload
def evaluate(grasp: Grasp, task: Task, external_wrench: ArrayLike | None = ...,
             barrier_weight: float = ..., time_limit_s: Limit = ..., alpha_reserve: float = ...,
             start: Solution | None = ...) -> Solution | PolytopeSolution: ...


def evaluate(grasp: Grasp, task: Task, external_wrench: ArrayLike | None = None,
             barrier_weight: float = 0.0, time_limit_s: Limit = None, alpha_reserve: float = 0.0,
             start: Solution | None = None) -> Solution | PolytopeSolution:
    """
    Tell how much of a task the grasp can apply, and with which forces.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    task : TaskWrench, TaskCone, TaskPolytope or TaskEllipsoid
        About the object frame's origin [N, N m]; taken as given, never normalised.
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object besides the fingers.
    barrier_weight : float
        eps >= 0 of eq. (11), in the unit of alpha: buys friction margin with alpha.
    time_limit_s : float, optional
        For the whole question [s].
    alpha_reserve : float
        d in [0, 1): 0 gives forces of the largest alpha; more gives the unique forces with the
        largest margin at alpha* - d (alpha* - alpha_lower), which do not jump (``reserve``).
    start : Solution, optional
        Answer with a reserve for contacts close by, to begin from; changes the time only.

    Returns
    -------
    Solution, ConeSolution or PolytopeSolution

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    require_start(start, Solution, 'evaluate(..., alpha_reserve=d)')
    time_limit_s = TimeLimit.of(time_limit_s)
    eps = checked_number(barrier_weight, 'barrier_weight', InvalidTaskError, minimum=0.0)
    reserve = checked_number(
        alpha_reserve, 'alpha_reserve', InvalidTaskError, minimum=0.0, below=1.0)
    if eps > 0.0 and reserve > 0.0:
        raise InvalidTaskError(
            f'barrier_weight {eps:g} and alpha_reserve {reserve:g} are two ways to buy margin '
            'with alpha: set one of them to 0')

    def one(single: TaskWrench | TaskCone) -> Solution:
        problem = build_problem(grasp, single, external_wrench)
        solution = solve(problem, time_limit_s)
        if eps > 0.0 and solution.feasible:
            solution = with_margin(problem, solution, eps, time_limit_s)
        if reserve > 0.0 and solution.feasible:
            solution = with_reserve(problem, solution, reserve, start, time_limit_s)
        return solution

    if isinstance(task, TaskWrench):
        return one(task)
    if isinstance(task, TaskCone):
        return _with_axis_and_surface(
            cast(ConeSolution, one(task)), grasp, task, external_wrench, time_limit_s)
    if isinstance(task, TaskPolytope):
        return evaluate_polytope(grasp, task, one, external_wrench, time_limit_s)
    if isinstance(task, TaskEllipsoid):
        return evaluate_ellipsoid(grasp, task, one)
    raise InvalidTaskError(
        'task must be a TaskWrench, TaskCone, TaskPolytope or TaskEllipsoid, '
        f'got {type(task).__name__}')


def _with_axis_and_surface(solution: ConeSolution, grasp: Grasp, task: TaskCone,
                           external_wrench: ArrayLike | None, time_limit_s: Limit) -> ConeSolution:
    axis, *surface = wrench_map(
        grasp, np.vstack([task.axis[None], task.surface]), external_wrench,
        time_limit_s=time_limit_s).alpha
    return dataclasses.replace(
        solution, alpha_axis=float(axis), alpha_worst=float(min(surface)) if surface else None)


def wrench_map(grasp: Grasp, directions: ArrayLike, external_wrench: ArrayLike | None = None,
               forces: bool = False, time_limit_s: Limit = None) -> WrenchMap:
    """
    Alpha for many task wrenches (Fig. 3b).

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    directions : (N, 6) array_like [N, N m]
        Task wrenches about the object frame's origin, taken as given; none may be zero.
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object, about the object frame's origin; zero if None.
    forces : bool
        Whether to return the contact forces too.
    time_limit_s : float, optional
        For the whole map [s].

    Returns
    -------
    WrenchMap

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    directions = checked(directions, (None, 6), 'directions', InvalidTaskError)
    check_rows(directions, 'directions')
    batch = solve_wrenches(grasp, directions, external_wrench, time_limit_s, forces)
    return WrenchMap(directions, frozen(batch.alpha), frozen(batch.feasible),
                     None if batch.forces is None else frozen(batch.forces))


def slip_margin(grasp: Grasp, forces: ArrayLike) -> Array:
    """
    Slip margin of measured contact forces, 1 - cone usage.

    Parameters
    ----------
    grasp : Grasp
        Contacts that the forces were measured at, in the same order.
    forces : (k, 4) array_like [N, N, N, N m]
        Measured [t1, t2, n, m_n] of every contact, in its contact frame, finger on object.

    Returns
    -------
    (k,) array: 1 on the cone's axis and for an unloaded contact, 0 at slip, negative outside the
    cone, -inf for a tangential force where there is no friction at all. A measured moment counts
    only where the contact model has torsional friction: the point contacts say nothing of it.

    Raises
    ------
    InvalidTaskError

    """
    require_grasp(grasp)
    measured = checked(forces, (len(grasp), 4), 'forces', InvalidTaskError)
    measured = np.where([1, 1, 1, 0], measured, measured * (grasp.scales > 0.0))
    return 1.0 - friction_cone.usage(measured, grasp.scales, grasp.max_normal_forces)

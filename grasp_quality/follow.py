# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Forces that follow their goal no faster than a hand can.

The forces commanded last were proved for contacts that have moved on, and hold for them no longer.
They are first brought to the nearest forces that are admissible now, and from there as far along
the straight line to the goal as the allowed change goes. Cones, bounds and equilibrium are convex:
every point of that line is admissible, with an alpha between those of its ends, and what comes
out is proved once more. Where the contacts alone force a larger change than allowed, the nearest
admissible forces are what comes out: safety before smoothness, and it is told.
"""

import dataclasses
from dataclasses import dataclass

from grasp_quality.arguments import require_made
from grasp_quality.arrays import checked, checked_number
from grasp_quality.exceptions import InvalidTaskError, SolverError
from grasp_quality.nearest import distances, nearest_forces, proved
from grasp_quality.problem import ConicProblem
from grasp_quality.reserve import with_forces
from grasp_quality.solution import Solution
from grasp_quality.time_limit import Limit, TimeLimit
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
# shares of the way to the goal that lift a solver's rounding off the cones' edges, in turn
LIFTS = (0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)


@dataclass(frozen=True, eq=False)
class Followed:
    """
    Forces on their way to a goal.

    Attributes
    ----------
    solution : Solution
        With the forces to command and the alpha that they apply.
    limited : bool
        Whether they have not reached the goal.
    largest_change : float [N]
        Of any contact's force against the one before; more than allowed where the contacts
        leave no choice.

    """

    solution: Solution
    limited: bool
    largest_change: float


def follow(problem: ConicProblem, goal: Solution, forces: ArrayLike, allowed_change: float,
           time_limit: Limit = None) -> Followed:
    """
    Go from the forces commanded last towards those of an answer.

    Parameters
    ----------
    problem : ConicProblem
        Of the answer's task, for the present contacts.
    goal : Solution
        Feasible answer to that problem.
    forces : (k, 4) array [N, N, N, N m]
        Forces commanded last, [t1, t2, n, m_n] in the present contact frames.
    allowed_change : float [N]
        Largest change of any contact's force, a moment counted as m_n / gamma.
    time_limit : TimeLimit or float, optional
        Of the question that this is part of; a number counts from now [s].

    Returns
    -------
    Followed

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_made(problem, ConicProblem, 'problem', 'build_problem(grasp, task)')
    require_made(goal, Solution, 'goal', 'evaluate(grasp, task)')
    grasp, limit = problem.grasp, TimeLimit.of(time_limit)
    if len(goal.forces) != len(grasp):
        raise InvalidTaskError(
            f'goal must have forces for all {len(grasp)} contacts, got {len(goal.forces)} with '
            f'status {goal.status.name}: give a feasible answer for the present contacts')
    allowed = checked_number(allowed_change, 'allowed_change', InvalidTaskError, minimum=0.0)
    last = grasp.shares(checked(forces, (len(grasp), 4), 'forces', InvalidTaskError))
    end = grasp.shares(goal.forces)
    moved = float(distances(problem, end, last).max())
    if moved <= allowed:
        return Followed(goal, False, moved)
    near = nearest_forces(problem, last, limit)
    if near is None:
        raise SolverError('the goal is admissible and no forces are', problem, 'contradiction')
    way = largest_share(problem, last, near.shares, end, allowed)
    applied = goal_values(problem, goal)
    for lift in LIFTS:
        s = max(way, lift)
        there = proved(problem, near.shares + s * (end - near.shares),
                       near.values + s * (applied - near.values))
        if there is not None:
            solution = with_forces(problem, goal, there.shares, there.values, there.proof)
            return Followed(dataclasses.replace(solution, center=goal.center), True,
                            float(distances(problem, there.shares, last).max()))
    raise SolverError('no forces on the way to the goal could be proved', problem, 'rounding')


def largest_share(problem: ConicProblem, last: Array, near: Array, end: Array,
                  allowed: float) -> float:
    """Largest s in [0, 1] with every |near + s (end - near) - last| <= allowed; 0 if none."""
    gap, step = distances(problem, near, last), distances(problem, end, near)
    # |gap|^2 + 2 b s + a s^2 = allowed^2, with b from the third side of the triangle
    a, c = step ** 2, gap ** 2 - allowed ** 2
    b = 0.5 * (distances(problem, end, last) ** 2 - a - gap ** 2)
    if (c > 0.0).any():
        return 0.0
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    shares = np.divide(root - b, a, where=a > 0.0, out=np.ones_like(a))
    return float(min(1.0, shares.min()))


def goal_values(problem: ConicProblem, goal: Solution) -> Array:
    """Variables of the virtual contact (t,) that the answer's wrench stands for."""
    virtual = problem.virtual
    found = np.linalg.lstsq(virtual.wrenches.T, goal.wrench, rcond=None)[0]
    return np.asarray(found / virtual.unit)

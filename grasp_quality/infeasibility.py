# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The proof that there is no answer: a direction in which the load does what no forces can.

Along a lambda that gains nothing by the task, every force inside cones, bound and joint limits
does less work than the load asks for (docs/derivations.md).
"""

from grasp_quality import judge, kernel_solver
from grasp_quality.arrays import Array
from grasp_quality.problem import ConicProblem, VirtualContact
from grasp_quality.proof import worth_of
import numpy as np

INFEASIBILITY_TOLERANCE = 1e-9  # of the caps' total: distance to any feasible load
ENDLESS = 1e6  # times the caps: a load that needs more counts as one that no forces balance


def infeasibility_margin(problem: ConicProblem, direction: Array) -> float:
    """
    Distance that a direction proves between the load and anything the grasp can balance.

    Parameters
    ----------
    problem : ConicProblem
        Program that may be infeasible.
    direction : (6,) array, or (6 + j,) with joint limits
        Candidate lambda, and the signed worth of the joints behind it, in scaled units.

    Returns
    -------
    float, as a share of the caps' total; the problem is infeasible when it is positive.

    """
    if kernel_solver.handles(problem):
        block, groups = problem.grasp.blocks[0], problem.grasp.blocks[2]
        return judge.infeasibility_margin(
            block, groups, problem.virtual.columns[:, 0].copy(),
            problem.scaled_external_wrench.copy(), problem.reach, np.array(direction[:6]),
            np.empty(max(problem.grasp.groups) + 1))
    direction = _sparing_the_task(problem.virtual, direction)
    size = np.sqrt(direction @ direction)
    if not size > 0.0:
        return 0.0
    widest = ENDLESS if problem.virtual.role == 'widening' else 1.0
    _, _, bound_total = worth_of(problem.grasp, direction)
    work = widest * bound_total + direction[:6] @ problem.scaled_external_wrench
    joints = problem.grasp.joint_rows
    if joints is not None:
        work += joints.cost(direction[6:], np.abs(direction[6:]))
    return float(-work / size / problem.reach)


def _sparing_the_task(virtual: VirtualContact, direction: Array) -> Array:
    """Turn a direction until no task does negative work along it; zero where that fails."""
    axis, rest = virtual.columns[:, 0], virtual.columns[:, 1:]
    size = np.abs(direction).max()
    if not 0.0 < size < np.inf:
        return np.zeros(len(direction))
    direction = direction / size
    if virtual.role == 'widening':
        return direction
    if virtual.role == 'pressing':  # a common press is what nu pays for
        return direction if (direction[:6] @ rest >= 0.0).all() else np.zeros(len(direction))
    lambda_ = direction[:6]
    slack = lambda_ @ axis - np.linalg.norm(lambda_ @ rest)
    turn = axis @ axis - np.linalg.norm(axis @ rest)
    if slack < 0.0:
        if turn > 0.0:  # our own copy, from the division
            direction[:6] -= (slack / turn) * axis
        else:  # joints that cannot carry the hand itself need no lambda
            direction[:6] = 0.0
    return direction

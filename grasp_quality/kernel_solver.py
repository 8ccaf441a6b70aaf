# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The compiled kernel as a solver of conic programs: single task wrenches, bounds made of groups.

It answers about ten times faster than a general solver; ``solve`` proves its answers like any
other's and hands what it does not solve to Clarabel.
"""

from grasp_quality import kernel
from grasp_quality.arrays import Array
from grasp_quality.grasp import Grasp
from grasp_quality.problem import ConicProblem
from grasp_quality.raw_answer import RawAnswer
from grasp_quality.time_limit import TimeLimit
import numpy as np

ONE = np.zeros(1, np.int64)  # the only problem's grasp


def handles(problem: ConicProblem) -> bool:
    """Whether the kernel knows this kind of problem."""
    return problem.virtual.role == 'task' and not problem.virtual.is_cone \
        and problem.virtual.columns.shape[1] == 1 and handles_grasp(problem.grasp)


def handles_grasp(grasp: Grasp) -> bool:
    """Whether the kernel knows task wrenches on this grasp: groups are all that bounds forces."""
    return grasp.bound != 'l2' and grasp.joint_limits is None


def run(problem: ConicProblem, limit: TimeLimit | None = None,
        weights: Array | None = None) -> RawAnswer:
    """
    Solve a ConicProblem once.

    Parameters
    ----------
    problem : ConicProblem
        Of a kind that ``handles`` knows.
    limit : TimeLimit, optional
        Of the question that this is an attempt at; looked at afterwards.
    weights : (k,) array, optional
        Barrier weight of each contact's log det, for the weighted centre instead of the optimum.

    Returns
    -------
    RawAnswer

    Raises
    ------
    SolverTimeoutError

    """
    grasp, k = problem.grasp, len(problem.grasp)
    block, _, groups = grasp.blocks
    group_count = max(grasp.groups) + 1
    alpha, shares, multiplier = np.empty(1), np.empty((1, k, 4)), np.empty((1, 6))
    nu, status = np.empty((1, group_count)), np.empty(1, np.int8)
    # copies: a read-only array is another type to numba, and would compile the kernel once more
    kernel.solve_many(
        block[None], ONE, groups, group_count, problem.virtual.columns.T.copy(),
        problem.scaled_external_wrench[None].copy(), np.array([problem.reach]),
        np.array([grasp.least_cap]), float(problem.virtual.objective[0]),
        np.zeros((1, k)) if weights is None else weights[None].copy(),
        alpha, shares, multiplier, nu, status)
    if limit is not None:
        limit.remaining_s(problem)
    return RawAnswer(shares[0][:, (1, 2, 0, 3)], alpha, np.concatenate([multiplier[0], nu[0]]),
                     'Solved' if status[0] == kernel.SOLVED else 'Stalled')

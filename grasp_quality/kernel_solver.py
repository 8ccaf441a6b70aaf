# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The compiled kernel as a solver of conic programs: single task wrenches, bounds made of groups.

It answers about ten times faster than a general solver; ``solve`` proves its answers like any
other's and hands what it does not solve to Clarabel.
"""

from grasp_quality import kernel
from grasp_quality.raw_answer import RawAnswer
import numpy as np


def handles(problem):
    """Whether the kernel knows this kind of problem."""
    return problem.virtual.role == 'task' and not problem.virtual.is_cone \
        and problem.virtual.columns.shape[1] == 1 and problem.grasp.bound != 'l2' \
        and problem.grasp.joint_limits is None


def run(problem, limit=None, weights=None):
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
    G, curvature, groups = grasp.blocks
    work, group = np.empty((k, 8, 4)), np.empty((max(grasp.groups) + 1, 8))
    multipliers = np.empty(6)
    # copies: a read-only array is another type to numba, and would compile the kernel once more
    converged, alpha, _ = kernel.solve_wrench(
        G, curvature, groups, problem.virtual.columns[:, 0].copy(),
        problem.scaled_external_wrench.copy(), float(problem.virtual.objective[0]), problem.reach,
        np.zeros(k) if weights is None else weights, work, group, multipliers)
    if limit is not None:
        limit.remaining_s(problem)
    shares = work[:, kernel.U][:, (1, 2, 0, 3)]
    return RawAnswer(shares, np.array([alpha]), np.concatenate([multipliers, group[:, kernel.NU]]),
                     'Solved' if converged else 'Stalled')

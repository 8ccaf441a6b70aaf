# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A second stage for controllers: give up a little alpha for forces that are unique and smooth.

The forces of the largest alpha lie on the edge of cones and caps, are often not unique, and jump
where alpha has a kink. At a share (1 - d) of the way from alpha_lower to it there is room, and the
centre of that room (``force_center``) is one force for each contact that moves as smoothly as the
contacts do. alpha_upper, interval and sensitivities stay those of the largest alpha, so that
alpha_upper - alpha is the price. See docs/continuity.md.
"""

import dataclasses
from typing import cast

from grasp_quality import friction_cone
from grasp_quality.arrays import frozen
from grasp_quality.barrier import has_interior
from grasp_quality.exceptions import SolverError
from grasp_quality.force_center import force_center
from grasp_quality.problem import ConicProblem
from grasp_quality.proof import Proof
from grasp_quality.solution import Solution
from grasp_quality.solve import task_share
from grasp_quality.status import Status
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def with_reserve(problem: ConicProblem, solution: Solution, alpha_reserve: float,
                 start: Solution | None = None,
                 time_limit_s: TimeLimit | float | None = None) -> Solution:
    """
    Replace the forces of a solved task by the centre at a slightly smaller alpha.

    Parameters
    ----------
    problem : ConicProblem
        Of a task wrench or cone.
    solution : Solution
        Its feasible answer without a barrier weight.
    alpha_reserve : float
        d in (0, 1): alpha becomes alpha* - d (alpha* - alpha_lower).
    start : Solution, optional
        Answer with a reserve for contacts close by, to begin from; changes the time only.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    Solution; the given one with status OPTIMAL_NO_INTERIOR where no strictly interior force exists

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    alpha = solution.alpha - alpha_reserve * (solution.alpha - solution.alpha_lower)
    begin = None if start is None else start.center
    limit = TimeLimit.of(time_limit_s)
    center = force_center(problem, alpha / problem.virtual.unit, start=begin, limit=limit)
    if center is not None:
        answer = with_forces(problem, solution, center.shares, center.values, center.proof)
        return dataclasses.replace(answer, center=center)
    if has_interior(problem, limit):
        raise SolverError(
            f'no centre could be proved with alpha_reserve {alpha_reserve:g}: choose a larger '
            'one, or 0', problem, 'centering failed')
    return dataclasses.replace(solution, status=Status.OPTIMAL_NO_INTERIOR)


def with_forces(problem: ConicProblem, solution: Solution, shares: Array, values: Array,
                proof: Proof) -> Solution:
    """
    Replace the forces of a solved task by others that are admissible, and alpha by theirs.

    Parameters
    ----------
    problem : ConicProblem
        Of the task.
    solution : Solution
        Its feasible answer.
    shares : (k, 4) array
        Local forces [t1/mu, t2/mu, n, m_n/gamma] as shares of the caps.
    values : (t,) array
        Variables of the virtual contact that balance them.
    proof : Proof
        Of these forces, from ``prove``.

    """
    alpha, wrench = task_share(problem, values, solution.alpha_upper)
    unit = problem.virtual.unit
    loaded = shares[:, 2] > friction_cone.UNLOADED
    return dataclasses.replace(
        solution, alpha=alpha, alpha_lower=min(solution.alpha_lower, alpha), wrench=wrench,
        forces=frozen(shares * problem.grasp.force_units),
        cone_usage=frozen(np.where(loaded, friction_cone.usage_of_shares(shares), 0.0)),
        proof=dataclasses.replace(
            proof, objective=alpha / unit, upper=solution.alpha_upper / unit,
            size=cast(Proof, solution.proof).size), center=None)

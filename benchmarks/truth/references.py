# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Predictions that the package does not make, stated in CVXPY from its grasp matrix and its cones.

What friction holds when the normal forces are given, and what remains of either prediction when
every cone is replaced by the pyramid of its four edges along t1 and t2 (and, of a soft finger,
the two along m_n), as before cones could be handled exactly.
"""

from typing import Any
import warnings

import cvxpy
from grasp_quality import Grasp
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
ROUNDING = 1e-7              # by which normal forces may miss balance, as a share of themselves


def held_interval(grasp: Grasp, normals: Array, wrench: Array,
                  four_edges: bool = False) -> tuple[float, float]:
    """
    Return the smallest and the largest factor on a wrench that friction holds; nan for none.

    Parameters
    ----------
    grasp : Grasp
        The contacts.
    normals : ndarray, shape (k,)
        Normal forces [N].
    wrench : ndarray, shape (6,)
        Applied by the fingers, object frame [N, N m].
    four_edges : bool
        Whether the cones are replaced by pyramids.

    """
    factor, sides = cvxpy.Variable(), cvxpy.Variable((len(grasp), 3))
    constraints = [_balance(grasp, normals, sides, factor * wrench),
                   _norms(sides, four_edges) <= normals + ROUNDING * normals.max()]
    ends = []
    for objective in (cvxpy.Minimize(factor), cvxpy.Maximize(factor)):
        solved = _solve(cvxpy.Problem(objective, constraints))
        ends.append(float(factor.value) if solved else np.nan)
    return ends[0], ends[1]


def four_edged_alpha(grasp: Grasp, wrench: Array) -> float:
    """Return the largest factor on a wrench (6,) under the caps, cones replaced by pyramids."""
    factor, sides = cvxpy.Variable(), cvxpy.Variable((len(grasp), 3))
    normals = cvxpy.Variable(len(grasp))
    problem = cvxpy.Problem(cvxpy.Maximize(factor), [
        _balance(grasp, normals, sides, factor * wrench),
        _norms(sides, True) <= normals, normals <= grasp.max_normal_forces])
    problem.solve(solver=cvxpy.CLARABEL)
    return float(factor.value)


def _solve(problem: Any) -> bool:
    """Solve in full, by one solver or another; return whether there is a solution at all."""
    for solver in (cvxpy.CLARABEL, cvxpy.ECOS):
        with warnings.catch_warnings():  # that it may be inaccurate is what the status says
            warnings.simplefilter('ignore', UserWarning)
            problem.solve(solver=solver)
        if problem.status in (cvxpy.OPTIMAL, cvxpy.INFEASIBLE):
            return bool(problem.status == cvxpy.OPTIMAL)
    raise RuntimeError(f'the reference was not solved: {problem.status}')


def _balance(grasp: Grasp, normals: Any, sides: Any, wrench: Any) -> Any:
    """Return G x = wrench; sides are t1/mu, t2/mu, m_n/gamma of every contact, (k, 3) [N]."""
    matrix = grasp.matrix * grasp.scales    # (6, k, 4)
    total = matrix[:, :, 2] @ normals - wrench
    for column, coordinate in enumerate((0, 1, 3)):
        total = total + matrix[:, :, coordinate] @ sides[:, column]
    return cvxpy.multiply(np.repeat([1.0, 1.0 / grasp.lever_arm], 3), total) == 0.0


def _norms(sides: Any, four_edges: bool) -> Any:
    """Return the norm of every contact's scaled side forces, (k,) [N]."""
    return cvxpy.norm(sides, 1 if four_edges else 2, axis=1)

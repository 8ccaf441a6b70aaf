# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Kinks of alpha: where the optimum is not unique, so that slopes differ to either side.

For max_x min_lambda L the slope of alpha along a change dG of the grasp matrix (caps and friction
enter it too, in shares of the caps) is max over optimal x, min over optimal lambda, of
lambda . dG x. With one x and one lambda that is a derivative; else it depends on the direction.

One x: the columns of E on the faces that the optimal multipliers leave to u are independent. One
lambda: those tangent to the cones at u span all equations (Alizadeh and Goldfarb, 2003). Both take
strict complementarity for granted, and where that fails there is no telling, which counts as
not unique.
"""

from dataclasses import dataclass

from grasp_quality import clarabel_solver, kernel_solver
from grasp_quality.problem import ConicProblem
from grasp_quality.raw_answer import RawAnswer
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
COMPLEMENTARY = 3e-4  # share of one below which u and z both count as zero
INDEPENDENT = 1e-4    # of the largest singular value of columns of norm one
BY_SHARPNESS = sorted(range(len(clarabel_solver.ATTEMPTS)),
                      key=lambda attempt: clarabel_solver.ATTEMPTS[attempt][0])


@dataclass(frozen=True)
class Uniqueness:
    """
    Whether an optimum is the only one.

    Attributes
    ----------
    forces, multipliers : bool
        Whether the optimal forces, and the optimal multipliers, are unique.

    """

    forces: bool
    multipliers: bool

    @property
    def smooth(self) -> bool:
        """Whether alpha has a derivative here."""
        return self.forces and self.multipliers


def uniqueness(problem: ConicProblem, limit: TimeLimit | None = None) -> Uniqueness:
    """
    Tell whether forces and multipliers of a feasible problem are unique.

    Parameters
    ----------
    problem : ConicProblem
        Of a task wrench or cone; solved here once more, as sharply as it can be.
    limit : TimeLimit, optional
        Of the question that this is part of.

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    answer = _sharp_answer(problem, limit)
    if answer is None:
        return Uniqueness(False, False)
    u, z = _primal(problem, answer), problem.E.T @ answer.multipliers - problem.c
    free: list[Array] = []      # columns that optimal forces may differ by
    tangent: list[Array] = []   # columns that the multipliers are fixed by
    strict = True
    for block in problem.layout.blocks:
        columns = block[block >= 0]
        strict &= _sort(problem.E[:, columns], u[columns], z[columns], free, tangent)
    rows = np.abs(problem.E).max(axis=1) > 0.0
    forces = _smallest(np.column_stack(free)[rows])
    multipliers = _smallest(np.column_stack(tangent)[rows].T) if tangent else 0.0
    return Uniqueness(strict and forces > INDEPENDENT, strict and multipliers > INDEPENDENT)


def _sharp_answer(problem: ConicProblem, limit: TimeLimit | None) -> RawAnswer | None:
    for attempt in BY_SHARPNESS:
        answer: RawAnswer = clarabel_solver.run(problem, attempt, limit)
        if answer.solved:
            return answer
    if kernel_solver.handles(problem):
        answer = kernel_solver.run(problem, limit)
    return answer if answer.solved else None


def _primal(problem: ConicProblem, answer: RawAnswer) -> Array:
    """Variables u, slacks worked out from the equations."""
    layout = problem.layout
    u = np.zeros(layout.shape[1])
    u[layout.contact_variables] = answer.shares.ravel()[layout.contact_source]
    u[layout.virtual] = answer.values
    known = np.zeros(layout.shape[1], dtype=bool)
    known[layout.contact_variables] = known[layout.virtual] = True
    rest = problem.e - problem.E[:, known] @ u[known]
    u[~known] = np.linalg.lstsq(problem.E[:, ~known], rest, rcond=None)[0]
    return u


def _sort(E: Array, u: Array, z: Array, free: list[Array], tangent: list[Array]) -> bool:
    """Add the columns of one cone to the lists; False where it cannot be told where u stands."""
    norm_u, norm_z = np.linalg.norm(u[1:]), np.linalg.norm(z[1:])
    if len(u) == 1 or max(u[0] - norm_u, 0.0) > z[0] + norm_z:  # a half line, or inside the cone
        if u[0] > z[0]:
            free.extend(E.T)
            tangent.extend(E.T)
        return bool(max(u[0] - norm_u, z[0] + norm_z) > COMPLEMENTARY)
    if u[0] + norm_u <= z[0] - norm_z:  # at the tip
        return bool(z[0] - norm_z > COMPLEMENTARY)
    axis = u[1:] / norm_u
    ray = E[:, 0] + E[:, 1:] @ axis
    free.append(ray)
    tangent.append(ray)
    sideways = np.linalg.svd(axis[None])[2][1:]  # orthogonal to the friction force
    tangent.extend((E[:, 1:] @ sideways.T).T)
    return bool(min(u[0] + norm_u, z[0] + norm_z) > COMPLEMENTARY)


def _smallest(columns: Array) -> float:
    """Smallest singular value of columns of norm one, over the largest; 0 for too many."""
    norms = np.linalg.norm(columns, axis=0)
    columns = columns[:, norms > 0.0] / norms[norms > 0.0]
    if columns.shape[1] > columns.shape[0]:
        return 0.0
    values = np.linalg.svd(columns, compute_uv=False)
    return float(values[-1] / values[0])

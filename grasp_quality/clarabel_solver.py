# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Clarabel, called directly on a conic program.

Clarabel takes min q.x, A x + s = b, s in K. Our standard form is its dual: with A = -E^T, b = -c
and q = e, its multipliers are our variables u, kept inside the cones by the interior-point method,
and its x are our multipliers. The matrix then has one column an equation, which is smaller to
factor than one column a force (docs/decisions.md). Whatever Clarabel throws, its panics included,
leaves here as a SolverError with the problem attached.
"""

from functools import lru_cache
from typing import Any

import clarabel
from grasp_quality.arrays import Array
from grasp_quality.exceptions import SolverError, SolverTimeoutError
from grasp_quality.layout import Cones
from grasp_quality.problem import ConicProblem
from grasp_quality.raw_answer import RawAnswer
from grasp_quality.time_limit import TimeLimit
import numpy as np
from scipy.sparse import csc_matrix

# (gap, feasibility, static regularisation, equilibration), tried in order until the proof holds;
# the first is met by 99 of 100 problems, the others by what it leaves (docs/decisions.md)
ATTEMPTS = (
    (3e-10, 3e-9, 1e-8, True),
    (1e-10, 1e-9, 1e-12, False),
    (3e-8, 3e-9, 1e-8, False),
    (3e-10, 3e-9, 1e-8, False),
    (1e-11, 1e-11, 1e-13, True))
CONES = {'nonnegative': clarabel.NonnegativeConeT, 'second_order': clarabel.SecondOrderConeT}


def run(problem: ConicProblem, attempt: int = 0, limit: TimeLimit | None = None) -> RawAnswer:
    """
    Solve a ConicProblem once.

    Parameters
    ----------
    problem : ConicProblem
        Program in scaled standard form.
    attempt : int
        Which of ``ATTEMPTS`` to make.
    limit : TimeLimit, optional
        Of the question that this is an attempt at.

    Returns
    -------
    RawAnswer

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    rows, variables = problem.layout.shape
    matrix = csc_matrix(
        (-problem.equation_values, problem.layout.row_columns, problem.layout.row_starts),
        shape=(variables, rows))
    u, multipliers, status = run_matrices(
        _zeros(rows), problem.e, matrix, -problem.c, _cones(problem.cones),
        solver_settings(attempt, None if limit is None else limit.remaining_s(problem)), problem)
    return RawAnswer(problem.layout.shares(u), u[problem.layout.virtual], multipliers, status)


def run_matrices(P: csc_matrix, q: Array, A: csc_matrix, b: Array, cones: list[Any],
                 settings: clarabel.DefaultSettings,
                 problem: ConicProblem) -> tuple[Array, Array, str]:
    """Hand matrices to Clarabel for (z, x, status); ``problem`` is what a SolverError carries."""
    try:
        solution = clarabel.DefaultSolver(P, q, A, b, cones, settings).solve()
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as exc:  # Clarabel's panics derive from BaseException
        raise SolverError(f'Clarabel failed: {exc}', problem, type(exc).__name__) from exc
    status = str(solution.status)
    if status == 'MaxTime':
        raise SolverTimeoutError(
            'the solver reached its time limit; raise it or ask for less', problem, status)
    return np.array(solution.z), np.array(solution.x), status


@lru_cache(maxsize=256)
def _zeros(size: int) -> csc_matrix:
    return csc_matrix((size, size))


@lru_cache(maxsize=256)
def _cones(cones: Cones) -> list[Any]:
    return [CONES[kind](size) for kind, size in cones]


def solver_settings(attempt: int, time_limit_s: float | None) -> clarabel.DefaultSettings:
    """Build settings of one of ``ATTEMPTS``."""
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    gap, feasibility, regularisation, equilibrate = ATTEMPTS[attempt]
    settings.tol_gap_abs = settings.tol_gap_rel = gap
    settings.tol_feas = feasibility
    settings.static_regularization_constant = regularisation
    settings.equilibrate_enable = equilibrate
    if time_limit_s is not None:
        settings.time_limit = time_limit_s
    return settings

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Clarabel as it is called: its answers, its time limit, and its panics as our own errors."""

import clarabel
from grasp_quality import build_problem, SolverError, SolverTimeoutError, TaskWrench
from grasp_quality.clarabel_solver import ATTEMPTS, run, run_matrices
from grasp_quality.time_limit import TimeLimit
from known_grasps import antipodal, FX, FY
import numpy as np
import pytest
from scipy.sparse import csc_matrix
from tolerances import SOLVER

NONNEGATIVE, SECOND_ORDER = clarabel.NonnegativeConeT, clarabel.SecondOrderConeT
ONE = csc_matrix(np.eye(1))


def quiet():
    """Return settings that print nothing."""
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    return settings


@pytest.mark.parametrize('attempt', range(len(ATTEMPTS)))
@pytest.mark.parametrize('bound, expected', [('linf', 1.0), ('l2', np.sqrt(0.5)), ('l1', 0.5)])
def test_every_attempt_solves_an_ordinary_problem(attempt, bound, expected):
    problem = build_problem(antipodal(0.5, bound=bound), TaskWrench(FY))
    answer = run(problem, attempt)
    assert answer.solved
    assert answer.values[0] * problem.virtual.unit == pytest.approx(expected, rel=SOLVER)
    assert answer.shares.shape == (2, 4)
    assert answer.multipliers.shape == (problem.layout.shape[0],)


def test_an_overload_is_no_solution():
    problem = build_problem(antipodal(0.5), TaskWrench(FX), external_wrench=-2.0 * FY)
    assert not run(problem).solved


def test_time_limit():
    problem = build_problem(antipodal(0.5), TaskWrench(FY))
    with pytest.raises(SolverTimeoutError, match='time limit') as caught:
        run(problem, limit=TimeLimit(1e-9))
    assert caught.value.problem is problem


def test_the_solver_s_own_clock_ends_as_a_timeout_too():
    settings = quiet()
    settings.time_limit = 1e-12
    with pytest.raises(SolverTimeoutError, match='raise it or ask for less') as caught:
        run_matrices(csc_matrix((1, 1)), np.ones(1), -ONE, -np.ones(1), [NONNEGATIVE(1)], settings,
                     'the problem')
    assert (caught.value.problem, caught.value.status) == ('the problem', 'MaxTime')


@pytest.mark.parametrize('matrices', [
    (ONE, np.zeros(2), ONE, np.zeros(1), [NONNEGATIVE(1)]),            # q too long
    (csc_matrix((2, 2)), np.zeros(1), ONE, np.zeros(1), [NONNEGATIVE(1)]),  # P too large
    (ONE, np.zeros(1), ONE, np.zeros(2), [NONNEGATIVE(1)]),            # b too long
    (ONE, np.zeros(1), ONE, np.zeros(1), [NONNEGATIVE(3)]),            # cone too large
    (ONE, np.zeros(1), ONE, np.zeros(1), []),                          # no cone
    (ONE, np.zeros(1), 'matrix', np.zeros(1), [NONNEGATIVE(1)]),       # not a matrix
    (ONE, None, ONE, np.zeros(1), [NONNEGATIVE(1)]),
    (ONE, np.zeros(1), ONE, np.zeros(1), ['cone']),
])
def test_malformed_matrices_end_as_solver_errors(matrices):
    with pytest.raises(SolverError, match='Clarabel failed') as caught:
        run_matrices(*matrices, quiet(), 'the problem')
    assert caught.value.problem == 'the problem'
    assert caught.value.status
    assert caught.value.__cause__ is not None


def test_numbers_that_are_none_do_not_count_as_solved():
    _, _, status = run_matrices(
        csc_matrix((1, 1)), np.array([np.nan]), ONE, np.zeros(1), [NONNEGATIVE(1)], quiet(), None)
    assert status != 'Solved'


def test_interrupts_pass_through():
    class Interrupting:
        """A matrix that cannot be read."""

        def __getattr__(self, name):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_matrices(
            ONE, np.zeros(1), Interrupting(), np.zeros(1), [SECOND_ORDER(1)], quiet(), None)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""All known answers of cases.json."""

from answer_checks import check_task_wrench
from benchmarks.cases import CASES, evaluate_case, grasp_of
from grasp_quality import ball_radius, Status
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def cases(kind):
    """Parametrize over the cases of a kind, by their ids."""
    return pytest.mark.parametrize('case', CASES[kind], ids=[c['id'] for c in CASES[kind]])


@cases('task_wrench')
def test_task_wrench(case):
    solution = evaluate_case('task_wrench', case)
    check_task_wrench(solution, case['task_wrench'], case['external_wrench'])
    if case['alpha'] is None:
        assert solution.status is Status.INFEASIBLE
    else:
        assert solution.status is Status.OPTIMAL
        assert solution.alpha == pytest.approx(case['alpha'], rel=SOLVER, abs=SOLVER)


@cases('task_cone')
def test_task_cone(case):
    solution = evaluate_case('task_cone', case)
    assert solution.alpha == pytest.approx(case['alpha'], rel=SOLVER)
    assert solution.wrench == pytest.approx(np.array(case['wrench']), abs=SOLVER)


@cases('barrier')
def test_barrier(case):
    solution = evaluate_case('barrier', case)
    assert solution.alpha == pytest.approx(case['alpha'], rel=SOLVER)


@cases('polytope')
def test_polytope(case):
    solution = evaluate_case('polytope', case)
    assert solution.alphas == pytest.approx(np.array(case['alphas']), rel=SOLVER)
    assert solution.parallelotope_scale == pytest.approx(case['parallelotope_scale'], rel=SOLVER)


@cases('ball_radius')
def test_ball_radius(case):
    found = ball_radius(grasp_of(case), case['torque_length'])
    assert found.lower <= case['radius'] <= found.upper
    assert found.reached and found.width <= 0.01 + CLOSED_FORM


def test_no_case_is_left_out():
    tested = {'task_wrench', 'task_cone', 'barrier', 'polytope', 'ball_radius'}
    assert set(CASES) - tested == {'conventions'}

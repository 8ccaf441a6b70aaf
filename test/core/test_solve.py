# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""From proved answers to solutions."""

from grasp_quality import (
    build_problem, ConeSolution, evaluate, Solution, solve, Status, TaskCone, TaskWrench)
from grasp_quality.solve import prove_optimal, task_share
from known_grasps import antipodal, FX, FY, FZ, single, three_finger
import numpy as np
import pytest
from tolerances import SOLVER


def test_solve_is_the_second_public_step():
    problem = build_problem(three_finger(), TaskWrench(FY), external_wrench=-0.1 * FZ)
    solution = solve(problem)
    direct = evaluate(three_finger(), TaskWrench(FY), external_wrench=-0.1 * FZ)
    assert type(solution) is Solution
    assert solution.alpha == pytest.approx(direct.alpha, rel=SOLVER)


def test_solve_of_a_cone():
    solution = solve(build_problem(three_finger(), TaskCone(-FX, FY, FZ, 0.3)))
    assert type(solution) is ConeSolution
    assert solution.alpha == pytest.approx(1.0 + np.sqrt(0.75), rel=SOLVER)


def test_infeasible_is_none():
    problem = build_problem(antipodal(0.5), TaskWrench(FX), external_wrench=-2.0 * FY)
    assert prove_optimal(problem) is None
    assert solve(problem).status is Status.INFEASIBLE


@pytest.mark.parametrize('value, upper, alpha', [
    (0.5, 0.6, 0.5), (0.5, 0.4999, 0.4999), (-1e-12, 0.1, 0.0), (0.0, 0.0, 0.0)])
def test_alpha_stays_between_zero_and_its_upper_bound(value, upper, alpha):
    problem = build_problem(antipodal(0.5), TaskWrench(FY))
    unit = problem.virtual.unit
    found, wrench = task_share(problem, np.array([value]), upper * unit)
    assert found == pytest.approx(alpha * unit)
    assert wrench == pytest.approx(alpha * unit * FY)


def test_a_push_that_nothing_resists_loads_only_its_own_contact():
    solution = evaluate(antipodal(0.5), TaskWrench(FX))
    assert solution.forces[:, 2] == pytest.approx([1.0, 0.0], abs=1e-5)
    assert (solution.cone_usage <= 1.0 + 1e-9).all()


def test_zero_is_an_answer_too():
    solution = evaluate(single(), TaskWrench(-FX))
    assert solution.status is Status.OPTIMAL and solution.feasible
    assert solution.alpha == pytest.approx(0.0, abs=SOLVER)
    assert solution.holdable and not solution.pinned

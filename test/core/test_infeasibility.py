# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A direction proves infeasibility only where no forces do what the load asks for."""

from grasp_quality import build_problem, evaluate, Grasp, JointLimits, TaskCone, TaskWrench
from grasp_quality.infeasibility import infeasibility_margin
from known_grasps import antipodal, FX, FY, FZ
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def test_infeasibility_is_a_distance():
    """Two fingers with mu = 0.5 carry one newton across; the load is 1.5."""
    problem = build_problem(antipodal(0.5), TaskWrench(FX), external_wrench=-1.5 * FY)
    reach = problem.reach
    assert infeasibility_margin(problem, FY) == pytest.approx(0.5 / reach, rel=CLOSED_FORM)
    assert infeasibility_margin(problem, FY + 0.3 * FX) <= 0.5 / reach
    assert infeasibility_margin(problem, -FY) < 0.0


@pytest.mark.parametrize('direction', [
    np.zeros(6), np.full(6, np.nan), np.full(6, np.inf), np.full(6, 1e300), np.full(6, 5e-324)])
@pytest.mark.parametrize('task', [TaskWrench(FX), TaskCone(FX, FY, FZ, 0.2)])
def test_infeasibility_is_not_proved_by_rubbish(task, direction):
    problem = build_problem(antipodal(0.5), task, external_wrench=-0.5 * FY)
    assert not infeasibility_margin(problem, direction) > 0.0


@pytest.mark.parametrize('task', [
    TaskWrench(FY), TaskCone(FY, FX, 0.4 * FX, 0.9), TaskCone(FY, 3.0 * FY, FX, 0.3)])
def test_a_feasible_load_is_never_proved_infeasible(task):
    """Along any direction, with a task that could help: the load alone exceeds the grasp."""
    problem = build_problem(antipodal(0.5), task, external_wrench=1.5 * FY)
    assert evaluate(antipodal(0.5), task, external_wrench=1.5 * FY).alpha > 0.5
    rng = np.random.default_rng(0)
    for _ in range(300):
        assert infeasibility_margin(problem, rng.normal(size=6)) <= 1e-12


def test_joints_that_cannot_carry_the_hand_need_no_load():
    """Gravity takes 0.04 N m of a motor that has 0.03; the contact can take 0.1 N m."""
    matrix = np.zeros((1, 2, 4))
    matrix[0, 1, 2] = -0.1
    for gravity, proved in ((0.04, False), (0.14, True)):
        grasp = Grasp(antipodal().contacts, joint_limits=JointLimits(
            ['knuckle'], [0.03], matrix, [gravity]))
        problem = build_problem(grasp, TaskWrench(FX))
        direction = np.append(np.zeros(6), 1.0)
        assert (infeasibility_margin(problem, direction) > 0.0) == proved
        assert not infeasibility_margin(problem, -direction) > 0.0
        assert (evaluate(grasp, TaskWrench(-FX)).feasible) != proved

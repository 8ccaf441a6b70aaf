# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Forces that follow a goal no faster than allowed, each of them admissible for its contacts."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import build_problem, Contact, evaluate, Grasp, TaskCone, TaskWrench
from grasp_quality.follow import follow
from known_grasps import antipodal, FX, FY, FZ, single, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def answer(grasp, task, load=None, reserve=0.05):
    """Problem and answer of a task."""
    return (build_problem(grasp, task, load),
            evaluate(grasp, task, external_wrench=load, alpha_reserve=reserve))


def test_a_goal_within_reach_is_taken_as_it_is():
    problem, goal = answer(three_finger(), TaskWrench(FZ))
    found = follow(problem, goal, goal.forces * 0.99, 1.0)
    assert found.solution is goal and not found.limited


@pytest.mark.parametrize('bound', BOUNDS)
def test_every_step_is_admissible_and_no_longer_than_allowed(bound):
    """From the forces of one task to those of another, on contacts that stand still."""
    for seed in range(3):
        rng = np.random.default_rng(seed)
        grasp, load = random_grasp(rng, count=5, bound=bound), None
        if seed:
            load = random_load(rng, grasp)
        tasks = [TaskWrench(rng.normal(size=6)) for _ in range(2)]
        forces = evaluate(grasp, tasks[0], load, alpha_reserve=0.05).forces
        problem, goal = answer(grasp, tasks[1], load)
        first = follow(problem, goal, forces, 1e-3).largest_change
        change = max(1.5 * first, 0.05)  # the first step leaves the other task at once
        for _ in range(200):
            found = follow(problem, goal, forces, change)
            check_forces(grasp, found.solution.forces, found.solution.wrench, load)
            assert found.largest_change <= change * (1.0 + SOLVER)
            assert found.solution.alpha <= goal.alpha_upper
            forces = found.solution.forces
            if not found.limited:
                break
        assert found.solution is goal


def test_contacts_that_leave_no_choice_come_before_the_limit():
    """A finger that has moved cannot press as before: the nearest admissible forces come out."""
    problem, goal = answer(antipodal(0.5), TaskWrench(FY))
    skewed = np.array([[0.0, 0.4, 1.0, 0.0], [0.0, 0.4, 0.5, 0.0]])  # not in equilibrium
    found = follow(problem, goal, skewed, 1e-3)
    assert found.limited and found.largest_change > 0.1
    check_forces(antipodal(0.5), found.solution.forces, found.solution.wrench)


def test_alpha_is_what_the_forces_apply():
    problem, goal = answer(antipodal(0.5), TaskWrench(FY))
    still = np.array([[0.0, 0.0, 0.9, 0.0]] * 2)
    found = follow(problem, goal, still, 0.1)
    assert 0.0 < found.solution.alpha < goal.alpha
    assert found.solution.alpha_upper == goal.alpha_upper
    assert found.solution.wrench == pytest.approx(found.solution.alpha * FY, abs=CLOSED_FORM)
    assert antipodal(0.5).wrench(found.solution.forces) == pytest.approx(
        found.solution.wrench, abs=1e-7)


def test_a_task_cone_too():
    task = TaskCone(-FX, FY, FZ, 0.4)
    problem, goal = answer(three_finger(), task)
    found = follow(problem, goal, np.zeros((3, 4)), 0.2)
    assert found.limited and found.largest_change <= 0.2 * (1.0 + SOLVER)
    check_forces(three_finger(), found.solution.forces, found.solution.wrench)


def test_forces_on_the_edge_of_the_cones_can_be_a_goal():
    """Without a reserve both ends of the way are on edges of the set."""
    problem, goal = answer(antipodal(0.5), TaskWrench(FY), reserve=0.0)
    found = follow(problem, goal, np.array([[0.0, 0.0, 1.0, 0.0]] * 2), 0.3)
    check_forces(antipodal(0.5), found.solution.forces, found.solution.wrench)
    assert found.solution.alpha == pytest.approx(0.6, abs=1e-4)  # 0.3 N each
    assert found.largest_change <= 0.3 * (1.0 + SOLVER)


def test_one_finger_that_may_only_push():
    grasp = Grasp([Contact(position=(0, 0, 0), normal=(1, 0, 0), friction=0.0)])
    problem, goal = answer(grasp, TaskWrench(FX))
    found = follow(problem, goal, np.zeros((1, 4)), 0.25)
    assert found.solution.alpha == pytest.approx(0.25, rel=SOLVER)
    assert single().wrench(found.solution.forces)[0] == pytest.approx(0.25, rel=SOLVER)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The second stage: unique forces with margin at a little less than the largest alpha."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    evaluate, hold_forces, InvalidTaskError, Status, TaskCone, TaskPolytope, TaskWrench)
from known_grasps import antipodal, cube_of_eight, FX, FY, FZ, single, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


@pytest.mark.parametrize('bound', BOUNDS)
def test_alpha_gives_up_its_share_and_forces_gain_margin(bound):
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp, wrench = random_grasp(rng, count=6, bound=bound), rng.normal(size=6)
        load = random_load(rng, grasp) if seed % 2 else None
        plain = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
        margins = []
        for d in (0.02, 0.2, 0.5):
            solution = evaluate(
                grasp, TaskWrench(wrench), external_wrench=load, alpha_reserve=d)
            assert solution.status is Status.OPTIMAL
            assert solution.alpha == pytest.approx(
                plain.alpha - d * (plain.alpha - plain.alpha_lower), rel=CLOSED_FORM)
            assert solution.alpha_upper == plain.alpha_upper
            assert (solution.dalpha_dmax_force == plain.dalpha_dmax_force).all()
            check_forces(grasp, solution.forces, solution.wrench, load)
            assert np.allclose(solution.wrench, solution.alpha * wrench, rtol=CLOSED_FORM, atol=0)
            margins.append(solution.friction_margin)
        assert margins[0] > 0.0 and margins[2] > margins[0]


def test_these_are_the_forces_to_hold_with():
    solution = evaluate(three_finger(), TaskWrench(FZ), -0.2 * FX, alpha_reserve=0.3)
    held = hold_forces(three_finger(), -0.2 * FX, FZ, solution.alpha)
    assert solution.forces == pytest.approx(held.forces, abs=CLOSED_FORM)


def test_equal_contacts_get_equal_forces():
    """At eps = 0 any split among the four contacts of a face would do."""
    forces = evaluate(cube_of_eight(), TaskWrench(FX), alpha_reserve=0.05).forces
    assert forces[:4, 2] == pytest.approx(forces[0, 2], rel=CLOSED_FORM)
    assert forces[4:, 2] == pytest.approx(forces[4, 2], rel=CLOSED_FORM)


def test_a_cone_keeps_its_own_wrench_inside():
    task = TaskCone(-FX, FY, FZ, 0.5)
    plain = evaluate(three_finger(), task)
    solution = evaluate(three_finger(), task, alpha_reserve=0.1)
    assert solution.alpha == pytest.approx(0.9 * plain.alpha, rel=CLOSED_FORM)
    check_forces(three_finger(), solution.forces, solution.wrench)
    assert -solution.wrench[0] == pytest.approx(solution.alpha, rel=CLOSED_FORM)
    assert np.hypot(*solution.wrench[1:3]) < np.tan(0.5) * solution.alpha
    assert solution.friction_margin > 0.0


def test_each_wrench_of_a_polytope_has_its_own():
    plain = evaluate(antipodal(), TaskPolytope([FY, FZ]))
    answer = evaluate(antipodal(), TaskPolytope([FY, FZ]), alpha_reserve=0.1)
    assert answer.alphas == pytest.approx(0.9 * plain.alphas, rel=SOLVER)


def test_a_start_changes_the_time_only():
    first = evaluate(three_finger(), TaskWrench(FZ), alpha_reserve=0.05)
    warm = evaluate(three_finger(0.52), TaskWrench(FZ), alpha_reserve=0.05, start=first)
    cold = evaluate(three_finger(0.52), TaskWrench(FZ), alpha_reserve=0.05)
    assert warm.forces == pytest.approx(cold.forces, abs=CLOSED_FORM)


def test_without_an_interior_the_forces_stay_and_the_status_tells():
    """A load on the very edge of the cones leaves no room, whatever alpha gives up."""
    solution = evaluate(antipodal(0.5), TaskWrench(FX), -FZ, alpha_reserve=0.1)
    assert solution.status is Status.OPTIMAL_NO_INTERIOR
    check_forces(antipodal(0.5), solution.forces, solution.wrench, -FZ)


def test_infeasible_stays_infeasible():
    solution = evaluate(single(), TaskWrench(FX), -2.0 * FX, alpha_reserve=0.1)
    assert solution.status is Status.INFEASIBLE and solution.forces.shape == (0, 4)


def test_two_ways_to_buy_margin_are_one_too_many():
    with pytest.raises(InvalidTaskError, match='set one of them to 0'):
        evaluate(antipodal(), TaskWrench(FY), barrier_weight=0.1, alpha_reserve=0.1)
    for bad in (-0.1, 1.0, np.nan):
        with pytest.raises(InvalidTaskError, match='alpha_reserve'):
            evaluate(antipodal(), TaskWrench(FY), alpha_reserve=bad)

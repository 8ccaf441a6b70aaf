# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Several wrenches: what is guaranteed, and the paper's eq. (19) refuted."""

from benchmarks.random_grasps import random_grasp
from grasp_quality import evaluate, minimum_forces, Status, TaskEllipsoid, TaskPolytope, TaskWrench
from known_grasps import antipodal, FX, FY, FZ, single, three_finger, TX, TZ
import numpy as np
import pytest
from tolerances import SOLVER

SIX = np.vstack([np.eye(6), -np.eye(6)])


def test_corner_that_eq_19_promises_is_out_of_reach():
    """Tasks y and z reach one each, but not both at once: friction is round."""
    solution = evaluate(antipodal(0.5), TaskPolytope([FY, FZ]))
    assert solution.alphas == pytest.approx([1.0, 1.0], rel=SOLVER)
    corner = solution.alphas @ np.stack([FY, FZ])
    assert minimum_forces(antipodal(0.5), -corner).status is Status.INFEASIBLE
    assert solution.parallelotope_scale == pytest.approx(1.0 / np.sqrt(2.0), rel=SOLVER)
    held = minimum_forces(antipodal(0.5), -corner * solution.parallelotope_scale * (1.0 - 1e-6))
    assert held.status is Status.OPTIMAL


def test_what_convexity_guarantees():
    for seed in range(8):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=7)
        task = TaskPolytope(rng.normal(size=(4, 6)))
        solution = evaluate(grasp, task)
        mix = rng.dirichlet(np.ones(4)) * solution.alphas @ task.wrenches
        assert minimum_forces(grasp, -mix).peak <= 1.0 + SOLVER
        if solution.parallelotope_scale > 1e-6:
            corner = (rng.integers(0, 2, 4) * solution.alphas) @ task.wrenches
            held = minimum_forces(grasp, -corner * solution.parallelotope_scale)
            assert held.peak <= 1.0 + 1e-5


def test_quality_is_the_weighted_sum():
    grasp = three_finger(0.5)
    weighted = evaluate(grasp, TaskPolytope([FX, -FX, FZ], [1.0, 2.0, 4.0]))
    assert weighted.alphas == pytest.approx([1.0, 1.0 + np.sqrt(0.75), 1.5], rel=SOLVER)
    assert weighted.quality == pytest.approx(weighted.alphas @ [1.0, 2.0, 4.0], rel=SOLVER)
    assert weighted.alpha_min == pytest.approx(1.0, rel=SOLVER)
    mean = evaluate(grasp, TaskPolytope([FX, -FX, FZ]))
    assert mean.quality == pytest.approx(mean.alphas.mean(), rel=SOLVER)
    assert mean.forces.shape == (3, 3, 4) and len(mean.solutions) == 3


def test_opposite_wrenches_cancel_in_a_corner():
    solution = evaluate(antipodal(0.5), TaskPolytope([FY, -FY]))
    assert solution.parallelotope_scale == pytest.approx(1.0, rel=SOLVER)


def test_a_single_wrench_is_its_own_parallelotope():
    assert evaluate(antipodal(0.5), TaskPolytope([FY])).parallelotope_scale == 1.0


def test_more_than_eight_wrenches_have_no_parallelotope_scale():
    solution = evaluate(three_finger(), TaskPolytope(SIX))
    assert solution.feasible and solution.parallelotope_scale is None
    assert solution.alphas.shape == (12,)


def test_infeasible_when_one_wrench_is():
    solution = evaluate(single(), TaskPolytope([FX, FY]), external_wrench=-2.0 * FX)
    assert solution.status is Status.INFEASIBLE and not solution.feasible
    assert (solution.quality, solution.parallelotope_scale) == (0.0, 0.0)
    assert solution.forces.shape == (0, 1, 4) and solution.alphas.shape == (2,)


def test_load_takes_its_share_of_the_scale():
    free = evaluate(antipodal(0.5), TaskPolytope([FY, FZ]))
    loaded = evaluate(antipodal(0.5), TaskPolytope([FY, FZ]), external_wrench=-0.4 * FY)
    assert loaded.alphas[0] == pytest.approx(0.6, rel=SOLVER)
    assert loaded.alpha_min < free.alpha_min
    # corner (0.6, a) s with the load: (0.4 + 0.6 s)^2 + (a s)^2 = 1
    a, s = loaded.alphas[1], loaded.parallelotope_scale
    assert np.hypot(0.4 + 0.6 * s, a * s) == pytest.approx(1.0, rel=1e-5)


def test_ellipsoid_guarantee_holds_on_its_whole_surface():
    for seed in range(5):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=8)
        axes = rng.normal(size=(3, 6))
        solution = evaluate(grasp, TaskEllipsoid(axes))
        assert solution.guaranteed_scale == pytest.approx(
            solution.alpha_min / np.sqrt(3.0), rel=SOLVER)
        directions = rng.normal(size=(20, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        for wrench in solution.guaranteed_scale * directions @ axes:
            if wrench.any():
                assert minimum_forces(grasp, -wrench).peak <= 1.0 + 1e-5


@pytest.mark.parametrize('load', [None, -2.0 * FY])
def test_ellipsoid_in_a_deficient_grasp_guarantees_nothing(load):
    solution = evaluate(antipodal(0.5), TaskEllipsoid([FY, TX]), external_wrench=load)
    assert solution.guaranteed_scale == pytest.approx(0.0, abs=SOLVER)


def test_polytope_agrees_with_its_wrenches_one_by_one():
    wrenches = [FX, FY + TZ, FZ - 0.2 * TX]
    solution = evaluate(three_finger(), TaskPolytope(wrenches))
    for one, alpha in zip(wrenches, solution.alphas):
        assert evaluate(three_finger(), TaskWrench(one)).alpha == pytest.approx(alpha, rel=SOLVER)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The admissible forces nearest to given ones: a projection onto a convex set."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import build_problem, TaskWrench
from grasp_quality.nearest import distances, nearest_forces
from known_grasps import antipodal, FY, FZ, single
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


@pytest.mark.parametrize('bound', BOUNDS)
def test_projection_is_admissible_idempotent_and_obtuse(bound):
    """(y - P y) . (z - P y) <= 0 for every admissible z."""
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=5, bound=bound)
        wrench, load = rng.normal(size=6), random_load(rng, grasp)
        problem = build_problem(grasp, TaskWrench(wrench), load)
        given = grasp.shares(grasp.force_units * rng.normal(size=(5, 4)) * 0.4)
        near = nearest_forces(problem, given)
        alpha = near.values[0] * problem.virtual.unit
        check_forces(grasp, near.shares * grasp.force_units, alpha * wrench, load)
        again = nearest_forces(problem, near.shares)
        # squares are what is minimised, and what the solver's tolerance is about
        assert (distances(problem, again.shares, near.shares) ** 2).max() <= CLOSED_FORM
        newtons = grasp.max_normal_forces[:, None] * np.where(
            grasp.scales > 0.0, [1.0, 1.0, 1.0, 1.0], 0.0) * np.where(
            np.arange(4) < 2, grasp.scales, 1.0)
        for _ in range(5):
            other = nearest_forces(problem, grasp.shares(
                grasp.force_units * rng.normal(size=(5, 4))))
            angle = ((given - near.shares) * (other.shares - near.shares) * newtons ** 2).sum()
            assert angle <= SOLVER


def test_a_pair_by_hand():
    """Two fingers that press too hard and slip: alpha free along y, nearest in newtons."""
    grasp = antipodal(0.5)
    problem = build_problem(grasp, TaskWrench(FY))
    forces = np.zeros((2, 4))
    forces[:, 2] = [1.4, 1.2]
    near = nearest_forces(problem, grasp.shares(forces))
    assert distances(problem, near.shares, grasp.shares(
        np.minimum(forces, 1.0))) ** 2 == pytest.approx([0.0, 0.0], abs=CLOSED_FORM)


def test_none_where_nothing_is_admissible():
    problem = build_problem(antipodal(0.5), TaskWrench(FY), -2.0 * FZ)
    assert nearest_forces(problem, np.zeros((2, 4))) is None


def test_distance_is_in_newtons_for_forces_and_moments():
    grasp = antipodal(0.5, torsional_friction=0.1, caps=(2.0, 4.0))
    problem = build_problem(grasp, TaskWrench(FY))
    one, other = np.zeros((2, 4)), np.zeros((2, 4))
    one[0], one[1] = [0.0, 3.0, 4.0, 0.0], [0.0, 0.0, 0.0, 0.2]
    found = distances(problem, grasp.shares(one), grasp.shares(other))
    assert found == pytest.approx([5.0, 2.0], rel=SOLVER)
    assert distances(build_problem(single(), TaskWrench(FY)), np.ones((1, 4)),
                     np.ones((1, 4))).tolist() == [0.0]

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured forces against what the grasp allows."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp
from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, InvalidTaskError, measured_margin, slip_margin,
    Status, TaskWrench)
from known_grasps import antipodal, FX, single
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def admissible(rng, grasp, size=0.5):
    """Return random forces strictly inside cones and caps."""
    shares = rng.normal(size=(len(grasp), 4))
    rest = np.linalg.norm(shares[:, [0, 1, 3]], axis=1, keepdims=True)
    shares *= size * rng.uniform(0.2, 0.8, (len(grasp), 1)) / rest
    shares[:, 2] = size
    return shares * grasp.force_units / len(grasp)


@pytest.mark.parametrize('bound', BOUNDS)
def test_the_change_restores_the_margin_keeps_the_wrench_and_no_smaller_one_does(bound):
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=5, bound=bound, models=(ContactModel.PCWF,))
        forces = admissible(rng, grasp)
        found = measured_margin(grasp, forces, 0.4)
        assert found.status is Status.OPTIMAL
        assert (found.slip_margins == slip_margin(grasp, forces)).all()
        assert found.load_alpha >= 1.0 - SOLVER and found.load_share <= 1.0 + SOLVER
        assert found.load_alpha == pytest.approx(
            evaluate(grasp, TaskWrench(grasp.wrench(forces))).alpha, rel=SOLVER)
        if not found.restorable:
            continue
        new = forces + found.change
        check_forces(grasp, new, grasp.wrench(forces))
        assert slip_margin(grasp, new).min() >= 0.4 - 1e-5
        assert found.sizes == pytest.approx(np.linalg.norm(found.change, axis=1))
        less = measured_margin(grasp, forces, 0.3)
        assert np.sum(less.change ** 2) <= np.sum(found.change ** 2) + CLOSED_FORM


def test_a_pair_by_hand():
    """2 N along y of each at n = 5: usage 0.8; margin 0.5 needs n = 8."""
    grasp = antipodal(0.5, caps=(10.0, 10.0))
    forces = np.array([[2.0, 0.0, 5.0, 0.0]] * 2)
    found = measured_margin(grasp, forces, 0.5)
    assert found.slip_margins == pytest.approx([0.2, 0.2], rel=CLOSED_FORM)
    assert found.load_share == pytest.approx(0.4, rel=SOLVER)
    assert found.sizes == pytest.approx([3.0, 3.0], abs=1e-4)
    assert found.change[:, 2] == pytest.approx([3.0, 3.0], abs=1e-4)


def test_nothing_to_restore_is_no_change_at_all():
    forces = np.array([[0.1, 0.0, 0.8, 0.0]] * 2)
    found = measured_margin(antipodal(0.5), forces, 0.5)
    assert found.restorable and not found.change.any() and not found.sizes.any()


def test_what_the_caps_forbid_is_brought_back_too():
    forces = np.array([[0.0, 0.0, 1.5, 0.0]] * 2)
    found = measured_margin(antipodal(0.5), forces, 0.2)
    assert found.load_share == 0.0 and found.load_alpha == 0.0
    assert found.change[:, 2] == pytest.approx([-0.5, -0.5], abs=1e-4)


def test_a_margin_out_of_reach():
    forces = np.array([[0.45, 0.0, 0.95, 0.0]] * 2)
    found = measured_margin(antipodal(0.5), forces, 0.5)
    assert not found.restorable and found.change is None and not found.sizes.any()
    assert found.load_share == pytest.approx(0.9, rel=SOLVER)


def test_a_wrench_that_no_forces_apply_is_infeasible():
    found = measured_margin(single(), [[0.0, 0.0, -0.5, 0.0]])
    assert found.status is Status.INFEASIBLE
    assert (found.load_alpha, found.load_share) == (0.0, 0.0)


def test_a_point_contact_says_nothing_of_moments():
    grasp = antipodal(0.5)
    with_moment = measured_margin(grasp, [[0.1, 0.0, 0.8, 9.0]] * 2)
    without = measured_margin(grasp, [[0.1, 0.0, 0.8, 0.0]] * 2)
    assert with_moment.load_share == without.load_share


def test_idle_fingers_use_nothing():
    found = measured_margin(antipodal(), np.zeros((2, 4)))
    assert found.status is Status.OPTIMAL and found.load_share == 0.0
    assert found.slip_margins.tolist() == [1.0, 1.0]


@pytest.mark.parametrize('forces, wanted', [
    (np.zeros((3, 4)), 0.2), (np.full((2, 4), np.nan), 0.2), (np.zeros((2, 4)), 1.0),
    (np.zeros((2, 4)), -0.1)])
def test_bad_arguments_are_refused(forces, wanted):
    with pytest.raises(InvalidTaskError):
        measured_margin(antipodal(), forces, wanted)


def test_one_finger_that_pushes_too_hard():
    grasp = Grasp([Contact(position=(0, 0, 0), normal=(1, 0, 0), max_normal_force=1.0)])
    found = measured_margin(grasp, [[0.0, 0.0, 2.0, 0.0]])
    assert found.load_share == pytest.approx(2.0, rel=SOLVER)
    assert not found.restorable  # the same push is beyond the cap
    assert found.applied_wrench == pytest.approx(2.0 * FX, abs=CLOSED_FORM)

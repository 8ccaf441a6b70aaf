# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The load that a hand shall hold: weight and spring, in the object frame."""

from grasp_quality_hand.object_spring import ObjectSpring, weight
import numpy as np
import pinocchio
import pytest

EXACT = 1e-9
SPRING = ObjectSpring(100.0, 2.0, 1e3, 1e3)
RNG = np.random.default_rng(0)


def pose(size=1.0):
    return pinocchio.exp3(size * RNG.normal(size=3)), size * RNG.normal(size=3)


def test_at_its_place_it_asks_for_nothing():
    place = pose()
    assert SPRING.wrench(*place, *place) == pytest.approx(np.zeros(6), abs=EXACT)


def test_it_pulls_straight_back_and_turns_straight_back():
    for _ in range(10):
        (R_place, p_place), (R, p) = pose(), pose()
        wrench = SPRING.wrench(R_place, p_place, R, p)
        assert R @ wrench[:3] == pytest.approx(100.0 * (p_place - p), abs=EXACT)
        assert R @ pinocchio.exp3(wrench[3:] / 2.0) == pytest.approx(R_place, abs=1e-6)


def test_it_is_the_slope_of_its_energy():
    """Along any motion: power is what the energy loses."""
    (R_place, p_place), (R, p) = pose(0.3), pose(0.3)
    v, w, step = RNG.normal(size=3), RNG.normal(size=3), 1e-6

    def energy(s):
        turn = pinocchio.log3((R @ pinocchio.exp3(s * w)).T @ R_place)
        return 50.0 * ((p + s * (R @ v) - p_place) ** 2).sum() + 1.0 * turn @ turn

    wrench = SPRING.wrench(R_place, p_place, R, p)
    lost = -(energy(step) - energy(-step)) / (2.0 * step)
    assert wrench[:3] @ v + wrench[3:] @ w == pytest.approx(lost, rel=1e-6)


def test_it_asks_for_no_more_than_it_may():
    spring = ObjectSpring(100.0, 2.0, 0.5, 0.01)
    wrench = spring.wrench(*pose(), *pose())
    assert np.linalg.norm(wrench[:3]) == pytest.approx(0.5, abs=EXACT)
    assert np.linalg.norm(wrench[3:]) == pytest.approx(0.01, abs=EXACT)


def test_weight_points_down_however_the_object_is_turned():
    R, _ = pose()
    load = weight(0.2, np.array([0.0, 0.0, -10.0]), R)
    assert R @ load[:3] == pytest.approx([0.0, 0.0, -2.0], abs=EXACT)
    assert not load[3:].any()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches between reference points and frames."""

from grasp_quality import InvalidTaskError
from grasp_quality.wrench import as_wrench, cross, shift, transform
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tolerances import EXACT

RNG = np.random.default_rng(0)
R = Rotation.random(rng=RNG).as_matrix()
P = RNG.normal(size=3)
WRENCH = RNG.normal(size=6)


def test_cross_is_numpys():
    a, b = RNG.normal(size=(5, 3)), RNG.normal(size=(5, 3))
    assert cross(a, b) == pytest.approx(np.cross(a, b), abs=EXACT)
    assert cross(a[0], b) == pytest.approx(np.cross(a[0], b), abs=EXACT)


def test_shift_there_and_back():
    assert shift(shift(WRENCH, P), -P) == pytest.approx(WRENCH, abs=EXACT)


def test_force_through_the_new_reference_point_has_no_torque_there():
    force = WRENCH[:3]
    wrench = np.concatenate([force, np.cross(P, force)])
    assert shift(wrench, P) == pytest.approx(np.concatenate([force, np.zeros(3)]), abs=EXACT)


def test_shift_leaves_its_argument_alone():
    wrench = WRENCH.copy()
    shift(wrench, P)
    assert (wrench == WRENCH).all()


def test_transform_keeps_the_power():
    """Force times velocity is the same number in both frames."""
    linear, angular = RNG.normal(size=3), RNG.normal(size=3)
    moved = np.concatenate([R @ linear + np.cross(P, R @ angular), R @ angular])
    assert transform(WRENCH, R, P) @ moved == pytest.approx(
        WRENCH @ np.concatenate([linear, angular]), abs=EXACT)


def test_transform_back():
    there = transform(WRENCH, R, P)
    assert transform(there, R.T, -R.T @ P) == pytest.approx(WRENCH, abs=EXACT)


def test_as_wrench_names_what_it_refuses():
    with pytest.raises(InvalidTaskError, match=r'load must have shape \(6\)'):
        as_wrench([1.0, 2.0], 'load')

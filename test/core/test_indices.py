# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Indices of the grasp matrix, by hand."""

from grasp_quality import grasp_indices, InvalidTaskError
from known_grasps import antipodal, cube_of_eight, single, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def test_antipodal_points_turn_nothing_about_their_line():
    found = grasp_indices(antipodal(0.5))
    assert found.singular_values == pytest.approx([np.sqrt(2.0)] * 5 + [0.0], abs=CLOSED_FORM)
    assert found.smallest_singular_value == found.isotropy == found.manipulability == 0.0


def test_antipodal_soft_fingers_are_isotropic():
    found = grasp_indices(antipodal(0.5, 0.1))
    assert found.singular_values == pytest.approx([np.sqrt(2.0)] * 6, rel=CLOSED_FORM)
    assert found.isotropy == pytest.approx(1.0, rel=CLOSED_FORM)
    assert found.manipulability == pytest.approx(8.0, rel=CLOSED_FORM)


@pytest.mark.parametrize('length', [0.1, 0.5, 2.0])
def test_torques_count_over_the_torque_length(length):
    """Three fingers on the unit circle: G G^T is 3 for forces, 3 about z and 3/2 across."""
    found = grasp_indices(three_finger(), length)
    squares = [3.0] * 3 + [3.0 / length ** 2, 1.5 / length ** 2, 1.5 / length ** 2]
    assert found.singular_values ** 2 == pytest.approx(
        sorted(squares, reverse=True), rel=CLOSED_FORM)
    assert found.torque_length == length


def test_neither_caps_nor_friction_count():
    assert grasp_indices(antipodal(0.1, 0.3, caps=(1.0, 7.0))).singular_values == pytest.approx(
        grasp_indices(antipodal(0.9, 0.2)).singular_values, rel=CLOSED_FORM)


def test_few_columns_leave_zeros():
    assert grasp_indices(single()).singular_values == pytest.approx([1, 1, 1, 0, 0, 0])
    assert len(grasp_indices(cube_of_eight()).singular_values) == 6


@pytest.mark.parametrize('length', [0.0, -1.0, np.inf, 'long'])
def test_a_length_is_a_length(length):
    with pytest.raises(InvalidTaskError, match='torque_length'):
        grasp_indices(three_finger(), length)

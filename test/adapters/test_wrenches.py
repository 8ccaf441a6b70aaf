# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches, points and vectors: force before torque, there and back."""

from adapter_messages import BAD_NUMBERS, wrench
from geometry_msgs.msg import Point, Vector3
from hypothesis import given, strategies
from msg_adapters.errors import InvalidMessageError
from msg_adapters.wrenches import fill_xyz, to_wrench, wrench_array
import numpy as np
import pytest

numbers = strategies.floats(-1e12, 1e12)


def test_force_stands_before_torque():
    assert wrench_array(wrench(1.0, 2.0, 3.0, 4.0, 5.0, 6.0), 'w').tolist() == [1, 2, 3, 4, 5, 6]


@given(strategies.tuples(*[numbers] * 6))
def test_round_trip(values):
    assert wrench_array(to_wrench(values), 'w').tolist() == list(values)


@given(strategies.tuples(numbers, numbers, numbers))
def test_points_and_vectors_keep_their_order(values):
    for message in (Point(), Vector3()):
        fill_xyz(message, np.array(values))
        assert (message.x, message.y, message.z) == values


def test_arrays_of_whole_numbers_and_of_single_precision_are_written_as_floats():
    assert to_wrench([1, 0, 0, 0, 0, 0]).force.x == 1.0
    message = Vector3()
    fill_xyz(message, np.ones(3, np.float32))
    assert message.z == 1.0


@pytest.mark.parametrize('part', ['force', 'torque'])
@pytest.mark.parametrize('axis', ['x', 'y', 'z'])
@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_bad_component_is_refused_by_field(part, axis, value):
    message = wrench()
    setattr(getattr(message, part), axis, value)
    with pytest.raises(InvalidMessageError, match='^external_wrench must be finite and at most'):
        wrench_array(message, 'external_wrench')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Frames: the object frame's name, transforms of wrenches, and refusals instead of guesses."""

from adapter_messages import EXACT, shuffled_axes, sizes
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from hypothesis import given, strategies
from msg_adapters.errors import InvalidMessageError, TransformError
from msg_adapters.frames import object_frame_of, Transform, transform_to
import numpy as np
import pytest


class KnownTransform:
    """Look-up as tf2_ros.Buffer does it, of one transform (tf2 is not on PyPI)."""

    def __init__(self, rotation=None, translation=(0.0, 0.0, 0.0)):
        self.found = TransformStamped()
        self.found.transform.rotation = rotation or Quaternion()
        x, y, z = translation
        self.found.transform.translation = Vector3(x=x, y=y, z=z)

    def lookup_transform(self, target, source, time):
        """Know 'hand' only."""
        self.asked = target, source, time.nanoseconds
        if source != 'hand':
            raise LookupError(f'{source} does not exist at {time.nanoseconds}')
        return self.found


def test_the_parameter_names_the_object_frame_before_the_contacts_do():
    assert object_frame_of('contacts', 'object') == 'object'
    assert object_frame_of('contacts', '') == 'contacts'
    assert object_frame_of('', 'object') == 'object'


def test_a_frame_that_nobody_names_is_refused():
    with pytest.raises(InvalidMessageError, match=(
            '^header.frame_id of the contacts must not be empty: .* set the parameter '
            'object_frame$')):
        object_frame_of('', '')


@pytest.mark.parametrize('source', ['', 'object'])
@pytest.mark.parametrize('stamp', [Time(), Time(sec=-5)])
def test_the_object_frame_needs_no_transform(source, stamp):
    assert transform_to('object', source, None, stamp) is None


def test_another_frame_without_tf2_is_refused_with_the_way_out():
    with pytest.raises(TransformError, match=(
            "^frame 'hand' is not the object frame 'object', and tf2 is not installed here: send "
            "the message in 'object', or install tf2_ros$")):
        transform_to('object', 'hand', None, Time())


def test_a_known_frame_is_looked_up():
    half = float(np.sqrt(0.5))
    buffer = KnownTransform(Quaternion(x=0.0, y=0.0, z=half, w=half), (1.0, 2.0, 3.0))
    found = transform_to('object', 'hand', buffer, Time(sec=1))
    assert buffer.asked == ('object', 'hand', 1_000_000_000)
    np.testing.assert_allclose(found.R @ [1, 0, 0], [0, 1, 0], atol=EXACT)
    assert found.p.tolist() == [1, 2, 3]


@pytest.mark.parametrize('buffer, source, stamp, words', [
    (KnownTransform(), 'stranger', Time(nanosec=7), 'stranger does not exist at 7'),
    (KnownTransform(), 'hand', Time(sec=-5), ''),
    (KnownTransform(translation=(float('nan'), 0.0, 0.0)), 'hand', Time(),
     'its translation must be finite'),
    (KnownTransform(Quaternion(w=0.0)), 'hand', Time(), 'its rotation must be a quaternion')])
def test_whatever_fails_in_the_look_up_is_a_transform_error(buffer, source, stamp, words):
    with pytest.raises(TransformError, match=(
            f"^no transform from '{source}' to 'object': {words}")):
        transform_to('object', source, buffer, stamp)


def test_a_force_away_from_the_origin_gains_a_torque():
    """A source frame 2 m along x: its +y force turns about the target's z."""
    moved = Transform(p=np.array([2.0, 0.0, 0.0])).wrench(np.array([0.0, 3.0, 0, 0, 0, 0]))
    np.testing.assert_allclose(moved, [0, 3, 0, 0, 0, 6], atol=EXACT)


def test_axes_are_turned_for_force_and_torque_alike():
    turned = Transform(shuffled_axes().R).wrench(np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]))
    np.testing.assert_allclose(turned, [3, 1, 2, 6, 4, 5], atol=EXACT)


@given(strategies.tuples(*[sizes] * 6), strategies.tuples(*[sizes] * 3),
       strategies.tuples(*[sizes] * 6))
def test_power_does_not_depend_on_the_frame(values, position, twist):
    """A wrench (f, t) on a motion (v, w) of the body does f.v + t.w in any frame."""
    move = shuffled_axes()
    move = Transform(move.R, np.array(position))
    wrench, v, w = np.array(values), np.array(twist[:3]), np.array(twist[3:])
    w_target = move.R @ w
    v_target = move.R @ v + np.cross(move.p, w_target)
    there = move.wrench(wrench)
    assert there[:3] @ v_target + there[3:] @ w_target == pytest.approx(
        wrench[:3] @ v + wrench[3:] @ w, abs=1e-9)

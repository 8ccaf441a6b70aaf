# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Poses: position and rotation, checked."""

import re
import struct

from adapter_messages import any_float, BAD_NUMBERS, EXACT, pose, quaternion_of, sizes
from geometry_msgs.msg import Pose, Quaternion
from hypothesis import assume, given, strategies
from msg_adapters.errors import InvalidMessageError
from msg_adapters.poses import frames_of, pose_arrays, rotation_matrix
import numpy as np
import pytest

HALF = float(np.sqrt(0.5))


@pytest.mark.parametrize('quaternion, images', [
    ((0.0, 0.0, 0.0, 1.0), np.eye(3)),
    ((HALF, 0.0, 0.0, HALF), [[1, 0, 0], [0, 0, 1], [0, -1, 0]]),
    ((0.0, HALF, 0.0, HALF), [[0, 0, -1], [0, 1, 0], [1, 0, 0]]),
    ((0.0, 0.0, HALF, HALF), [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]),
    ((0.0, 0.0, 0.0, -1.0), np.eye(3))])
def test_quarter_turns_take_the_axes_where_the_right_hand_says(quaternion, images):
    x, y, z, w = quaternion
    R = rotation_matrix(Quaternion(x=x, y=y, z=z, w=w), 'q')
    np.testing.assert_allclose(R.T, images, atol=EXACT)


@given(strategies.tuples(sizes, sizes, sizes, sizes))
def test_every_unit_quaternion_is_a_rotation(numbers):
    assume(np.linalg.norm(numbers) > 1e-3)
    R = rotation_matrix(quaternion_of(numbers), 'q')
    np.testing.assert_allclose(R.T @ R, np.eye(3), atol=EXACT)
    assert np.linalg.det(R) == pytest.approx(1.0, abs=EXACT)


@given(strategies.tuples(sizes, sizes, sizes, sizes), strategies.floats(0.9991, 1.0009))
def test_rounding_of_the_norm_is_forgiven_and_made_exact(numbers, factor):
    assume(np.linalg.norm(numbers) > 1e-3)
    q = quaternion_of(numbers)
    rounded = Quaternion(x=factor * q.x, y=factor * q.y, z=factor * q.z, w=factor * q.w)
    _, among_many = frames_of([Pose(orientation=rounded)], ['a'])
    for R in (rotation_matrix(rounded, 'q'), among_many[0]):
        np.testing.assert_allclose(R, rotation_matrix(q, 'q'), atol=EXACT)


@pytest.mark.parametrize('numbers', [
    (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.01), (0.5, 0.5, 0.5, 0.6), (1e200, 0.0, 0.0, 1.0)])
def test_other_norms_are_refused_with_the_way_out(numbers):
    x, y, z, w = numbers
    with pytest.raises(InvalidMessageError, match=(
            '^a.orientation must be a quaternion of norm 1.* of norm .*: normalise it, the '
            r'identity is \(0, 0, 0, 1\)$')):
        pose_arrays(Pose(orientation=Quaternion(x=x, y=y, z=z, w=w)), 'a')


@pytest.mark.parametrize('part, axis', [
    ('position', 'x'), ('position', 'y'), ('position', 'z'), ('orientation', 'x'),
    ('orientation', 'y'), ('orientation', 'z'), ('orientation', 'w')])
@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_bad_number_is_refused_by_field(part, axis, value):
    message = pose()
    setattr(getattr(message, part), axis, value)
    with pytest.raises(InvalidMessageError, match=f'^poses.3..{part} must be'):
        pose_arrays(message, 'poses[3]')


@given(strategies.lists(strategies.tuples(*[any_float] * 7), max_size=4))
def test_many_poses_are_read_or_refused_like_each_of_them(rows):
    messages = [pose(row[:3], Quaternion(**dict(zip('xyzw', row[3:])))) for row in rows]
    names = [f'poses[{i}]' for i in range(len(rows))]
    try:
        each = [pose_arrays(message, name) for message, name in zip(messages, names)]
    except InvalidMessageError as exc:
        with pytest.raises(InvalidMessageError, match=f'^{re.escape(str(exc))}$'):
            frames_of(messages, names)
        return
    positions, rotations = frames_of(messages, names)
    assert positions.shape == (len(rows), 3)
    for (position, rotation), p, R in zip(each, positions, rotations, strict=True):
        np.testing.assert_array_equal(p, position)
        np.testing.assert_allclose(R, rotation, atol=EXACT)


@pytest.mark.filterwarnings('error')
@pytest.mark.parametrize('bits', [0x7FF0000000000001, 0x7FF8000000000000, 0x7FEFFFFFFFFFFFFF])
@pytest.mark.parametrize('place', range(7))
def test_numbers_of_any_bits_are_refused_quietly(bits, place):
    row = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    row[place], = struct.unpack('<d', struct.pack('<Q', bits))
    with pytest.raises(InvalidMessageError, match='^a.(position|orientation) must be'):
        frames_of([pose(row[:3], Quaternion(**dict(zip('xyzw', row[3:]))))], ['a'])


@given(strategies.tuples(*[any_float] * 7))
def test_any_numbers_give_a_finite_frame_or_a_clear_error(numbers):
    x, y, z, w = numbers[3:]
    message = pose(numbers[:3], Quaternion(x=x, y=y, z=z, w=w))
    try:
        position, rotation = pose_arrays(message, 'pose')
    except InvalidMessageError:
        return
    assert np.isfinite(position).all() and np.isfinite(rotation).all()
    assert position.tolist() == list(numbers[:3])

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured wrenches: the local force of a contact, from its own frame or from the object's."""

from adapter_messages import BAD_NUMBERS, EXACT, quaternion_of, sizes, wrench
from geometry_msgs.msg import WrenchStamped
from grasp_quality import Contact, Grasp
from hypothesis import assume, given, strategies
from msg_adapters.errors import InvalidMessageError
from msg_adapters.measured import local_force
from msg_adapters.poses import rotation_matrix
from msg_adapters.wrenches import to_wrench
import numpy as np
import pytest
from std_msgs.msg import Header

TIP = Contact((0.0, 0.0, 0.3), (0, 0, -1), name='tip')


def stamped(message, frame):
    return WrenchStamped(header=Header(frame_id=frame), wrench=message)


def test_the_contact_frame_is_taken_as_it_is_without_tilting_moments():
    message = stamped(wrench(1.0, 2.0, 3.0, 4.0, 5.0, 6.0), 'tip')
    assert local_force(message, TIP, 'object').tolist() == [1, 2, 3, 6]


def test_a_push_into_the_object_is_a_positive_normal_force():
    message = stamped(wrench(fz=-5.0), 'object')
    np.testing.assert_allclose(local_force(message, TIP, 'object')[2:], [5, 0], atol=EXACT)


def test_torques_of_the_object_frame_are_about_its_origin():
    """1 N along x at height 0.3 m is 0.3 N m about y, and no moment at the contact."""
    force = local_force(stamped(wrench(fx=1.0, ty=0.3, tz=0.02), 'object'), TIP, 'object')
    assert np.hypot(*force[:2]) == pytest.approx(1.0, abs=EXACT)
    np.testing.assert_allclose(force[2:], [0, -0.02], atol=EXACT)


@given(strategies.tuples(*[sizes] * 4), strategies.tuples(*[sizes] * 3),
       strategies.tuples(*[sizes] * 4))
def test_the_grasp_matrix_is_undone(numbers, position, force):
    assume(np.linalg.norm(numbers) > 1e-3)
    contact = Contact(
        position, rotation=rotation_matrix(quaternion_of(numbers), 'q'), name='tip')
    message = stamped(to_wrench(Grasp([contact]).wrench(np.array([force]))), 'object')
    np.testing.assert_allclose(local_force(message, contact, 'object'), force, atol=1e-9)


@pytest.mark.parametrize('frame', ['', 'palm'])
def test_other_frames_are_refused_with_the_choices(frame):
    with pytest.raises(InvalidMessageError, match=(
            "^contact_wrenches/tip: header.frame_id must be .*'tip' .*'object'")):
        local_force(stamped(wrench(), frame), TIP, 'object')


@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_bad_number_is_refused_by_topic(value):
    with pytest.raises(InvalidMessageError, match='^contact_wrenches/tip: wrench must be finite'):
        local_force(stamped(wrench(ty=value), 'tip'), TIP, 'object')

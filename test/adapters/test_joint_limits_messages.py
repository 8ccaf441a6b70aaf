# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Joint limits of messages: the same torque whatever the frame, and what is refused."""

from types import SimpleNamespace

from adapter_messages import BAD_NUMBERS, EXACT, pose, shuffled_axes
from geometry_msgs.msg import Twist, Vector3
from grasp_quality_msgs.msg import Contact, ContactArray, JointLimit
from msg_adapters.contacts import ContactDefaults, contacts_from_array
from msg_adapters.errors import InvalidMessageError
from msg_adapters.joint_limits import joint_limits_from
import numpy as np
import pytest

DEFAULTS = ContactDefaults()
RNG = np.random.default_rng(0)


def twist(numbers=(0.0,) * 6):
    x, y, z, a, b, c = map(float, numbers)
    return Twist(linear=Vector3(x=x, y=y, z=z), angular=Vector3(x=a, y=b, z=c))


def limit(name='knuckle', max_torque=0.5, gravity_torque=0.1, twists=None):
    return JointLimit(name=name, max_torque=max_torque, gravity_torque=gravity_torque,
                      twists=[twist(), twist()] if twists is None else twists)


def array(*limits):
    return ContactArray(contacts=[Contact(pose=pose()), Contact(pose=pose((1.0, 2.0, 3.0)))],
                        joint_limits=list(limits))


def read(message, transform=None, **options):
    return joint_limits_from(
        message, contacts_from_array(message, DEFAULTS, transform), transform, **options)


@pytest.mark.parametrize('transform', [None, shuffled_axes()])
def test_torque_is_the_power_of_force_and_moment_along_the_twists(transform):
    """In the header's frame, where the twists stand: tau = v . f + w . m n + gravity."""
    numbers = RNG.normal(size=(2, 2, 6))
    message = array(*(limit(f'joint_{j}', twists=[twist(n) for n in row])
                      for j, row in enumerate(numbers)))
    limits = read(message, transform)
    local = RNG.normal(size=(2, 4))
    plain = contacts_from_array(message, DEFAULTS)  # frames in the header's axes
    expected = np.full(2, 0.1)
    for i, x in enumerate(local):
        R = plain.rotations[i]
        expected += numbers[:, i, :3] @ (R @ x[:3]) + numbers[:, i, 3:] @ (R[:, 2] * x[3])
    assert limits.torques(local) == pytest.approx(expected, abs=EXACT)
    assert limits.names == ('joint_0', 'joint_1')
    assert limits.max_torques.tolist() == [0.5, 0.5]


def test_no_limits_are_none():
    assert read(array()) is None


def test_messages_that_were_recorded_before_there_were_limits_have_none():
    recorded = SimpleNamespace(contacts=array().contacts)
    assert read(recorded) is None


@pytest.mark.parametrize('bad, words', [
    (limit(twists=[twist()]), r'joint_limits\[0\]\.twists must hold one twist.*2 contacts, got 1'),
    (limit(max_torque=0.0), r'^joint_limits\[0\]\.max_torque must be at least 1e-12, got 0:'),
    (limit(max_torque=-1.0), r'max_torque must be at least 1e-12, got -1: leave out a joint'),
    (limit(name=''), 'names must be words')])
def test_what_is_refused(bad, words):
    with pytest.raises(InvalidMessageError, match=words):
        read(array(bad))


def test_a_joint_that_comes_twice_is_refused():
    with pytest.raises(InvalidMessageError, match='unique'):
        read(array(limit(), limit()))


@pytest.mark.parametrize('number', BAD_NUMBERS)
def test_bad_numbers_are_refused(number):
    for bad in (limit(max_torque=number), limit(gravity_torque=number),
                limit(twists=[twist(), twist([0, 0, number, 0, 0, 0])]),
                limit(twists=[twist([0, 0, 0, 0, number, 0]), twist()])):
        with pytest.raises(InvalidMessageError, match=r'joint_limits\[0\]'):
            read(array(bad))


def test_too_many_are_refused():
    message = array(limit('a'), limit('b'))
    assert len(read(message, max_size=4)) == 2
    with pytest.raises(InvalidMessageError, match=(
            r'^joint_limits must .*at most 3 twists \(.*max_request_size\), got 2 joints of 2 ')):
        read(message, max_size=3)


def test_the_smallest_limit_is_the_one_that_the_error_names():
    assert read(array(limit(max_torque=1e-12))).max_torques.tolist() == [1e-12]

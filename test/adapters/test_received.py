# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What a controller reads: numbers as they are, or an error before they move a motor."""

import math

from adapter_messages import BAD_NUMBERS, wrench
from geometry_msgs.msg import Point
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
from msg_adapters.errors import InvalidMessageError
from msg_adapters.received import read_forces, read_joint_state
import pytest
from sensor_msgs.msg import JointState


def forces():
    return ContactForceArray(forces=[
        ContactForce(name='left', position=Point(x=1.0, y=2.0, z=3.0),
                     wrench=wrench(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)), ContactForce(name='right')])


def test_forces_are_read_as_they_are():
    names, points, wrenches = read_forces(forces())
    assert names == ('left', 'right')
    assert points.tolist() == [[1, 2, 3], [0, 0, 0]]
    assert wrenches.tolist() == [[1, 2, 3, 4, 5, 6], [0] * 6]


def test_no_forces_are_no_forces():
    names, points, wrenches = read_forces(ContactForceArray())
    assert (names, points.shape, wrenches.shape) == ((), (0, 3), (0, 6))


@pytest.mark.parametrize('number', BAD_NUMBERS)
def test_bad_numbers_are_refused(number):
    for change in (lambda f: setattr(f.position, 'y', number),
                   lambda f: setattr(f.wrench.force, 'z', number),
                   lambda f: setattr(f.wrench.torque, 'x', number)):
        message = forces()
        change(message.forces[1])
        with pytest.raises(InvalidMessageError, match=r'^forces\[1\]\.(position|wrench) must be'):
            read_forces(message)
    for field in ('position', 'velocity', 'effort'):
        message = JointState(name=['a'], position=[0.0])
        setattr(message, field, [number])
        with pytest.raises(InvalidMessageError, match=f'^{field} must be finite'):
            read_joint_state(message)


def test_a_contact_that_comes_twice_is_refused():
    message = forces()
    message.forces[1].name = 'left'
    with pytest.raises(InvalidMessageError, match=r"^forces must .*unique.* \['left', 'left'\]"):
        read_forces(message)


def test_joint_states_are_read_by_name():
    message = JointState(name=['a', 'b'], position=[1.0, 2.0], effort=[3.0, 4.0])
    assert read_joint_state(message) == ({'a': 1.0, 'b': 2.0}, {}, {'a': 3.0, 'b': 4.0})


def test_joints_of_others_are_not_read():
    message = JointState(name=['arm', 'a', 'arm'], position=[math.nan, 1.0, 0.0],
                         effort=[0.0, 2.0, math.nan])
    assert read_joint_state(message, ['a', 'b']) == ({'a': 1.0}, {}, {'a': 2.0})
    message.effort[1] = math.nan
    assert read_joint_state(message, ['a', 'b'], ['b']) == ({'a': 1.0}, {}, {})
    with pytest.raises(InvalidMessageError, match='^effort must be finite'):
        read_joint_state(message, ['a', 'b'])


@pytest.mark.parametrize('fields, words', [
    ({'name': ['a', 'b'], 'position': [1.0]}, 'position must hold one number for each'),
    ({'name': ['a']}, 'position must hold one number for each'),
    ({'name': ['a'], 'position': [1.0], 'velocity': [1.0, 2.0]}, 'velocity must hold'),
    ({'name': ['a', 'a'], 'position': [1.0, 2.0]}, 'name must be unique')])
def test_joint_states_that_do_not_fit_their_names_are_refused(fields, words):
    with pytest.raises(InvalidMessageError, match=words):
        read_joint_state(JointState(**fields))

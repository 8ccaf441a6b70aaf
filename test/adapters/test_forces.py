# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact forces: what the messages say adds up to what the fingers do to the object."""

from adapter_messages import EXACT, quaternion_of, sizes
from builtin_interfaces.msg import Time
from grasp_quality import Contact, ContactModel, Grasp
from grasp_quality_msgs.msg import ContactForceArray
from hypothesis import assume, given, strategies
from msg_adapters.forces import contact_frame_wrench, force_array
from msg_adapters.poses import rotation_matrix
from msg_adapters.wrenches import wrench_array
import numpy as np
import pytest
from std_msgs.msg import Header

HEADER = Header(stamp=Time(sec=7, nanosec=8), frame_id='object')


def vector(message):
    return np.array([message.x, message.y, message.z])


def total_wrench(message):
    """Sum the wrenches (6,) about the origin, from the message alone."""
    total = np.zeros(6)
    for item in message.forces:
        force = vector(item.wrench.force)
        total[:3] += force
        total[3:] += vector(item.wrench.torque) + np.cross(vector(item.position), force)
    return total


def test_a_normal_force_points_into_the_object():
    contact = Contact((0.2, 0, 0), (-1, 0, 0), name='tip')
    message = force_array(HEADER, Grasp([contact]), np.array([[0, 0, 5.0, 0]]), np.array([0.25]))
    item, = message.forces
    assert message.header == HEADER
    assert (item.name, item.cone_usage) == ('tip', 0.25)
    np.testing.assert_allclose(wrench_array(item.wrench, ''), [-5, 0, 0, 0, 0, 0], atol=EXACT)
    np.testing.assert_allclose(vector(item.position), [0.2, 0, 0], atol=EXACT)
    np.testing.assert_allclose(vector(item.normal), [-1, 0, 0], atol=EXACT)


@given(strategies.lists(strategies.tuples(*[sizes] * 11), min_size=1, max_size=4))
def test_messages_carry_the_wrench_that_the_grasp_matrix_gives(rows):
    rows = np.array(rows)  # (k, 11): position, quaternion, local force
    assume((np.linalg.norm(rows[:, 3:7], axis=1) > 1e-3).all())
    grasp = Grasp([
        Contact(row[:3], rotation=rotation_matrix(quaternion_of(row[3:7]), 'q'),
                model=ContactModel.SFCE) for row in rows])
    message = force_array(HEADER, grasp, rows[:, 7:], np.zeros(len(rows)))
    np.testing.assert_allclose(total_wrench(message), grasp.wrench(rows[:, 7:]), atol=1e-9)


@pytest.mark.parametrize('forces', [(), np.zeros((0, 4))])
def test_no_forces_are_an_empty_array_with_its_header(forces):
    grasp = Grasp([Contact((0, 0, 0), (1, 0, 0))])
    assert force_array(HEADER, grasp, forces) == ContactForceArray(header=HEADER)


def test_no_grasp_is_needed_to_say_that_there_are_no_forces():
    assert force_array(HEADER) == ContactForceArray(header=HEADER)


def test_the_contact_frame_wrench_has_the_local_components():
    message = contact_frame_wrench(HEADER.stamp, 'tip', (1.0, 2.0, 3.0, 0.4))
    assert message.header == Header(stamp=HEADER.stamp, frame_id='tip')
    assert wrench_array(message.wrench, '').tolist() == [1, 2, 3, 0, 0, 0.4]


def test_without_an_answer_it_is_zero():
    assert not wrench_array(contact_frame_wrench(HEADER.stamp, 'tip').wrench, '').any()

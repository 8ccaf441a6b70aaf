# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the simulated hand and the contacts that it reports."""


from grasp_quality_hand.grasp_objects import FRICTION, OBJECTS, TORSIONAL_FRICTION
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_hand.measured_grasp import GRAVITY
from grasp_quality_hand.simulation import HandSimulation
import numpy as np
import pytest

CLOSING_TIME = 1.3           # until the grasp is at rest [s]
HOLDING_TIME = 2.0           # [s]
LARGEST_MOVE = 2e-4          # of a held object [m]
LARGEST_TURN = 2e-3          # of a held object [rad]
BALANCE = 0.02               # of the weight
CONE = 1.0 + 1e-6            # the simulator's solver is not exact


def close_on(object_name, **options):
    """Return a simulation in which the hand holds the object at rest."""
    simulation = HandSimulation(object_name, **options)
    simulation.close_hand()
    simulation.advance(CLOSING_TIME)
    return simulation


@pytest.fixture(scope='module', params=sorted(OBJECTS))
def held(request):
    """Return a simulation that holds one of the objects."""
    return close_on(request.param)


def cone_usage(contact):
    """Return how much of the soft finger's cone a contact force uses."""
    t1, t2, n, m = contact.force
    return np.hypot(np.hypot(t1, t2) / FRICTION, m / TORSIONAL_FRICTION) / n


def test_fingers_balance_the_weight(held):
    contacts = held.finger_contacts()
    forces = np.array([contact.force_in_object_frame for contact in contacts])
    weight = held.object.mass * GRAVITY
    missing = forces.sum(axis=0) - weight * held.up_in_object_frame()
    print(f'{held.object.name}: sum of the finger forces is off the weight by '
          f'{100 * np.linalg.norm(missing) / weight:.2g} %')
    assert np.linalg.norm(missing) < BALANCE * weight
    torque = sum(np.cross(contact.position, force) + contact.force[3] * contact.normal
                 for contact, force in zip(contacts, forces))
    assert np.linalg.norm(torque) < BALANCE * weight * max(held.object.size)


def test_normals_point_into_the_object(held):
    for contact in held.finger_contacts() + held.contact_points():
        assert contact.normal @ contact.position < 0.0
        assert np.allclose(contact.R_object_contact.T @ contact.R_object_contact, np.eye(3))
        assert np.isclose(np.linalg.det(contact.R_object_contact), 1.0)


def test_contacts_are_where_the_hand_was_sent(held):
    for contact in held.finger_contacts():
        wanted = held.object.contact_points[contact.finger]
        assert np.linalg.norm(contact.position - wanted) < 0.003
        assert contact.normal @ held.object.inward_normals[contact.finger] > np.cos(0.1)


def test_forces_stay_in_the_friction_cone(held):
    for contact in held.finger_contacts() + held.contact_points():
        assert contact.force[2] > 0.0
        assert cone_usage(contact) <= CONE


def test_points_of_a_finger_add_up_to_the_finger(held):
    for finger, contact in enumerate(held.finger_contacts()):
        points = [point for point in held.contact_points() if point.finger == finger]
        total = sum(point.force_in_object_frame for point in points)
        assert np.allclose(total, contact.force_in_object_frame, rtol=0.0, atol=1e-9)


def test_object_stays_where_it_is_held():
    for name in OBJECTS:
        simulation = close_on(name)
        assert simulation.held
        position, quaternion = simulation.object_position(), simulation.object_quaternion()
        simulation.advance(HOLDING_TIME)
        assert np.linalg.norm(simulation.object_position() - position) < LARGEST_MOVE
        turn = 2.0 * np.arccos(min(abs(simulation.object_quaternion() @ quaternion), 1.0))
        assert turn < LARGEST_TURN


def test_normal_forces_follow_the_squeeze():
    normals = [np.array([contact.force[2] for contact in close_on(
        'ball', squeeze_force=force).finger_contacts()]) for force in (3.0, 6.0)]
    assert np.allclose(normals[1] - normals[0], 3.0, rtol=0.1)


def test_open_hand_touches_nothing_and_gives_the_object_back():
    simulation = close_on('ball')
    simulation.open_hand()
    simulation.advance(1.0)
    assert not simulation.held
    assert simulation.contact_points() == []
    contacts = simulation.finger_contacts()
    assert [contact.finger for contact in contacts] == list(range(len(FINGERS)))
    for contact in contacts:
        assert np.array_equal(contact.force, np.zeros(4))
        assert np.linalg.norm(contact.position) > simulation.object.size[0]
        assert contact.normal @ contact.position < 0.0
    simulation.close_hand()
    simulation.advance(CLOSING_TIME)
    assert simulation.held and len(simulation.contact_points()) >= len(FINGERS)


def test_unknown_object_is_refused():
    with pytest.raises(ValueError, match='must be one of cube, ball'):
        HandSimulation('teapot')


@pytest.mark.parametrize('name', sorted(OBJECTS))
def test_commanded_efforts_are_the_joints_torques_and_silence_drops_nothing(name):
    simulation = close_on(name)
    position, efforts = simulation.object_position(), simulation.joint_efforts()
    for _ in range(100):
        simulation.command_efforts(efforts)
        simulation.advance(0.01)
    assert np.array_equal(simulation.joint_efforts(), efforts)
    simulation.advance(HOLDING_TIME)
    assert not np.array_equal(simulation.joint_efforts(), efforts)
    assert np.linalg.norm(simulation.object_position() - position) < LARGEST_MOVE


def test_commanded_efforts_end_at_the_motors_limits():
    simulation = close_on('cube')
    limits = simulation.hand.effort_limits
    assert np.array_equal(limits, np.tile([-10.0, 10.0], (9, 1)))
    simulation.command_efforts(1e3 * np.ones(9))
    simulation.advance(0.1)
    assert np.all(simulation.joint_efforts() == 10.0)

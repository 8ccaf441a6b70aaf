# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of slip, of pulls, and of what simulated hands hold in them."""

from grasp_quality import Contact, ContactModel, evaluate, Grasp, TaskWrench
from grasp_quality_hand.grasp_objects import load, OBJECTS
from grasp_quality_hand.pull import Pull
from grasp_quality_hand.simulation import DCLAW, HandSimulation, POINTS
from grasp_quality_hand.slip import LEVER, Pose, slip_distance
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

CLOSING_TIME = 1.5           # [s]
GROWTH = 2.0                 # of the pulls [N/s]
LAW = 1.02                   # of a load that grows so fast, over what the contacts can hold


def pose(position, rotation):
    """Return a Pose from a position and a scipy Rotation."""
    return Pose(np.asarray(position, float), np.roll(rotation.as_quat(), 1))


def test_displacement_is_that_of_rotations():
    rng = np.random.default_rng(1)
    for _ in range(50):
        first, second = Rotation.random(2, random_state=rng)
        p, q = rng.normal(size=(2, 3))
        moved = pose(p, first).displacement_to(pose(q, second))
        assert np.allclose(moved[:3], q - p)
        assert np.allclose(Rotation.from_rotvec(moved[3:]).as_matrix(),
                           (second * first.inv()).as_matrix())
        assert np.linalg.norm(moved[3:]) <= np.pi + 1e-9


def test_slip_counts_way_and_turn():
    turn = Rotation.from_rotvec([0.0, 0.003, 0.0])
    moved = pose([0, 0, 0], Rotation.identity()).displacement_to(pose([3e-4, 0, 4e-4], turn))
    assert slip_distance(moved) == pytest.approx(5e-4 + LEVER * 0.003)


def test_pull_grows_until_the_object_slips_and_then_lets_go():
    still, wrench = pose([0, 0, 0], Rotation.identity()), np.arange(6.0)
    pull = Pull(wrench, growth=2.0, limit=10.0, slip_limit=1e-3, pose=still)
    for _ in range(100):
        pull.advance(0.01, still)
    assert np.allclose(pull.load, 2.0 * wrench) and pull.result is None
    pull.advance(0.01, pose([2e-3, 0, 0], Rotation.identity()))
    assert pull.result.slipped and pull.result.held == pytest.approx(2.0)
    assert pull.result.slip == pytest.approx(2e-3)
    for _ in range(60):
        before = pull.factor
        pull.advance(0.01, still)
        assert pull.factor <= before
    assert not pull.load.any() and pull.result.held == pytest.approx(2.0)


def test_pull_ends_at_its_limit():
    still = pose([0, 0, 0], Rotation.identity())
    pull = Pull(np.ones(6), growth=1.0, limit=0.5, slip_limit=1e-3, pose=still)
    for _ in range(100):
        pull.advance(0.01, still)
    assert pull.result.held == 0.5 and not pull.result.slipped


@pytest.fixture(scope='module', params=[(hand, name) for hand in (DCLAW, POINTS)
                                        for name in sorted(OBJECTS)], ids='-'.join)
def held(request):
    """Return a simulation of one of the hands that holds one of the objects."""
    hand, name = request.param
    simulation = HandSimulation(name, hand=hand)
    simulation.close_hand()
    simulation.advance(CLOSING_TIME)
    return simulation


def test_every_hand_holds_every_object_still(held):
    assert held.held
    before = held.object_pose()
    held.advance(1.0)
    assert slip_distance(before.displacement_to(held.object_pose())) < 0.5 * held.slip_limit
    assert {contact.finger for contact in held.contact_points()} == {0, 1, 2}


def test_no_pull_exceeds_what_the_contacts_can_hold(held):
    contacts = held.finger_contacts()
    up = np.append(held.up_in_object_frame(), np.zeros(3))
    held.begin_pull(-up, GROWTH, 100.0, held.slip_limit)
    largest = 0.0
    while held.pull.result is None:
        held.advance(0.01)
        largest = max(largest, *(contact.force[2] for contact in held.finger_contacts()))
    grasp = Grasp([
        Contact(position=contact.position, rotation=contact.R_object_contact,
                model=ContactModel.SFCE, friction=held.object.friction,
                torsional_friction=held.object.torsional_friction, max_normal_force=largest)
        for contact in contacts])
    alpha = evaluate(grasp, TaskWrench(up), -held.object.mass * 9.81 * up).alpha
    assert held.pull.result.slipped
    assert 0.1 * alpha < held.pull.result.held < LAW * alpha


def test_mass_and_friction_of_an_object_can_be_chosen():
    ball = load('ball', mass=0.5, friction=0.4)
    assert (ball.mass, ball.friction) == (0.5, 0.4)
    assert ball.torsional_friction == pytest.approx(load('ball').torsional_friction / 2)
    with pytest.raises(ValueError, match='must be one of cube, ball, cylinder'):
        load('teapot')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Efforts of contact forces: virtual work, closed forms, saturation, joint limits."""

from grasp_quality import Contact, ContactModel, Grasp
from grasp_quality_hand.contact_pushes import contact_efforts, joint_limits, Pushes, saturated
from grasp_quality_hand.fetch_dclaw import dclaw_directory, URDF
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_kinematics import BadHand, HandKinematics
from grasp_quality_hand.hand_model import build_hand_model
from hypothesis import given, strategies
import mujoco
import numpy as np
import pinocchio
import pytest
from two_fingers import EFFORT, LENGTH, MASS, urdf

EXACT = 1e-9
JOINTS = [f'joint_f{finger}_{joint}' for finger in (1, 2, 3) for joint in (0, 1, 2)]
TIPS = [f'link_f{finger}_3' for finger in (1, 2, 3)]
numbers = strategies.floats(-1e3, 1e3)


def two_fingers():
    hand = HandKinematics(urdf(), ['right_hinge', 'left_hinge'])
    for link in ('left_finger', 'right_finger'):
        hand.check_link(link)
    hand.update(np.zeros(2))
    return hand


@pytest.fixture(scope='module')
def dclaw():
    hand = HandKinematics((dclaw_directory() / URDF).read_text(), JOINTS)
    for link in TIPS:
        hand.check_link(link)
    return hand


def pushes(rng, k=3):
    return Pushes(tuple(f'contact_{i}' for i in range(k)), rng.normal(0.0, 0.1, (k, 3)),
                  rng.normal(size=(k, 3)), rng.normal(0.0, 0.01, (k, 3)))


def test_a_pinch_by_hand():
    """Tips at z = 0.1 push inward with 3 N: 0.3 N m of each hinge, in the order of joints."""
    push = Pushes(('a', 'b'), np.array([[-0.05, 0, LENGTH], [0.05, 0, LENGTH]]),
                  np.array([[3.0, 0, 0], [-3.0, 0, 0]]), np.zeros((2, 3)))
    efforts = contact_efforts(two_fingers(), ['left_finger', 'right_finger'], push)
    assert efforts == pytest.approx([-0.3, 0.3], abs=EXACT)


def test_moments_count_too():
    push = Pushes(('a',), np.zeros((1, 3)), np.zeros((1, 3)), np.array([[0.0, 0.02, 0.0]]))
    efforts = contact_efforts(two_fingers(), ['left_finger'], push)
    assert efforts == pytest.approx([0.0, 0.02], abs=EXACT)


def test_gravity_by_hand():
    """A finger that leans to +x by its hinge's angle needs m g l / 2 sin(angle) against it."""
    hand = HandKinematics(urdf(), ['left_hinge'], gravity=[0.0, 0.0, -10.0])
    hand.update(np.array([np.pi / 2, 0.0]))
    assert hand.gravity_efforts() == pytest.approx([-MASS * 10.0 * LENGTH / 2], abs=EXACT)


@pytest.mark.parametrize('seed', range(5))
def test_virtual_work(dclaw, seed):
    """Efforts times rates are forces times velocities of the points, told by two postures."""
    rng = np.random.default_rng(seed)
    q, rates, step = rng.uniform(-0.5, 0.5, 9), rng.normal(size=9), 1e-6
    push = pushes(rng)
    dclaw.update(q)
    efforts, power = contact_efforts(dclaw, TIPS, push), 0.0
    here, before, after = (_placements(q + s * step * rates) for s in (0.0, -1.0, 1.0))
    for i, tip in enumerate(TIPS):
        point = here[tip].actInv(push.positions[i])
        velocity = (after[tip].act(point) - before[tip].act(point)) / (2.0 * step)
        turn = pinocchio.log3(after[tip].rotation @ before[tip].rotation.T) / (2.0 * step)
        power += push.forces[i] @ velocity + push.moments[i] @ turn
    assert efforts @ rates == pytest.approx(power, abs=1e-6)


def _placements(q):
    """Pose of every link of D'Claw in the frame of its base."""
    model = pinocchio.buildModelFromUrdf(str(dclaw_directory() / URDF))
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, q)
    return {frame.name: data.oMf[i] for i, frame in enumerate(model.frames)}


def test_jacobians_and_gravity_are_those_of_the_simulation(dclaw):
    """Another library, the same URDF: points of the last links, and what carries the hand."""
    model = build_hand_model(OBJECTS['ball'])
    data = mujoco.MjData(model.mujoco)
    rng = np.random.default_rng(3)
    q = rng.uniform(-0.5, 0.5, 9)
    data.qpos[model.joint_qpos] = q
    mujoco.mj_forward(model.mujoco, data)
    dclaw.update(q)
    for finger, tip in enumerate(TIPS):
        point = rng.normal(0.0, 0.1, 3)
        full = np.zeros((3, model.mujoco.nv))
        mujoco.mj_jac(model.mujoco, data, full, None, point, model.tip_bodies[finger])
        assert dclaw.jacobian(tip, point)[:3] == pytest.approx(full[:, model.joint_dof], abs=1e-6)
    bias = data.qfrc_bias[model.joint_dof]
    assert dclaw.gravity_efforts() == pytest.approx(bias, abs=1e-5)
    assert dclaw.effort_limits == pytest.approx(model.effort_limits[:, 1])


def test_any_link_may_be_the_base():
    """A hand turned as a whole pushes the same: forces given in the frame of a finger."""
    plain = two_fingers()
    turned = HandKinematics(urdf(), ['right_hinge', 'left_hinge'], base_frame='left_finger')
    turned.check_link('right_finger')
    q = np.array([0.3, -0.2])
    plain.update(q)
    turned.update(q)
    left = np.array([[np.cos(0.3), 0, np.sin(0.3)], [0, 1, 0], [-np.sin(0.3), 0, np.cos(0.3)]])
    origin = np.array([-0.05, 0.0, 0.0])
    push = pushes(np.random.default_rng(1), 1)
    in_finger = push.moved(left.T, -left.T @ origin)
    assert contact_efforts(turned, ['right_finger'], in_finger) == pytest.approx(
        contact_efforts(plain, ['right_finger'], push), abs=EXACT)


@given(strategies.lists(numbers, min_size=3, max_size=3),
       strategies.lists(strategies.floats(-0.9, 0.9), min_size=3, max_size=3))
def test_saturation_scales_all_alike_and_no_more_than_needed(efforts, offset):
    efforts, offset, limits = np.array(efforts), np.array(offset), np.ones(3)
    found, scale = saturated(efforts, offset, limits)
    assert 0.0 <= scale <= 1.0 and (np.abs(found) <= limits).all()
    assert found == pytest.approx(scale * efforts + offset, abs=EXACT)
    if scale < 1.0:  # a joint is at its limit
        assert np.abs(np.abs(found) - limits).min() <= EXACT


def test_saturated_forces_keep_the_direction_of_the_net_wrench(dclaw):
    push = pushes(np.random.default_rng(5))
    dclaw.update(np.full(9, 0.2))
    efforts = contact_efforts(dclaw, TIPS, push)
    found, scale = saturated(efforts, np.zeros(9), 0.5 * np.abs(efforts).max() * np.ones(9))
    assert scale == pytest.approx(0.5, abs=EXACT)
    less = Pushes(push.names, push.positions, scale * push.forces, scale * push.moments)
    assert contact_efforts(dclaw, TIPS, less) == pytest.approx(found, abs=EXACT)
    assert less.wrench() == pytest.approx(scale * push.wrench(), abs=EXACT)


def test_a_hand_too_heavy_for_its_motors_pushes_nothing():
    found, scale = saturated(np.array([0.5, 0.5]), np.array([0.0, 3.0]), np.array([1.0, 2.0]))
    assert scale == 0.0 and found.tolist() == [0.0, 2.0]


def test_joint_limits_are_the_same_mapping(dclaw):
    """T x + tau_g of a grasp's local forces is what the bridge would command for them."""
    rng = np.random.default_rng(7)
    grasp = Grasp([Contact(rng.normal(0.0, 0.03, 3), normal=rng.normal(size=3),
                           model=ContactModel.SFCE, name=f'finger_{i}') for i in range(3)])
    R, p = np.linalg.qr(rng.normal(size=(3, 3)))[0], np.array([0.0, 0.0, 0.2])
    R *= np.linalg.det(R)
    dclaw.update(rng.uniform(-0.5, 0.5, 9))
    forces = rng.normal(size=(3, 4))
    push = Pushes(grasp.names, grasp.positions,
                  np.einsum('kij,kj->ki', grasp.rotations, forces[:, :3]),
                  grasp.rotations[:, :, 2] * forces[:, 3:]).moved(R, p)
    limits = joint_limits(dclaw, TIPS, grasp, R, p)
    assert limits.torques(forces) == pytest.approx(
        contact_efforts(dclaw, TIPS, push) + dclaw.gravity_efforts(), abs=EXACT)
    assert limits.names == tuple(JOINTS)


def test_what_is_refused():
    for arguments, words in (
            (('nonsense', ['a']), 'no URDF'), ((urdf(), ['knuckle']), 'left_hinge'),
            ((urdf(), []), 'joints must name'), ((urdf(effort=0.0), ['left_hinge']), 'no effort'),
            ((urdf(), ['left_hinge'], 'thumb'), "'thumb' is no link")):
        with pytest.raises(BadHand, match=words):
            HandKinematics(*arguments)
    assert two_fingers().effort_limits.tolist() == [EFFORT, EFFORT]

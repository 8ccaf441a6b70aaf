# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the kinematics of the fingertips."""

from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_messages import quaternion
from grasp_quality_hand.hand_model import build_hand_model, TIP_RADIUS
from grasp_quality_hand.kinematics import (
    inverse_kinematics, OutOfReach, tip_jacobian, tip_positions)
from grasp_quality_hand.measured_grasp import rotation
import mujoco
import numpy as np
import pytest


@pytest.fixture(scope='module')
def hand():
    """Return the model of the hand with the cube."""
    return build_hand_model(OBJECTS['cube'])


def at(hand, q):
    """Return MuJoCo's data with the joints at q, shape (9,) [rad]."""
    data = mujoco.MjData(hand.mujoco)
    data.qpos[hand.joint_qpos] = q
    mujoco.mj_kinematics(hand.mujoco, data)
    mujoco.mj_comPos(hand.mujoco, data)
    return data


@pytest.mark.parametrize('name', sorted(OBJECTS))
def test_inverse_kinematics_undoes_forward_kinematics(hand, name):
    held = OBJECTS[name]
    targets = (held.contact_points + [0.0, 0.0, held.height]
               - TIP_RADIUS * held.inward_normals)
    q = inverse_kinematics(hand, targets)
    assert np.abs(tip_positions(hand, at(hand, q)) - targets).max() < 1e-6
    limits = hand.mujoco.jnt_range[:9]
    assert np.all(q >= limits[:, 0]) and np.all(q <= limits[:, 1])


def test_jacobian_is_the_derivative_of_the_position(hand):
    q, step = np.full(9, 0.2), 1e-6
    tips = tip_positions(hand, at(hand, q))
    for finger in range(3):
        J = tip_jacobian(hand, at(hand, q), finger, tips[finger])
        for joint in range(3):
            moved = q.copy()
            moved[3 * finger + joint] += step
            difference = (tip_positions(hand, at(hand, moved))[finger] - tips[finger]) / step
            assert np.allclose(J[:, joint], difference, atol=1e-6)


def test_a_point_out_of_reach_is_named(hand):
    targets = tip_positions(hand, at(hand, np.zeros(9)))
    targets[1] += [0.0, 0.0, 0.5]
    with pytest.raises(OutOfReach, match='finger 2'):
        inverse_kinematics(hand, targets)


def test_quaternion_and_rotation_undo_each_other():
    random = np.random.default_rng(0)
    for direction in [*np.eye(4), *random.normal(size=(100, 4))]:
        q = direction / np.linalg.norm(direction)
        R = rotation(q)
        assert np.allclose(R.T @ R, np.eye(3)) and np.isclose(np.linalg.det(R), 1.0)
        assert np.isclose(abs(quaternion(R) @ q), 1.0)

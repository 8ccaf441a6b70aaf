# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Forward, differential and inverse kinematics of the fingertips."""

from grasp_quality_hand.hand_model import TIP_CENTRE
import mujoco
import numpy as np

OUTWARD_THEN_INWARD = np.deg2rad([0.0, 35.0, 70.0])    # size of each joint's bend at the start
DAMPING = 1e-3                                         # of the least squares [m/rad]
TOLERANCE = 1e-6                                       # of the tip's position [m]
MAX_ITERATIONS = 200


class OutOfReach(ValueError):
    """A fingertip cannot come to the point that was asked for."""


def tip_positions(hand, data):
    """Return the centres of the fingertips in the world frame, shape (3, 3), in metres."""
    rotations = data.xmat[hand.tip_bodies].reshape(3, 3, 3)
    return data.xpos[hand.tip_bodies] + rotations @ TIP_CENTRE


def tip_jacobian(hand, data, finger, point):
    """
    Return the Jacobian of a point of one finger's last link.

    Parameters
    ----------
    hand : HandModel
        The hand.
    data : mujoco.MjData
        After kinematics and mj_comPos.
    finger : int
        Index of the finger.
    point : array, shape (3,)
        World frame [m].

    Returns
    -------
    ndarray, shape (3, 3)
        Velocity in the world frame for the rates of the finger's three joints [m/rad].

    """
    full = np.zeros((3, hand.mujoco.nv))
    mujoco.mj_jac(hand.mujoco, data, full, None, np.asarray(point, float),
                  hand.tip_bodies[finger])
    return full[:, hand.joint_dof[3 * finger:3 * finger + 3]]


def inverse_kinematics(hand, targets):
    """
    Return the joint angles that bring the centres of the fingertips to targets.

    Damped least squares, begun with each finger bent out at its second joint and in again at its
    third, so that the solution is the one that reaches around an object.

    Parameters
    ----------
    hand : HandModel
        The hand.
    targets : array, shape (3, 3)
        World frame [m].

    Returns
    -------
    ndarray, shape (9,)
        [rad]

    """
    data = mujoco.MjData(hand.mujoco)
    limits = hand.mujoco.jnt_range[[hand.mujoco.joint(name).id for name in hand.joint_names]]
    q = _start(hand, data)
    for _ in range(MAX_ITERATIONS):
        data.qpos[hand.joint_qpos] = q
        mujoco.mj_kinematics(hand.mujoco, data)
        mujoco.mj_comPos(hand.mujoco, data)
        tips = tip_positions(hand, data)
        errors = np.asarray(targets) - tips    # (3, 3)
        if np.linalg.norm(errors, axis=1).max() < TOLERANCE:
            return q
        for finger, (tip, error) in enumerate(zip(tips, errors)):
            J = tip_jacobian(hand, data, finger, tip)
            step = J.T @ np.linalg.solve(J @ J.T + DAMPING**2 * np.eye(3), error)
            q[3 * finger:3 * finger + 3] += step
        q = np.clip(q, limits[:, 0], limits[:, 1])
    worst = int(np.linalg.norm(errors, axis=1).argmax())
    raise OutOfReach(f'the tip of finger {worst + 1} stays '
                     f'{1e3 * np.linalg.norm(errors[worst]):.1f} mm from its target '
                     f'{np.round(targets[worst], 4).tolist()} m: place the object nearer')


def _start(hand, data):
    """Return joint angles with every finger bent outward at joint 1 and inward at joint 2."""
    mujoco.mj_kinematics(hand.mujoco, data)
    mujoco.mj_comPos(hand.mujoco, data)
    q = np.zeros(9)
    for finger, tip in enumerate(tip_positions(hand, data)):
        outward = np.append(tip[:2], 0.0) / np.linalg.norm(tip[:2])
        sign = np.sign(outward @ tip_jacobian(hand, data, finger, tip))    # (3,) of joint rates
        q[3 * finger:3 * finger + 3] = sign * OUTWARD_THEN_INWARD * [0.0, 1.0, -1.0]
    return q

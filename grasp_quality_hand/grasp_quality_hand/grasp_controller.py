# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The controller that opens and closes the hand and squeezes what it holds."""

from grasp_quality_hand.hand_model import TIP_RADIUS
from grasp_quality_hand.kinematics import inverse_kinematics, tip_positions
import mujoco
import numpy as np

STIFFNESS = 10.0              # of the joints [N m/rad]
CLEARANCE = 0.03              # of the open fingertips from the object [m]
APPROACH_TIME = 0.6           # from open to touch [s]
SQUEEZE_TIME = 0.4            # from touch to the full squeeze [s]
NO_TORQUE = np.zeros(3)


class GraspController:
    """
    Joint torques: stiffness about a posture, plus J^T f of the squeeze, plus gravity.

    The posture is the open one until close_hand is called; then it moves to where the fingertips
    touch. The squeeze is a balanced set of fingertip forces, so that it does not move the object;
    the object's weight is added to it in equal shares.

    """

    def __init__(self, hand, grasp_object, squeeze_force, damping=0.0):
        self._hand = hand
        self._squeeze_force = float(squeeze_force)
        self._damping = damping    # beside that of the motors [N m s/rad]
        self._object = grasp_object
        self._weight = grasp_object.mass * -hand.mujoco.opt.gravity    # (3,) [N], upward
        touch = grasp_object.contact_points + [0.0, 0.0, grasp_object.height]
        self.q_touch = inverse_kinematics(hand, self._tip_targets(touch, 0.0))
        self.q_open = inverse_kinematics(hand, self._tip_targets(touch, CLEARANCE))
        self._closed_at = None
        self._held = None

    def _tip_targets(self, touch, clearance):
        """Return where the centres of the fingertips stand off the object by clearance."""
        return touch - (TIP_RADIUS + clearance) * self._object.inward_normals

    def open_hand(self):
        """Go to the open posture."""
        self._closed_at = self._held = None

    def close_hand(self, time):
        """Begin to close at the simulated time, in seconds."""
        if self._closed_at is None:
            self._closed_at = time

    def hold_here(self, data):
        """Take the joint angles as they are for the posture of the closed hand."""
        self._held = data.qpos[self._hand.joint_qpos].copy()

    def squeeze_share(self, time):
        """Return the share of the full squeeze at the simulated time, in [0, 1]."""
        if self._closed_at is None:
            return 0.0
        return float(np.clip((time - self._closed_at - APPROACH_TIME) / SQUEEZE_TIME, 0.0, 1.0))

    def torques(self, data):
        """Return the joint torques, shape (9,), in newton metres."""
        hand = self._hand
        error = self._posture(data.time) - data.qpos[hand.joint_qpos]
        torques = (STIFFNESS * error - self._damping * data.qvel[hand.joint_dof]
                   + data.qfrc_bias[hand.joint_dof])
        share = self.squeeze_share(data.time)
        if share > 0.0:
            torques += share * self._squeeze_torques(data)
        return torques

    def _posture(self, time):
        """Return the joint angles to hold at the simulated time, shape (9,) [rad]."""
        if self._closed_at is None:
            return self.q_open
        if self._held is not None:
            return self._held
        s = min((time - self._closed_at) / APPROACH_TIME, 1.0)
        s = s * s * (3.0 - 2.0 * s)
        return (1.0 - s) * self.q_open + s * self.q_touch

    def _squeeze_torques(self, data):
        """Return J^T f of the full squeeze, shape (9,) [N m]."""
        hand = self._hand
        R_world_object = data.xmat[hand.object_body].reshape(3, 3)
        forces = self._squeeze_force * self._object.squeeze @ R_world_object.T
        forces = forces + self._weight / len(forces)    # (3, 3), world frame [N]
        generalised = np.zeros(hand.mujoco.nv)
        for body, tip, force in zip(hand.tip_bodies, tip_positions(hand, data), forces):
            mujoco.mj_applyFT(hand.mujoco, data, force, NO_TORQUE, tip, body, generalised)
        return generalised[hand.joint_dof]

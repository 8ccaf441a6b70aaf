# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand with an object in it."""

from grasp_quality_hand.contact_reading import contact_points, finger_contacts
from grasp_quality_hand.effort_input import COMMAND_TIMEOUT, EffortInput
from grasp_quality_hand.grasp_controller import GraspController
from grasp_quality_hand.grasp_objects import load
from grasp_quality_hand.hand_model import build_hand_model, DAMPING
from grasp_quality_hand.point_controller import object_grasp, PointController
from grasp_quality_hand.point_hand_model import build_point_hand
from grasp_quality_hand.pull import Pull
from grasp_quality_hand.slip import Pose
import mujoco
import numpy as np

SQUEEZE_FORCE = 5.0           # largest normal force of the squeeze [N]
DCLAW, POINTS = 'dclaw', 'points'
SLIP_LIMITS = {DCLAW: 5e-4, POINTS: 1e-4}    # |dp| + 20 mm |dtheta| that counts as slip [m]
NO_LOAD = np.zeros(6)


class HandSimulation:
    """
    A hand with one object, its controller and its contacts.

    The hand is D'Claw, palm up, or three ideal contact points in the same places.

    A holder keeps the object in place until the fingers squeeze it in full, and takes it back
    when the hand opens. While effort commands come, and the fingers alone hold the object, they
    are the torques of the joints; otherwise the hand's own controller is.

    """

    def __init__(self, grasp_object='cube', squeeze_force=SQUEEZE_FORCE, dclaw=None,
                 command_timeout=COMMAND_TIMEOUT, hand=DCLAW, joint_damping=DAMPING):
        self.object = load(grasp_object) if isinstance(grasp_object, str) else grasp_object
        if hand == DCLAW:
            self.hand = build_hand_model(self.object, dclaw)
            self.hand.mujoco.dof_damping[self.hand.joint_dof] = joint_damping
            self.controller = GraspController(self.hand, self.object, squeeze_force,
                                              max(DAMPING - joint_damping, 0.0))
        else:
            self.hand = build_point_hand(self.object, object_grasp(self.object, squeeze_force),
                                         real_time=True)
            self.controller = PointController(self.hand, self.object, squeeze_force)
        self.data = mujoco.MjData(self.hand.mujoco)
        self.slip_limit = SLIP_LIMITS[hand]
        self.pull = None             # the Pull that there is, or was last
        self.efforts = EffortInput(self.hand.joint_names, command_timeout)
        self.data.qpos[self.hand.joint_qpos] = self.controller.q_open
        mujoco.mj_forward(self.hand.mujoco, self.data)

    @property
    def time(self):
        """Return the simulated time in seconds."""
        return self.data.time

    @property
    def held(self):
        """Return whether the fingers alone hold the object."""
        return not self.data.eq_active[self.hand.holder]

    def close_hand(self):
        """Close the hand on the object and let go of the holder when it is squeezed."""
        self.controller.close_hand(self.time)

    def open_hand(self):
        """Put the object back into the holder and open the hand."""
        address = self.hand.object_qpos
        self.data.qpos[address:address + 7] = self.hand.mujoco.qpos0[address:address + 7]
        self.data.eq_active[self.hand.holder] = 1
        self.efforts.forget()
        self.pull = None
        self.controller.open_hand()

    def advance(self, duration):
        """Simulate whole time steps for about a duration in seconds; return their sum."""
        timestep = self.hand.mujoco.opt.timestep
        steps = round(duration / timestep)
        for _ in range(steps):
            if self.controller.squeeze_share(self.time) == 1.0:
                self.data.eq_active[self.hand.holder] = 0
            self.data.ctrl[:] = self._torques(timestep)
            self._apply_load(timestep)
            mujoco.mj_step(self.hand.mujoco, self.data)
        return steps * timestep

    def begin_pull(self, wrench, growth, limit, slip_limit):
        """Begin a pull on what is held; see Pull."""
        self.pull = Pull(wrench, growth, limit, slip_limit, self.object_pose())

    @property
    def load(self):
        """Return what a pull does to the object now, shape (6,), object frame [N, N m]."""
        return NO_LOAD if self.pull is None else self.pull.load

    def _apply_load(self, timestep):
        """Let the load of a pull grow, and put it on the object for this time step."""
        if self.pull is not None:
            self.pull.advance(timestep, self.object_pose())
        body = self.hand.object_body
        R = self.data.xmat[body].reshape(3, 3)
        self.data.xfrc_applied[body, :3] = R @ self.load[:3]
        self.data.xfrc_applied[body, 3:] = R @ self.load[3:]

    def command_efforts(self, efforts):
        """Take efforts for the joints, shape (n,); raise BadCommand for unusable ones."""
        self.efforts.put(efforts, self.time)

    def _torques(self, timestep):
        """Return the efforts of the motors for this time step, shape (n,)."""
        torques = self.controller.torques(self.data)
        if self.held:
            torques = self.efforts.mix(torques, self.time, timestep)
            if self.efforts.share > 0.0:
                self.controller.hold_here(self.data)
        return np.clip(torques, *self.hand.effort_limits.T)

    def finger_contacts(self):
        """Return one MeasuredContact per finger, in the order of FINGERS."""
        return finger_contacts(self.hand, self.data)

    def contact_points(self):
        """Return all points of contact between fingers and object, twins merged."""
        return contact_points(self.hand, self.data)

    def joint_positions(self):
        """Return the joint positions, shape (n,) [rad, m]."""
        return self.data.qpos[self.hand.joint_qpos].copy()

    def joint_velocities(self):
        """Return the joint velocities, shape (n,) [rad/s, m/s]."""
        return self.data.qvel[self.hand.joint_dof].copy()

    def joint_efforts(self):
        """Return the efforts of the motors, shape (n,) [N m, N]."""
        return self.data.ctrl.copy()

    def object_pose(self):
        """Return the Pose of the object in the hand's base frame."""
        body = self.hand.object_body
        return Pose(self.data.xpos[body].copy(), self.data.xquat[body].copy())

    def object_position(self):
        """Return the object's position in the hand's base frame, shape (3,) [m]."""
        return self.data.xpos[self.hand.object_body].copy()

    def object_quaternion(self):
        """Return the object's orientation in the hand's base frame, (x, y, z, w)."""
        w, x, y, z = self.data.xquat[self.hand.object_body]
        return np.array([x, y, z, w])

    def up_in_object_frame(self):
        """Return the direction away from gravity in the object frame, shape (3,)."""
        return self.data.xmat[self.hand.object_body].reshape(3, 3).T @ [0.0, 0.0, 1.0]

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand with an object in it."""

from grasp_quality_hand.contact_reading import contact_points, finger_contacts
from grasp_quality_hand.effort_input import COMMAND_TIMEOUT, EffortInput
from grasp_quality_hand.grasp_controller import GraspController
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_model import build_hand_model, TIMESTEP
import mujoco
import numpy as np

SQUEEZE_FORCE = 5.0           # largest normal force of the squeeze [N]


class HandSimulation:
    """
    D'Claw, palm up, with one object, its controller and its contacts.

    A holder keeps the object in place until the fingers squeeze it in full, and takes it back
    when the hand opens. While effort commands come, and the fingers alone hold the object, they
    are the torques of the joints; otherwise the hand's own controller is.

    """

    def __init__(self, object_name='cube', squeeze_force=SQUEEZE_FORCE, dclaw=None,
                 command_timeout=COMMAND_TIMEOUT):
        if object_name not in OBJECTS:
            raise ValueError(f'object {object_name!r} is not known: it must be one of '
                             f'{", ".join(OBJECTS)}')
        self.object = OBJECTS[object_name]
        self.hand = build_hand_model(self.object, dclaw)
        self.data = mujoco.MjData(self.hand.mujoco)
        self.controller = GraspController(self.hand, self.object, squeeze_force)
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
        self.controller.open_hand()

    def advance(self, duration):
        """Simulate whole time steps for about a duration in seconds; return their sum."""
        steps = round(duration / TIMESTEP)
        for _ in range(steps):
            if self.controller.squeeze_share(self.time) == 1.0:
                self.data.eq_active[self.hand.holder] = 0
            self.data.ctrl[:] = self._torques()
            mujoco.mj_step(self.hand.mujoco, self.data)
        return steps * TIMESTEP

    def command_efforts(self, efforts):
        """Take torques for the joints, shape (9,) [N m]; raise BadCommand for unusable ones."""
        self.efforts.put(efforts, self.time)

    def _torques(self):
        """Return the torques of the motors for this time step, shape (9,) [N m]."""
        torques = self.controller.torques(self.data)
        if self.held:
            torques = self.efforts.mix(torques, self.time, TIMESTEP)
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
        """Return the joint angles, shape (9,) [rad]."""
        return self.data.qpos[self.hand.joint_qpos].copy()

    def joint_velocities(self):
        """Return the joint rates, shape (9,) [rad/s]."""
        return self.data.qvel[self.hand.joint_dof].copy()

    def joint_efforts(self):
        """Return the torques of the motors, shape (9,) [N m]."""
        return self.data.ctrl.copy()

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

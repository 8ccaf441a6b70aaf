# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Pulls on what D'Claw holds with optimised forces, until the object slips.

The hand closes by itself; from then on its joints are commanded tau = J^T f + weight, with the
forces of ``holding_forces`` for the load that there is, at the contacts as they are.
"""

from dataclasses import replace
from typing import Any

from benchmarks.truth.bound_law import bound_ratio
from benchmarks.truth.felt import felt_grasp
from benchmarks.truth.slow_pull import Pulled, Rig, slow_pull
from grasp_quality import Contact, ContactModel, Grasp
from grasp_quality_hand.grasp_objects import load
from grasp_quality_hand.holding_forces import holding_forces
from grasp_quality_hand.pose_feedback import PoseFeedback
from grasp_quality_hand.simulation import HandSimulation
from grasp_quality_hand.slip import Pose
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SLIP = 5e-4                  # |dp| + 20 mm |dtheta| [m]
CAP = 10.0                   # largest normal force of a finger [N]
CLOSING_TIME = 1.5           # until the hand holds the object at rest [s]
DAMPING = 0.05               # of the joints while pulled: it would hold what already slips
MOVED = (1.0, 6e-4)          # object and fingers, as the feedback sees them [kg, kg m^2]
FREQUENCY = 40.0             # of the pose feedback [rad/s]
GROWTH = 0.05                # of alpha a second
STEPS = 3                    # of the simulation for one of the commands
STATE = mujoco.mjtState.mjSTATE_INTEGRATION


class DClawRig(Rig):
    """D'Claw with an object in its fingers, commanded by forces at its contacts."""

    ramp = 0.2

    def __init__(self, name: str, model: ContactModel) -> None:
        grasp_object = load(name)
        if model is ContactModel.PCWF:
            grasp_object = replace(grasp_object, torsional_friction=0.0)
        self._simulation = HandSimulation(grasp_object)
        self._simulation.close_hand()
        self._simulation.advance(CLOSING_TIME)
        self._hand, self._data = self._simulation.hand, self._simulation.data
        self._model: Any = self._hand.mujoco
        self._model.dof_damping[self._hand.joint_dof] = DAMPING
        contacts = self._simulation.finger_contacts()
        super().__init__(Grasp([
            Contact(position=contact.position, rotation=contact.R_object_contact, model=model,
                    friction=grasp_object.friction, max_normal_force=CAP,
                    torsional_friction=grasp_object.torsional_friction,
                    name=f'finger_{contact.finger}') for contact in contacts]))
        self._closed = (self.grasp, np.array([contact.force for contact in contacts]))
        self._state = np.empty(mujoco.mj_stateSize(self._model, STATE))
        mujoco.mj_getState(self._model, self._data, self._state, STATE)
        self._place = self.pose()
        self.period = STEPS * float(self._model.opt.timestep)
        self.weight = np.zeros(6)
        self.weight[:3] = (self._simulation.up_in_object_frame() * grasp_object.mass
                           * self._model.opt.gravity[2])
        self.begin_anew()

    def begin_anew(self) -> None:
        """Go back to the moment when the hand had closed."""
        mujoco.mj_setState(self._model, self._data, self._state, STATE)
        mujoco.mj_forward(self._model, self._data)
        self.grasp, self._forces = self._closed
        self._load = np.zeros(6)
        self._feedback = PoseFeedback(self.grasp, *MOVED, FREQUENCY)

    def pose(self) -> Pose:
        """Return the pose of the object."""
        body = self._hand.object_body
        return Pose(self._data.xpos[body].copy(), self._data.xquat[body].copy())

    def feel(self) -> None:
        """Take the contacts to be where they are felt."""
        self.grasp = felt_grasp(self.grasp, self._simulation.finger_contacts())
        self._feedback = PoseFeedback(self.grasp, *MOVED, FREQUENCY)

    def bound_ratio(self) -> float:
        """Return the ratio of the bound law now."""
        return bound_ratio(self.grasp, self._simulation.finger_contacts())

    def _simulate(self, forces: Array, load_now: Array) -> None:
        """Simulate one period."""
        data, body = self._data, self._hand.object_body
        R = data.xmat[body].reshape(3, 3)
        data.ctrl[:] = np.clip(self._torques(forces, R), *self._hand.effort_limits.T)
        data.xfrc_applied[body, :3] = R @ load_now[:3]
        data.xfrc_applied[body, 3:] = R @ load_now[3:]
        mujoco.mj_step(self._model, data, nstep=STEPS)

    def _torques(self, forces: Array, R: Array) -> Array:
        """Return J^T f and the weight of the fingers, with the feedback on the object's pose."""
        data, hand = self._data, self._hand
        moved, velocity = self._place.displacement_to(self.pose()), data.qvel[-6:]
        forces = self._feedback.corrected(
            forces, np.concatenate([R.T @ moved[:3], R.T @ moved[3:]]),
            np.concatenate([R.T @ velocity[:3], velocity[3:]]))
        generalised = np.zeros(self._model.nv)
        for contact, rotation, force in zip(self._simulation.finger_contacts(),
                                            R @ self.grasp.rotations, forces):
            point = data.xpos[hand.object_body] + R @ contact.position
            mujoco.mj_applyFT(self._model, data, rotation @ force[:3],
                              rotation[:, 2] * force[3], point, hand.tip_bodies[contact.finger],
                              generalised)
        torques = generalised[hand.joint_dof] + data.qfrc_bias[hand.joint_dof]
        return np.asarray(torques, dtype=np.float64)


def directions(count: int) -> Array:
    """Return unit vectors spread evenly over the sphere, (count, 3)."""
    index = np.arange(count) + 0.5
    z, azimuth = 1.0 - 2.0 * index / count, np.pi * (1.0 + 5.0**0.5) * index
    radius = np.sqrt(1.0 - z * z)
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], axis=1)


def dclaw_pull(rig: DClawRig, direction: Array) -> Pulled:
    """Pull against a direction (3,), object frame, in which the fingers apply alpha newtons."""
    rig.begin_anew()
    task = np.append(direction, np.zeros(3))
    rig.go(holding_forces(rig.grasp, task, rig.weight).at(0.0), np.zeros(6))
    rig.feel()
    forces = holding_forces(rig.grasp, task, rig.weight)
    return slow_pull(rig, forces.at, forces.alpha, task, GROWTH, SLIP)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The contact-point hand's own controller: it opens, closes, squeezes, and keeps the object."""

from typing import Any

from grasp_quality import Contact, ContactModel, Grasp
from grasp_quality_hand.grasp_objects import GraspObject
from grasp_quality_hand.hand_physics import HandModel
from grasp_quality_hand.pose_feedback import PoseFeedback
from grasp_quality_hand.slip import Pose
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
STIFFNESS = 20.0             # of a sphere that is not pressed on the object [N/m]
DAMPING = 0.2                # [N s/m]
CLEARANCE = 0.02             # of the open spheres from the object [m]
APPROACH_TIME = 0.6          # from open to touch [s]
SQUEEZE_TIME = 0.4           # from touch to the full squeeze [s]
FREQUENCY = 400.0            # of the feedback on the object's pose [rad/s]
CAP = 1.5                    # of a normal force, as a share of the squeeze


def object_grasp(grasp_object: GraspObject, cap: float) -> Grasp:
    """Return the three contacts, with their cap [N], that a hand takes on an object."""
    model = ContactModel.SFCE if grasp_object.torsional_friction > 0.0 else ContactModel.PCWF
    return Grasp([
        Contact(position=position, normal=normal, friction=grasp_object.friction,
                torsional_friction=grasp_object.torsional_friction, max_normal_force=cap,
                model=model, name=f'finger_{index + 1}')
        for index, (position, normal) in enumerate(
            zip(grasp_object.contact_points, grasp_object.inward_normals))])


class PointController:
    """Spheres stand off the object until they are closed; then they press with balanced forces."""

    def __init__(self, hand: HandModel, grasp_object: GraspObject, squeeze_force: float) -> None:
        self._hand, self._grasp = hand, object_grasp(grasp_object, CAP * squeeze_force)
        self._squeeze = squeeze_force * grasp_object.squeeze                      # (3, 3) [N]
        self._weight = grasp_object.mass * -hand.mujoco.opt.gravity    # (3,) [N], upward
        inertia = float(hand.mujoco.body_inertia[hand.object_body].mean())
        self._feedback = PoseFeedback(self._grasp, grasp_object.mass, inertia, FREQUENCY)
        per_sphere = len(hand.joint_names) // len(self._grasp)
        self._away = np.zeros((len(self._grasp), per_sphere))    # of each sphere's joints [m]
        self._away[:, :3] = -CLEARANCE * grasp_object.inward_normals
        self.q_open = self._away.ravel()
        self._closed_at: float | None = None
        self._place: Pose | None = None

    def open_hand(self) -> None:
        """Go off the object."""
        self._closed_at = self._place = None

    def close_hand(self, time: float) -> None:
        """Begin to close at the simulated time, in seconds."""
        if self._closed_at is None:
            self._closed_at = time

    def hold_here(self, data: Any) -> None:
        """Keep the object where it is now."""
        self._place = self._pose(data)

    def squeeze_share(self, time: float) -> float:
        """Return the share of the full squeeze at the simulated time, in [0, 1]."""
        if self._closed_at is None:
            return 0.0
        return float(np.clip((time - self._closed_at - APPROACH_TIME) / SQUEEZE_TIME, 0.0, 1.0))

    def torques(self, data: Any) -> Array:
        """Return the efforts of the spheres' joints, shape (n,) [N, N m]."""
        hand, share = self._hand, self.squeeze_share(data.time)
        position = data.qpos[hand.joint_qpos].reshape(self._away.shape)
        velocity = data.qvel[hand.joint_dof].reshape(self._away.shape)
        efforts = STIFFNESS * (self._wanted(data.time) - position) - DAMPING * velocity
        efforts[:, 3:] = 0.0
        if share > 0.0:
            efforts = (1.0 - share) * efforts + share * self._pressing(data)
        return np.asarray(efforts.ravel(), dtype=np.float64)

    def _wanted(self, time: float) -> Array:
        """Return where the spheres are to be at the simulated time."""
        if self._closed_at is None:
            return self._away
        return self._away * (1.0 - min((time - self._closed_at) / APPROACH_TIME, 1.0))

    def _pressing(self, data: Any) -> Array:
        """Return the efforts of the full squeeze, which carries the weight and keeps the pose."""
        R = data.xmat[self._hand.object_body].reshape(3, 3)
        if self._place is None:
            self._place = self._pose(data)
        moved, velocity = self._place.displacement_to(self._pose(data)), data.qvel[:6]
        forces = self._squeeze + self._weight @ R / len(self._grasp)
        local = np.zeros((len(self._grasp), 4))
        local[:, :3] = np.einsum('kji,kj->ki', self._grasp.rotations, forces)
        local = self._feedback.corrected(
            local, np.concatenate([R.T @ moved[:3], R.T @ moved[3:]]),
            np.concatenate([R.T @ velocity[:3], velocity[3:]]))
        efforts = np.array(local)[:, :self._away.shape[1]]
        efforts[:, :3] = np.einsum('kij,kj->ki', R @ self._grasp.rotations, local[:, :3])
        return efforts

    def _pose(self, data: Any) -> Pose:
        """Return the pose of the object."""
        body = self._hand.object_body
        return Pose(data.xpos[body].copy(), data.xquat[body].copy())

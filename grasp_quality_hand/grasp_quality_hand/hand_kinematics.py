# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The hand's kinematics from its URDF, by Pinocchio: Jacobians of contact points, and gravity."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
import pinocchio

Array = NDArray[np.float64]
EARTH = (0.0, 0.0, -9.81)


class BadHand(ValueError):
    """The URDF and what is asked of it do not fit; the message says what and the way out."""


class HandKinematics:
    """
    A hand, in the frame of one of its links.

    ``update`` sets the posture that everything else is about.

    Parameters
    ----------
    urdf : str
        The robot description.
    joints : sequence of str
        Joints with a motor, in the order of efforts; every other movable joint is only measured.
    base_frame : str
        Link whose frame positions and forces are given in; empty means the URDF's root.
    gravity : (3,) sequence [m/s^2]
        In the frame of the URDF's root.

    """

    def __init__(self, urdf: str, joints: Sequence[str], base_frame: str = '',
                 gravity: Sequence[float] = EARTH) -> None:
        try:
            model: Any = pinocchio.buildModelFromXML(urdf)
        except (ValueError, RuntimeError) as error:
            raise BadHand(f'robot_description is no URDF that can be read: {error}') from None
        model.gravity.linear = np.array(gravity, dtype=np.float64)
        self._model, self._data = model, model.createData()
        self.movable: tuple[str, ...] = tuple(model.names)[1:]
        missing = [name for name in joints if name not in self.movable]
        if missing or not joints or len(set(joints)) < len(joints):
            raise BadHand(f'joints must name movable joints of the URDF, each once, got '
                          f'{list(joints)}; the URDF has {list(self.movable)}')
        wide = [name for name in self.movable
                if model.joints[model.getJointId(name)].nv != 1]
        if wide:
            raise BadHand(f'only joints of one degree of freedom are known, {wide} have more')
        self.joints: tuple[str, ...] = tuple(joints)
        self._columns = [self._index(name).idx_v for name in joints]
        self.base_frame = base_frame or str(model.frames[1].name)
        self._base = self._frame(self.base_frame)
        limits = np.array(model.effortLimit)[self._columns]
        without = [name for name, limit in zip(joints, limits)
                   if not (np.isfinite(limit) and limit > 0.0)]
        if without:
            raise BadHand(f'joints {without} have no effort limit in the URDF: give each a '
                          '<limit effort="..."/> above 0')
        self.effort_limits: Array = limits
        self._frames: dict[str, int] = {}

    def _index(self, joint: str) -> Any:
        return self._model.joints[self._model.getJointId(joint)]

    def _frame(self, link: str) -> int:
        if not self._model.existFrame(link):
            links = [frame.name for frame in self._model.frames
                     if frame.type == pinocchio.FrameType.BODY]
            raise BadHand(f'{link!r} is no link of the URDF; it has {links}')
        return int(self._model.getFrameId(link))

    def check_link(self, link: str) -> None:
        """Raise BadHand when the URDF has no such link."""
        self._frames[link] = self._frame(link)

    def update(self, positions: Array) -> None:
        """Take a posture: positions (m,) [rad, m for sliding joints] in the order of movable."""
        q = pinocchio.neutral(self._model)
        for name, value in zip(self.movable, positions):
            joint = self._index(name)
            if joint.nq == 2:  # a joint without limits is kept as cosine and sine
                q[joint.idx_q:joint.idx_q + 2] = np.cos(value), np.sin(value)
            else:
                q[joint.idx_q] = value
        pinocchio.computeJointJacobians(self._model, self._data, q)
        pinocchio.updateFramePlacements(self._model, self._data)
        self._gravity = pinocchio.computeGeneralizedGravity(self._model, self._data, q)

    def gravity_efforts(self) -> Array:
        """Efforts (n,) [N m, N] that carry the hand's own links."""
        return np.array(self._gravity[self._columns])

    def jacobian(self, link: str, point: Array) -> Array:
        """
        Jacobian of a point of a link.

        Parameters
        ----------
        link : str
            Checked before with ``check_link``.
        point : (3,) array [m]
            Base frame.

        Returns
        -------
        (6, n) array: velocity of that point and angular velocity of the link, along the axes of
        the base frame, for the rates of ``joints``

        """
        frame, base = self._frames[link], self._data.oMf[self._base]
        J = pinocchio.getFrameJacobian(
            self._model, self._data, frame, pinocchio.LOCAL_WORLD_ALIGNED)[:, self._columns]
        arm = base.act(np.asarray(point)) - self._data.oMf[frame].translation
        linear = J[:3] + np.cross(J[3:].T, arm).T
        return np.vstack([base.rotation.T @ linear, base.rotation.T @ J[3:]])

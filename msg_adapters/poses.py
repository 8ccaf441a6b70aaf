# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Poses: positions and rotation matrices of geometry_msgs/Pose messages, checked."""

from collections.abc import Sequence
import math

from grasp_quality.arrays import Array
from msg_adapters.errors import InvalidMessageError
from msg_adapters.message_types import Pose, Quaternion
from msg_adapters.number_checks import checked_numbers, LARGEST
import numpy as np

QUATERNION_TOLERANCE = 1e-3  # of the norm, before it is made exact

# R = 1 + sum over i, j of q_i q_j QUADRATIC[i, j] for a quaternion q = (x, y, z, w) of norm one
QUADRATIC = np.zeros((4, 4, 3, 3))
for _i, _j, _k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    QUADRATIC[_i, _i, _j, _j] = QUADRATIC[_i, _i, _k, _k] = -2.0
    QUADRATIC[_i, _j, _i, _j] = QUADRATIC[_i, _j, _j, _i] = 2.0
    QUADRATIC[_i, 3, _k, _j], QUADRATIC[_i, 3, _j, _k] = 2.0, -2.0


def frames_of(poses: Sequence[Pose], names: Sequence[str]) -> tuple[Array, Array]:
    """
    Read many geometry_msgs/Pose at once: much faster than one by one.

    Parameters
    ----------
    poses : sequence of geometry_msgs.msg.Pose
        Positions [m] and orientations of norm one.
    names : sequence of str
        Field name of each, for errors.

    Returns
    -------
    (k, 3) array [m], (k, 3, 3) array
        Positions and R_frame_pose.

    Raises
    ------
    InvalidMessageError
        For the first pose that ``pose_arrays`` refuses.

    """
    numbers = np.array([
        (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
        for p, q in ((pose.position, pose.orientation) for pose in poses)], float).reshape(-1, 7)
    positions, quaternions = numbers[:, :3], numbers[:, 3:]
    with np.errstate(over='ignore', invalid='ignore'):  # huge numbers; a NaN that signals
        norms = np.sqrt((quaternions * quaternions).sum(axis=1))
    # so written that nan is refused too
    if not ((np.abs(norms - 1.0) <= QUATERNION_TOLERANCE).all()
            and (np.abs(positions) <= LARGEST).all()):
        for pose, name in zip(poses, names):
            pose_arrays(pose, name)
    return positions, _rotations(quaternions / norms[:, None])


def _rotations(quaternions: Array) -> Array:
    """Return the rotation matrices (k, 3, 3) of quaternions (k, 4) of norm one."""
    products = quaternions[:, :, None] * quaternions[:, None, :]
    rotations: Array = products.reshape(-1, 16) @ QUADRATIC.reshape(16, 9) + np.eye(3).ravel()
    return rotations.reshape(-1, 3, 3)


def pose_arrays(pose: Pose, name: str) -> tuple[Array, Array]:
    """
    Read a geometry_msgs/Pose.

    Parameters
    ----------
    pose : geometry_msgs.msg.Pose
        Position [m] and orientation of norm one.
    name : str
        Field name, for the error.

    Returns
    -------
    (3,) array [m], (3, 3) array
        Position and R_frame_pose.

    Raises
    ------
    InvalidMessageError
        When a number is not finite or too large, or the quaternion does not have norm one.

    """
    p = pose.position
    position = np.array(checked_numbers((p.x, p.y, p.z), f'{name}.position'))
    return position, rotation_matrix(pose.orientation, f'{name}.orientation')


def rotation_matrix(quaternion: Quaternion, name: str) -> Array:
    """Return the rotation matrix (3, 3) of a geometry_msgs/Quaternion of norm one."""
    q = quaternion
    x, y, z, w = float(q.x), float(q.y), float(q.z), float(q.w)
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    if not abs(norm - 1.0) <= QUATERNION_TOLERANCE:  # catches nan and inf too
        raise InvalidMessageError(
            f'{name} must be a quaternion of norm 1, got ({x}, {y}, {z}, {w}) of norm {norm:g}: '
            'normalise it, the identity is (0, 0, 0, 1)')
    rotation: Array = _rotations(np.array([[x, y, z, w]]) / norm)[0]
    return rotation

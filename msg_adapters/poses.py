# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Poses: position and rotation matrix of a geometry_msgs/Pose, checked."""

import math

from grasp_quality.arrays import Array
from msg_adapters.errors import InvalidMessageError
from msg_adapters.message_types import Pose, Quaternion
from msg_adapters.number_checks import checked_numbers
import numpy as np

QUATERNION_TOLERANCE = 1e-3  # of the norm, before it is made exact


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
    x, y, z, w = x / norm, y / norm, z / norm, w / norm
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])

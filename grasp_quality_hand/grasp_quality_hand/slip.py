# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How far an object has slipped, and a pull that grows until it does."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LEVER = 0.020                # a turn counts as the way of a point so far off the centre [m]


@dataclass(frozen=True)
class Pose:
    """Position (3,) [m] and orientation (w, x, y, z) of the object in the world."""

    position: Array
    quaternion: Array

    def displacement_to(self, other: 'Pose') -> Array:
        """Return translation and rotation vector to the other pose, (6,) [m, rad], world axes."""
        w, x, y, z = self.quaternion
        v, q = np.array([-x, -y, -z]), other.quaternion
        scalar = q[0] * w - q[1:] @ v
        vector = q[0] * v + w * q[1:] + np.cross(q[1:], v)    # other * self^-1
        norm = np.linalg.norm(vector)
        if norm > 0.0:
            angle = 2.0 * np.arctan2(norm, abs(scalar)) * np.copysign(1.0, scalar)
            vector = vector * (angle / norm)
        return np.concatenate([other.position - self.position, vector])


def slip_distance(displacement: Array) -> float:
    """Return |dp| + 20 mm |dtheta| of a displacement (6,), in metres."""
    return float(np.linalg.norm(displacement[:3]) + LEVER * np.linalg.norm(displacement[3:]))

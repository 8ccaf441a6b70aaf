# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The load that a hand shall hold: the object's weight, and a spring that brings it back.

Contact forces in balance hold an object in a neutral equilibrium: nothing brings it back from
where the smallest error of model or sensor has carried it. Asking for the weight and a spring
makes the fingers do so, with forces that stay in the friction cones and under all limits.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
import pinocchio

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ObjectSpring:
    """
    A spring between the object and the place where it was taken.

    Attributes
    ----------
    stiffness : float
        [N/m]
    rotational_stiffness : float
        [N m/rad]
    max_force, max_torque : float
        What it asks for at most [N], [N m].

    """

    stiffness: float
    rotational_stiffness: float
    max_force: float
    max_torque: float

    def wrench(self, R_place: Array, p_place: Array, R: Array, p: Array) -> Array:
        """
        Wrench (6,) [N, N m] that brings the object back, in the object frame about its origin.

        Parameters
        ----------
        R_place, p_place : (3, 3) and (3,) arrays [m]
            Pose of the object's place in a fixed frame.
        R, p : (3, 3) and (3,) arrays [m]
            Pose of the object in the same frame.

        """
        force = _at_most(self.stiffness * (R.T @ (p_place - p)), self.max_force)
        turn = pinocchio.log3(R.T @ R_place)  # from the object to its place, object frame [rad]
        torque = _at_most(self.rotational_stiffness * turn, self.max_torque)
        return np.concatenate([force, torque])


def weight(mass: float, gravity: Array, R: Array) -> Array:
    """Weight (6,) [N, N m] of a mass at the object frame's origin, in the object frame."""
    return np.concatenate([mass * (R.T @ gravity), np.zeros(3)])


def _at_most(vector: Array, size: float) -> Array:
    length = float(np.linalg.norm(vector))
    return vector if length <= size else vector * (size / length)

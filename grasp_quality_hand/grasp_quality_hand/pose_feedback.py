# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Keeps a held object where it is, by small changes of the contact forces.

Constant forces in balance hold an object in a neutral equilibrium: nothing brings it back. The
feedback is a damped spring between object and the place where it was taken, made by the contacts
themselves, so that all forces stay in the friction cones and under the caps: it can add nothing
to a load that the grasp could not hold anyhow.

"""

from grasp_quality import Grasp
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
DAMPING_RATIO = 1.0


class PoseFeedback:
    """A damped spring on the object's pose."""

    def __init__(self, grasp: Grasp, mass: float, inertia: float, frequency: float) -> None:
        """
        Make the spring.

        Parameters
        ----------
        grasp : Grasp
            The contacts that pull and push.
        mass, inertia : float
            What the spring is to move [kg, kg m^2].
        frequency : float
            Of the spring [rad/s].

        """
        self._grasp = grasp
        inertias = np.repeat([mass, inertia], 3)
        self._stiffness = inertias * frequency**2
        self._damping = 2.0 * DAMPING_RATIO * inertias * frequency
        # share of the contacts in a wrench: least squares of forces, moments by their coefficient
        units = np.where(grasp.scales > 0.0, [1.0, 1.0, 1.0, grasp.lever_arm], 0.0)  # (k, 4)
        units[:, 3] = np.minimum(units[:, 3], grasp.scales[:, 3])
        matrix = (grasp.matrix * units).reshape(6, -1)
        self._distribution = units.reshape(-1, 1) * np.linalg.pinv(matrix)    # (4 k, 6)

    def corrected(self, forces: Array, displacement: Array, velocity: Array) -> Array:
        """
        Return forces that also push the object back.

        Parameters
        ----------
        forces : ndarray, shape (k, 4)
            [t1, t2, n, m_n] in the contact frames [N, N m].
        displacement : ndarray, shape (6,)
            How far the object is from its place, translation and rotation vector [m, rad].
        velocity : ndarray, shape (6,)
            [m/s, rad/s], both along the axes of the object frame.

        """
        wrench = -self._stiffness * displacement - self._damping * velocity
        return within_limits(self._grasp, forces + (self._distribution @ wrench).reshape(-1, 4))


def within_limits(grasp: Grasp, forces: Array) -> Array:
    """Return forces, shape (k, 4), with normals within the caps and sides within the cones."""
    limited = np.array(forces)
    limited[:, 2] = np.clip(limited[:, 2], 0.0, grasp.max_normal_forces)
    scales = grasp.scales[:, (0, 1, 3)]
    sides = np.divide(limited[:, (0, 1, 3)], scales, where=scales > 0.0,
                      out=np.zeros_like(scales))
    excess = np.linalg.norm(sides, axis=1)
    room = np.minimum(1.0, np.divide(limited[:, 2], excess, where=excess > 0.0,
                                     out=np.ones_like(excess)))
    limited[:, (0, 1, 3)] = scales * sides * room[:, None]
    return limited

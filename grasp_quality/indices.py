# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Indices of the grasp matrix: what the grasping literature compares grasps with.

They look at G alone and know neither friction coefficients, nor caps, nor that fingers only push:
a grasp that holds nothing can have fine indices. Here for comparison; ``ball`` and ``measures``
answer what a grasp can do.
"""

from dataclasses import dataclass

from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import checked_number, frozen
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp, RANK_TOLERANCE
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class GraspIndices:
    """
    Singular values of the grasp matrix, and what is made of them.

    Attributes
    ----------
    singular_values : (6,) array [-]
        Largest first, zeros included.
    torque_length : float [m]
        By which torques were divided.

    """

    singular_values: NDArray[np.float64]
    torque_length: float

    @property
    def smallest_singular_value(self) -> float:
        """Distance of the grasp matrix to one that loses a direction; 0 when it has."""
        return float(self.singular_values[-1])

    @property
    def isotropy(self) -> float:
        """Smallest over largest singular value, in [0, 1]."""
        return float(self.singular_values[-1] / self.singular_values[0])

    @property
    def manipulability(self) -> float:
        """Product of the singular values, sqrt(det(G G^T)): size of the image of a unit ball."""
        return float(np.prod(self.singular_values))


def grasp_indices(grasp: Grasp, torque_length: float = 1.0) -> GraspIndices:
    """
    Singular values of G, with torques about the object frame's origin over a length.

    The columns are those that the contact models transmit: unit forces, and for soft fingers the
    moment that a unit force makes at ``torque_length``.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames and models; friction counts as there or not there.
    torque_length : float [m]
        By which torques are divided, so that forces and torques compare.

    Returns
    -------
    GraspIndices

    Raises
    ------
    InvalidTaskError

    """
    require_grasp(grasp)
    length = checked_number(torque_length, 'torque_length [m]', InvalidTaskError, above=0.0)
    G = np.array(grasp.matrix)
    G[:, :, 3] *= length
    G[3:] /= length
    columns = G[:, grasp.scales > 0.0]  # (6, m)
    values = np.zeros(6)
    found = np.linalg.svd(columns, compute_uv=False)
    values[:len(found)] = np.where(found > RANK_TOLERANCE * found[0], found, 0.0)
    return GraspIndices(frozen(values), length)

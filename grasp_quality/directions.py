# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Sets of directions to draw a map of the wrench space with."""

from grasp_quality.arrays import Array, frozen
from grasp_quality.exceptions import InvalidTaskError
import numpy as np


def force_grid(resolution: int) -> Array:
    """
    Spread forces around the unit ball, as the paper's Fig. 3b.

    Parameters
    ----------
    resolution : int
        Steps r >= 1 of the polar angle; twice as many of the azimuth. 36 gives 2,592 directions.

    Returns
    -------
    (2 r^2, 6) array [N, N m]: unit forces without torque, polar angle outermost

    Raises
    ------
    InvalidTaskError

    """
    if not isinstance(resolution, (int, np.integer)) or resolution < 1:
        raise InvalidTaskError(f'resolution must be a whole number >= 1, got {resolution!r}')
    polar = (np.arange(resolution) + 0.5) * np.pi / resolution
    azimuth = np.arange(2 * resolution) * np.pi / resolution
    theta, phi = (a.ravel() for a in np.meshgrid(polar, azimuth, indexing='ij'))
    grid = np.zeros((theta.size, 6))
    grid[:, 0] = np.sin(theta) * np.cos(phi)
    grid[:, 1] = np.sin(theta) * np.sin(phi)
    grid[:, 2] = np.cos(theta)
    return frozen(grid)

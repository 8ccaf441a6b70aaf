# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Shapes and scales of what is drawn about a grasp, in the object frame.

Arrows and the surface of the map share one scale of metres per newton, so that the tip of the
arrow of alpha times a task that is a pure force touches the surface.
"""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Faces = NDArray[np.uint32]

STEPS = np.array([1.0, 2.0, 5.0, 10.0])


def automatic_force_scale(lever_arm: float, largest_cap: float) -> float:
    """
    Choose how long a newton is drawn: the largest cap about as long as the grasp's lever arm.

    Parameters
    ----------
    lever_arm : float
        Of the contacts about their mean [m], > 0.
    largest_cap : float
        Largest normal force of a contact [N], > 0.

    Returns
    -------
    float
        1, 2 or 5 times a power of ten [m/N], at most the wanted length: it stays the same while
        the contacts move a little.

    """
    wanted = lever_arm / largest_cap
    power = 10.0 ** math.floor(math.log10(wanted))
    return float(power * STEPS[STEPS <= wanted / power * (1.0 + 1e-9)].max())


def cone_mesh(friction: float, height: float, sides: int = 24) -> tuple[Array, Faces]:
    """
    Build the cone of forces that do not slip, apex at the contact, open along the normal.

    Parameters
    ----------
    friction : float
        Coulomb coefficient mu [-].
    height : float
        Along the normal [m].
    sides : int
        Of the rim.

    Returns
    -------
    (sides + 1, 3) array [m], (sides, 3) array
        Vertices in the contact frame (+z inward), the apex first, and triangles of their indices.

    """
    angles = 2.0 * np.pi * np.arange(sides) / sides
    rim = np.column_stack([friction * height * np.cos(angles), friction * height * np.sin(angles),
                           np.full(sides, height)])
    corners = np.arange(sides, dtype=np.uint32)
    faces = np.column_stack([np.zeros(sides, np.uint32), 1 + (corners + 1) % sides, 1 + corners])
    return np.vstack([np.zeros(3), rim]), faces.astype(np.uint32)


def grid_faces(rings: int, columns: int) -> Faces:
    """
    Triangulate the closed surface over a grid of polar angles (outermost) and azimuths.

    Parameters
    ----------
    rings, columns : int
        Of the grid, from pole to pole and around; each pole is closed by a fan over its ring.

    Returns
    -------
    (2 rings columns - 4, 3) array
        Indices into the flattened grid, counterclockwise from outside.

    """
    i, j = np.meshgrid(np.arange(rings - 1), np.arange(columns), indexing='ij')
    here, beside = i * columns + j, i * columns + (j + 1) % columns
    here, beside = here.ravel(), beside.ravel()
    below, below_beside = here + columns, beside + columns
    fan = np.arange(1, columns - 1)
    last = (rings - 1) * columns
    return np.vstack([
        np.column_stack([here, below, below_beside]),
        np.column_stack([here, below_beside, beside]),
        np.column_stack([np.zeros_like(fan), fan, fan + 1]),
        np.column_stack([np.full_like(fan, last), last + fan + 1, last + fan])]).astype(np.uint32)


def thinned_rows(resolution: int, rings: int) -> tuple[NDArray[np.int64], int, int]:
    """
    Choose the directions of a map of resolution r that a coarser drawing of it shows.

    Parameters
    ----------
    resolution : int
        r, of the grid of ``grasp_quality.directions.force_grid``.
    rings : int
        Most rings to keep; the first and the last ring always stay.

    Returns
    -------
    (n,) array, int, int
        Rows of the (2 r^2) directions, and how many rings and columns they make.

    """
    count = min(resolution, rings)
    kept = np.unique(np.round(np.linspace(0, resolution - 1, count)).astype(int))
    around = np.unique(np.round(np.linspace(
        0, 2 * resolution, 2 * count, endpoint=False)).astype(int))
    rows = kept[:, None] * (2 * resolution) + around[None, :]
    return rows.ravel(), len(kept), len(around)

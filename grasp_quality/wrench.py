# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Wrenches: [fx fy fz tx ty tz], SI units, torque about the origin of the stated frame.

A wrench is a plain (6,) array. Moving one between frames is the adjoint transformation; shifting
its reference point leaves the force alone and changes the torque by a cross product.
"""

from grasp_quality.arrays import Array, checked
from grasp_quality.exceptions import InvalidTaskError
import numpy as np
from numpy.typing import ArrayLike

# v @ LEVI_CIVITA is [v]x, flattened
LEVI_CIVITA = np.zeros((3, 9))
LEVI_CIVITA[[0, 1, 2], [7, 2, 3]] = 1.0
LEVI_CIVITA[[0, 1, 2], [5, 6, 1]] = -1.0


def as_wrench(value: ArrayLike, name: str = 'wrench',
              error: type[ValueError] = InvalidTaskError) -> Array:
    """Return a finite, read-only wrench (6,) [N, N m]."""
    return checked(value, (6,), name, error)


def shift(wrenches: ArrayLike, point: Array) -> Array:
    """
    Express wrenches about another reference point of the same frame.

    Parameters
    ----------
    wrenches : (..., 6) array [N, N m]
        Torques about the frame's origin.
    point : (3,) array [m]
        New reference point, in that frame.

    Returns
    -------
    (..., 6) array [N, N m], torques about ``point``: t - point x f.

    """
    shifted = np.array(wrenches, dtype=np.float64)
    shifted[..., 3:] -= shifted[..., :3] @ skew(point).T
    return shifted


def transform(wrench: Array, R_target_source: Array, p_target_source: Array) -> Array:
    """
    Express a wrench given in a source frame in a target frame (adjoint transformation).

    Parameters
    ----------
    wrench : (6,) array [N, N m]
        In the source frame, torque about its origin.
    R_target_source : (3, 3) array
        Rotation that takes source coordinates to target coordinates.
    p_target_source : (3,) array [m]
        Origin of the source frame, in the target frame.

    Returns
    -------
    (6,) array [N, N m] in the target frame, torque about its origin.

    """
    force = R_target_source @ wrench[:3]
    return np.concatenate(
        [force, R_target_source @ wrench[3:] + skew(p_target_source) @ force])


def skew(vectors: Array) -> Array:
    """Matrices [v]x (..., 3, 3) of vectors (..., 3), with [v]x b = v x b."""
    return (vectors @ LEVI_CIVITA).reshape(*np.shape(vectors), 3)


def cross(a: Array, b: Array) -> Array:
    """Cross product over the last axis (numpy's own is an order of magnitude slower on 3)."""
    a0, a1, a2 = a[..., 0], a[..., 1], a[..., 2]
    b0, b1, b2 = b[..., 0], b[..., 1], b[..., 2]
    c0 = a1 * b2 - a2 * b1
    product = np.empty((*c0.shape, 3))
    product[..., 0] = c0
    product[..., 1] = a2 * b0 - a0 * b2
    product[..., 2] = a0 * b1 - a1 * b0
    return product


def matrix_of(positions: Array, rotations: Array) -> Array:
    """Matrix (6, k, 4), eq. (4): local forces [t1, t2, n, m_n] of contacts to their wrench."""
    G = np.zeros((6, len(positions), 4))
    G[:3, :, :3] = rotations.transpose(1, 0, 2)
    G[3:, :, :3] = (skew(positions) @ rotations).transpose(1, 0, 2)
    G[3:, :, 3] = rotations[:, :, 2].T
    return G

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The objects that the simulated hand can hold, and where its fingertips touch them."""

from dataclasses import dataclass

import numpy as np

FRICTION = 0.8                # rubber fingertip on plastic [-]
TORSIONAL_FRICTION = 0.003    # the same, about the normal [m]


@dataclass(frozen=True)
class GraspObject:
    """
    An object and the three-finger grasp that the hand takes on it.

    The object frame stands in the centre of mass; when the object is handed over its axes are
    those of the hand's base, x, y, and z up.

    Attributes
    ----------
    name : str
        How the object is asked for.
    shape : str
        'box' or 'sphere'.
    size : tuple of float
        Half edges of the box, or the radius of the sphere [m].
    mass : float
        [kg]
    height : float
        Height of the centre above the hand's base when the object is handed over [m].
    contact_points : ndarray, shape (3, 3)
        Where each fingertip is to touch, in the object frame [m].
    inward_normals : ndarray, shape (3, 3)
        Unit normals into the object at these points, in the object frame.
    squeeze : ndarray, shape (3, 3)
        Balanced forces of the fingers on the object, the largest normal part 1, object frame.

    """

    name: str
    shape: str
    size: tuple
    mass: float
    height: float
    contact_points: np.ndarray
    inward_normals: np.ndarray
    squeeze: np.ndarray


def _cube():
    """
    Return a cube of 70 mm: two fingers on opposite faces, the third on a face between them.

    What the third finger presses, the other two give back by friction.

    """
    half, third = 0.035, 0.4
    points = np.array([[-half, 0.008, 0.0], [half, 0.008, 0.0], [0.0, -half, 0.0]])
    normals = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    squeeze = np.array([[1.0, -third / 2, 0.0], [-1.0, -third / 2, 0.0], [0.0, third, 0.0]])
    return GraspObject('cube', 'box', (half, half, half), 0.2, 0.2, points, normals, squeeze)


def _ball():
    """Return a ball of 70 mm: three fingers evenly around it, 15 degrees below its equator."""
    radius, below = 0.035, np.deg2rad(15.0)
    azimuth = np.deg2rad([150.0, 30.0, -90.0])
    outward = np.stack([np.cos(below) * np.cos(azimuth), np.cos(below) * np.sin(azimuth),
                        np.full(3, -np.sin(below))], axis=1)
    horizontal = outward * [1.0, 1.0, 0.0]
    return GraspObject('ball', 'sphere', (radius,), 0.15, 0.21, radius * outward, -outward,
                       -horizontal / np.cos(below)**2)


OBJECTS = {grasp_object.name: grasp_object for grasp_object in (_cube(), _ball())}

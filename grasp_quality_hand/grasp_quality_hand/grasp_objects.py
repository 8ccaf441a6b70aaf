# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The objects that the simulated hand can hold, and where its fingertips touch them."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

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
        'box', 'sphere' or 'cylinder' (along z).
    size : tuple of float
        Half edges of the box, radius of the sphere, or radius and half length [m].
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
    friction : float
        Of its contacts [-].
    torsional_friction : float
        The same, about the normal [m].

    """

    name: str
    shape: str
    size: tuple[float, ...]
    mass: float
    height: float
    contact_points: NDArray[np.float64]
    inward_normals: NDArray[np.float64]
    squeeze: NDArray[np.float64]
    friction: float = FRICTION
    torsional_friction: float = TORSIONAL_FRICTION


def _cube() -> GraspObject:
    """
    Return a cube of 70 mm: two fingers on opposite faces, the third on a face between them.

    What the third finger presses, the other two give back by friction.

    """
    half, third = 0.035, 0.4
    points = np.array([[-half, 0.008, 0.0], [half, 0.008, 0.0], [0.0, -half, 0.0]])
    normals = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    squeeze = np.array([[1.0, -third / 2, 0.0], [-1.0, -third / 2, 0.0], [0.0, third, 0.0]])
    return GraspObject('cube', 'box', (half, half, half), 0.2, 0.2, points, normals, squeeze)


def _ball() -> GraspObject:
    """Return a ball of 70 mm: three fingers evenly around it, 15 degrees below its equator."""
    radius, below = 0.035, np.deg2rad(15.0)
    azimuth = np.deg2rad([150.0, 30.0, -90.0])
    outward = np.stack([np.cos(below) * np.cos(azimuth), np.cos(below) * np.sin(azimuth),
                        np.full(3, -np.sin(below))], axis=1)
    horizontal = outward * [1.0, 1.0, 0.0]
    return GraspObject('ball', 'sphere', (radius,), 0.15, 0.21, radius * outward, -outward,
                       -horizontal / np.cos(below)**2)


def _cylinder() -> GraspObject:
    """Return a cylinder of 70 mm by 80 mm, upright: three fingers evenly around it."""
    radius, half = 0.035, 0.04
    azimuth = np.deg2rad([150.0, 30.0, -90.0])
    outward = np.stack([np.cos(azimuth), np.sin(azimuth), np.zeros(3)], axis=1)
    return GraspObject('cylinder', 'cylinder', (radius, half), 0.2, 0.21, radius * outward,
                       -outward, -outward)


def load(name: str, mass: float = 0.0, friction: float = 0.0) -> GraspObject:
    """
    Return an object by its name, with a mass [kg] or a friction [-] of its own when above 0.

    The torsional friction goes with the friction.

    """
    if name not in OBJECTS:
        raise ValueError(f'object {name!r} is not known: it must be one of {", ".join(OBJECTS)}')
    grasp_object = OBJECTS[name]
    if mass > 0.0:
        grasp_object = replace(grasp_object, mass=mass)
    if friction > 0.0:
        share = friction / grasp_object.friction
        grasp_object = replace(grasp_object, friction=friction,
                               torsional_friction=share * grasp_object.torsional_friction)
    return grasp_object


OBJECTS = {grasp_object.name: grasp_object for grasp_object in (_cube(), _ball(), _cylinder())}

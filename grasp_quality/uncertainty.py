# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What is not known exactly about a grasp, and grasps drawn from it.

All noise is normal, independent between contacts and coordinates, and given by its standard
deviation: contact points in all three coordinates, normals by a tilt about both tangents, friction
coefficients (cut off at 0; the torsional coefficient changes in proportion, because both come from
the same surfaces) and the external wrench. Draws are standard normal numbers that depend on the
seed, the count of contacts and the sample's place alone: two noises of different size see the same
draws, and more samples begin with the fewer.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from grasp_quality.arrays import floats, LARGEST
from grasp_quality.contact import FARTHEST
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.grasp_set import GraspSet
from grasp_quality.joint_limits import refuse_limits
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

LARGEST_POSITION = 1.0  # [m]; more is a mistake of units
LARGEST_TILT = 1.0      # [rad]; more is a mistake of units
AT_ONCE = 1024          # samples of one chunk: bounds the memory


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """
    Standard deviations; a number for all contacts alike, or one for each.

    Parameters
    ----------
    position : float or (k,) array_like [m]
        Of every coordinate of a contact point.
    normal : float or (k,) array_like [rad]
        Of the tilt of a contact frame about each of its tangents.
    friction : float or (k,) array_like [-]
        Of the Coulomb coefficient.
    load : float or (6,) array_like [N, N m]
        Of the components of the external wrench; a number stands for all six.
    contacts : int
        k.

    Raises
    ------
    InvalidTaskError

    """

    position: ArrayLike
    normal: ArrayLike
    friction: ArrayLike
    load: ArrayLike
    contacts: int

    def __post_init__(self) -> None:
        """Validate and spread over the contacts."""
        for field, name, length, largest in (
                ('position', 'contact_noise [m]', self.contacts, LARGEST_POSITION),
                ('normal', 'normal_noise [rad]', self.contacts, LARGEST_TILT),
                ('friction', 'friction_noise', self.contacts, LARGEST),
                ('load', 'load_noise [N, N m]', 6, LARGEST)):
            values = _deviations(getattr(self, field), name, length, largest)
            object.__setattr__(self, field, values)


def _deviations(value: ArrayLike, name: str, length: int, largest: float) -> Array:
    array = floats(value, name, f'a number or {length} numbers', InvalidTaskError)
    if array.shape not in ((), (length,)):
        raise InvalidTaskError(
            f'{name} must be a number or {length} numbers, got shape {array.shape}: {value!r}')
    if not ((array >= 0.0).all() and (array <= largest).all()):
        raise InvalidTaskError(
            f'{name} must be finite, at least 0 and at most {largest:g}: it is a standard '
            f'deviation, got {array.tolist()}')
    spread = np.empty(length)
    spread[:] = array
    spread.flags.writeable = False
    return spread


def draw(grasp: Grasp, load: Array, noise: Uncertainty, samples: int,
         seed: int) -> Iterator[tuple[GraspSet, Array]]:
    """
    Draw grasps and loads, in chunks of at most ``AT_ONCE``.

    Parameters
    ----------
    grasp : Grasp
        The means.
    load : (6,) array [N, N m]
        Mean of the external wrench, about the object frame's origin.
    noise : Uncertainty
        Standard deviations.
    samples : int
        N, of all chunks together.
    seed : int
        At least 0.

    Returns
    -------
    iterator of (GraspSet of n grasps, external wrenches (n, 6) [N, N m])

    """
    refuse_limits(grasp.joint_limits, 'uncertainty')
    k = len(grasp)
    generator = np.random.default_rng(seed)
    for begin in range(0, samples, AT_ONCE):
        count = min(AT_ONCE, samples - begin)
        normals = generator.standard_normal((count, 6 * k + 6))
        drawn = _varied(grasp, noise, normals[:, :6 * k].reshape(count, k, 6))
        yield drawn, load + normals[:, 6 * k:] * np.asarray(noise.load)


def _varied(grasp: Grasp, noise: Uncertainty, draws: Array) -> GraspSet:
    mean = grasp.contacts
    position, normal = np.asarray(noise.position), np.asarray(noise.normal)
    friction = np.maximum(mean.friction + draws[:, :, 5] * np.asarray(noise.friction), 0.0)
    relative = np.divide(friction, mean.friction, where=mean.friction > 0.0,
                         out=np.ones(friction.shape))
    return GraspSet.of_arrays(
        # no contact is drawn beyond where contacts may be
        np.clip(mean.positions + draws[:, :, :3] * position[:, None], -FARTHEST, FARTHEST),
        rotations=mean.rotations @ tilted(draws[:, :, 3:5] * normal[:, None]),
        model=mean.models, friction=friction,
        torsional_friction=relative * mean.torsional_friction,
        max_normal_force=mean.max_normal_forces, bound=grasp.bound, fingers=mean.fingers)


def tilted(angles: Array) -> Array:
    """
    Rotation matrices (..., 3, 3) of rotation vectors (a, b, 0) about t1 and t2.

    Parameters
    ----------
    angles : (..., 2) array [rad]
        a and b.

    """
    a, b = angles[..., 0], angles[..., 1]
    size = np.hypot(a, b)
    sine = np.sinc(size / np.pi)                       # sin(size) / size
    rest = 0.5 * np.sinc(size / (2.0 * np.pi)) ** 2    # (1 - cos(size)) / size^2
    R = np.empty(size.shape + (3, 3))
    R[..., 0, 0], R[..., 1, 1] = 1.0 - rest * b * b, 1.0 - rest * a * a
    R[..., 0, 1] = R[..., 1, 0] = rest * a * b
    R[..., 0, 2], R[..., 2, 0] = sine * b, -sine * b
    R[..., 1, 2], R[..., 2, 1] = -sine * a, sine * a
    R[..., 2, 2] = np.cos(size)
    return R

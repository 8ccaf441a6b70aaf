# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Tasks: which wrenches the grasp is asked to apply to the object.

All wrenches are about the origin of the object frame and are taken as given, never normalised:
alpha multiplies them. The paper's view is kept: a task is a virtual contact whose columns stand
with a minus sign in the grasp matrix (section IV); ``problem`` builds it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from grasp_quality.arrays import Array, checked, checked_number, frozen, SMALLEST
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike

MOST_SAMPLES = 1_000_000  # of a cone's surface: each is a solve
PARALLEL = 1e-9  # share of the axis below which what the laterals cannot cancel counts as nothing


def _nonzero(value: ArrayLike, name: str) -> Array:
    wrench = as_wrench(value, name)
    if np.abs(wrench).max() < SMALLEST:
        raise InvalidTaskError(f'{name} must not be zero: a zero wrench has no direction to scale')
    return wrench


@dataclass(frozen=True, eq=False)
class TaskWrench:
    """
    One wrench F (6,) [N, N m] to apply as strongly as possible: a virtual FPC (eq. 11).

    Raises
    ------
    InvalidTaskError

    """

    wrench: Array

    if TYPE_CHECKING:  # anything like an array may be given, here and below
        def __init__(self, wrench: ArrayLike) -> None: ...

    def __post_init__(self) -> None:
        """Validate and copy."""
        object.__setattr__(self, 'wrench', _nonzero(self.wrench, 'task_wrench'))


@dataclass(frozen=True, eq=False)
class TaskCone:
    """
    A cone of wrenches around an axis: a virtual PCWF (section IV).

    The wrench is alpha_z axis + x lateral_x + y lateral_y, |(x, y)| <= tan(half_angle) alpha_z.

    Parameters
    ----------
    axis, lateral_x, lateral_y : (6,) array_like [N, N m]
    half_angle : float [rad]
        In [0, pi/2).
    surface_samples : int
        Directions on the cone's surface that ``alpha_worst`` is the least of; 0 leaves it out.

    Raises
    ------
    InvalidTaskError

    """

    axis: Array
    lateral_x: Array
    lateral_y: Array
    half_angle: float
    surface_samples: int = 32

    if TYPE_CHECKING:
        def __init__(self, axis: ArrayLike, lateral_x: ArrayLike, lateral_y: ArrayLike,
                     half_angle: float, surface_samples: int = 32) -> None: ...

    def __post_init__(self) -> None:
        """Validate and copy."""
        object.__setattr__(self, 'axis', _nonzero(self.axis, 'axis'))
        for name in ('lateral_x', 'lateral_y'):
            object.__setattr__(self, name, as_wrench(getattr(self, name), name))
        object.__setattr__(self, 'half_angle', checked_number(
            self.half_angle, 'half_angle [rad]', InvalidTaskError, minimum=0.0, below=np.pi / 2))
        samples = self.surface_samples
        if not isinstance(samples, (int, np.integer)) or not 0 <= samples <= MOST_SAMPLES:
            raise InvalidTaskError(
                f'surface_samples must be a whole number >= 0 and at most {MOST_SAMPLES}, '
                f'got {samples!r}')
        if self._holds_zero():
            raise InvalidTaskError(
                'the task cone holds the zero wrench, so that alpha_z has no end: axis '
                f'{self.axis.tolist()} is lateral_x {self.lateral_x.tolist()} and lateral_y '
                f'{self.lateral_y.tolist()} times no more than tan(half_angle) '
                f'{np.tan(self.half_angle):g}; choose laterals that are independent of the axis')

    def _holds_zero(self) -> bool:
        """Whether axis + x lateral_x + y lateral_y can vanish with |(x, y)| <= tan(half_angle)."""
        laterals = np.stack([self.lateral_x, self.lateral_y], axis=1)  # (6, 2)
        least = -np.linalg.lstsq(laterals, self.axis, rcond=None)[0]
        rest = self.axis + laterals @ least
        return bool(np.abs(rest).max() <= PARALLEL * np.abs(self.axis).max()
                    and np.hypot(*least) <= np.tan(self.half_angle) * (1.0 + PARALLEL))

    @property
    def surface(self) -> Array:
        """Wrenches (surface_samples, 6) on the cone's surface, at axis component one."""
        angles = np.linspace(0.0, 2.0 * np.pi, self.surface_samples, endpoint=False)[:, None]
        radius = np.tan(self.half_angle)
        wrenches: Array = self.axis + radius * (
            np.cos(angles) * self.lateral_x + np.sin(angles) * self.lateral_y)
        return wrenches


@dataclass(frozen=True, eq=False)
class TaskPolytope:
    """
    Several wrenches (n, 6), each solved by itself and summed with weights (eq. 18).

    ``weights`` (n,) are >= 0 and not all zero, taken as given; 1/n each when left out.
    ``parallelotope`` tells whether to find the parallelotope's scale too, 2^n more solves.

    Raises
    ------
    InvalidTaskError

    """

    wrenches: Array
    weights: Array = None  # type: ignore[assignment]  # never None once made
    parallelotope: bool = True

    if TYPE_CHECKING:
        def __init__(self, wrenches: ArrayLike, weights: ArrayLike | None = None,
                     parallelotope: bool = True) -> None: ...

    def __post_init__(self) -> None:
        """Validate and copy."""
        wrenches = checked(self.wrenches, (None, 6), 'task_wrenches', InvalidTaskError)
        check_rows(wrenches, 'task_wrenches')
        if self.weights is None:
            weights = frozen(np.full(len(wrenches), 1.0 / len(wrenches)))
        else:
            weights = checked(self.weights, (len(wrenches),), 'weights', InvalidTaskError)
        if (weights < 0.0).any() or not weights.any():
            raise InvalidTaskError(
                f'weights must be >= 0 with at least one > 0, got {weights.tolist()}')
        object.__setattr__(self, 'wrenches', wrenches)
        object.__setattr__(self, 'weights', weights)


@dataclass(frozen=True, eq=False)
class TaskEllipsoid:
    """
    An ellipsoid of wrenches, given by its principal semi-axes (n, 6) (end of section V).

    Evaluated through the 2 n wrenches at the ends of the axes, so that only the ellipsoid scaled
    by min alpha / sqrt(n) is guaranteed.

    Raises
    ------
    InvalidTaskError

    """

    axes: Array

    if TYPE_CHECKING:
        def __init__(self, axes: ArrayLike) -> None: ...

    def __post_init__(self) -> None:
        """Validate and copy."""
        axes = checked(self.axes, (None, 6), 'axes', InvalidTaskError)
        check_rows(axes, 'axes')
        object.__setattr__(self, 'axes', axes)

    @property
    def ends(self) -> Array:
        """Wrenches (2 n, 6) at the ends of the axes, the opposite ones behind."""
        return np.concatenate([self.axes, -self.axes])


Task = TaskWrench | TaskCone | TaskPolytope | TaskEllipsoid


def check_rows(wrenches: Array, name: str) -> None:
    """Refuse an empty list of wrenches (n, 6), and one with a zero row."""
    if not len(wrenches):
        raise InvalidTaskError(f'{name} must hold at least one wrench, got none')
    zero = [i for i, row in enumerate(wrenches) if np.abs(row).max() < SMALLEST]
    if zero:
        raise InvalidTaskError(f'{name} must not be zero, but rows {zero} are: leave them out')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The worst case: the largest ball, or task ellipsoid, inside the wrench space W (eq. 9).

With true friction cones and all bounds, as an interval that is proved at both ends: the upper end
is the support function of W at one direction, the lower end comes from points of W that cover all
directions (``ball_search``; docs/derivations.md, "The largest ball"). A ball is an ellipsoid whose
semi-axes are unit forces and unit torques of ``torque_length``; of fewer axes than six only the
part of W in their span counts.
"""

from dataclasses import dataclass
from functools import cached_property

from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import checked_number, frozen
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.inscribed import Inscribed
from grasp_quality.joint_limits import refuse_limits
from grasp_quality.solution import Solution
from grasp_quality.status import OneLine
from grasp_quality.task import TaskEllipsoid
from grasp_quality.time_limit import TimeLimit
from grasp_quality.wrench import skew
import numpy as np
from numpy.typing import NDArray

SUBSPACES = {'all': slice(0, 6), 'force': slice(0, 3), 'torque': slice(3, 6)}
WIDTH = 0.01   # relative, of the interval, unless another is asked for
LIMITS = 0.01  # share of the radius from which a contact counts as limiting

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BallRadius(OneLine):
    """
    Certified interval of the largest factor s with s E inside W.

    For a ball E is the unit ball, and s its radius [N].

    Attributes
    ----------
    lower, upper : float
        Proved bounds. Both are 0 where forces of no size span the axes; ``lower`` is 0 without
        force closure.
    direction : (6,) array [1/N, 1/(N m)]
        lambda of the proof of ``upper``: every w in W has lambda . w <= upper, and the largest
        lambda . w on E is 1. About the object frame's origin.
    weakest_wrench : (6,) array [N, N m]
        The point of E where that is, about the object frame's origin: the grasp applies no more
        than ``upper`` times this wrench.
    weakest : Solution or None
        Forces, multipliers and proof of that task wrench: what limits it limits the ball. None
        where no forces of any size would do, or the time ended first.
    reached : bool
        Whether the interval is as narrow as asked.
    cells : int
        How many parts of the sphere of directions were looked at.

    """

    grasp: Grasp
    lower: float
    upper: float
    direction: Array
    weakest_wrench: Array
    weakest: Solution | None
    reached: bool
    cells: int

    @property
    def width(self) -> float:
        """Width of the interval as a share of ``upper``; 0 where both ends are 0."""
        return (self.upper - self.lower) / self.upper if self.upper > 0.0 else 0.0

    @cached_property
    def shares(self) -> Array:
        """Part of each contact in the radius (k,), sum 1: its growth with the contact's cap."""
        if self.weakest is None or self.weakest.alpha <= 0.0:
            return frozen(np.zeros(len(self.grasp)))
        worth = self.weakest.dalpha_dmax_force * self.grasp.max_normal_forces
        return frozen(worth / self.weakest.alpha)

    @property
    def limiting_contacts(self) -> tuple[str, ...]:
        """Names of the contacts that limit the radius, the most important first."""
        return tuple(self.grasp.name_of(i) for i in np.argsort(-self.shares, kind='stable')
                     if self.shares[i] > LIMITS)


def ball_radius(grasp: Grasp, torque_length: float = 1.0, subspace: str = 'all',
                relative_width: float = WIDTH,
                time_limit_s: float | TimeLimit | None = None) -> BallRadius:
    """
    Radius of the largest ball around the origin inside the wrench space W (eq. 9).

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    torque_length : float [m]
        Torques count divided by this length: |w|^2 = |f|^2 + |t|^2 / torque_length^2.
    subspace : str
        'all'; 'force': pure forces, without torque about the object frame's origin; 'torque':
        pure torques, whose radius is in newtons too (times ``torque_length`` in N m).
    relative_width : float
        In (0, 1): how narrow (upper - lower) / upper shall be.
    time_limit_s : float, optional
        After which the interval reached so far is returned [s].

    Returns
    -------
    BallRadius

    Raises
    ------
    InvalidTaskError

    """
    require_grasp(grasp)
    length = checked_number(torque_length, 'torque_length [m]', InvalidTaskError, above=0.0)
    if subspace not in tuple(SUBSPACES):
        raise InvalidTaskError(f'subspace must be one of {list(SUBSPACES)}, got {subspace!r}')
    axes = np.diag([1.0, 1.0, 1.0, length, length, length])[SUBSPACES[subspace]]
    return ellipsoid_scale(grasp, TaskEllipsoid(axes), relative_width, time_limit_s)


def ellipsoid_scale(grasp: Grasp, ellipsoid: TaskEllipsoid, relative_width: float = WIDTH,
                    time_limit_s: float | TimeLimit | None = None) -> BallRadius:
    """
    Largest s such that the whole task ellipsoid, scaled by s, lies in W (Li and Sastry).

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    ellipsoid : TaskEllipsoid
        Its axes need not be orthogonal: it is the image of the unit ball.
    relative_width, time_limit_s : float
        As for ``ball_radius``.

    Returns
    -------
    BallRadius

    Raises
    ------
    InvalidTaskError

    """
    require_grasp(grasp)
    width = checked_number(
        relative_width, 'relative_width', InvalidTaskError, above=0.0, below=1.0)
    if not isinstance(ellipsoid, TaskEllipsoid):
        raise InvalidTaskError(
            f'ellipsoid must be a TaskEllipsoid, got {type(ellipsoid).__name__}')
    refuse_limits(grasp.joint_limits, 'the largest ball')
    found = Inscribed(grasp, ellipsoid.axes, width, TimeLimit.of(time_limit_s))
    return BallRadius(
        grasp, float(found.lower), float(found.upper), frozen(_physical(grasp, found.multiplier)),
        frozen(found.touching), found.weakest, found.reached, found.cells)


def _physical(grasp: Grasp, multiplier: Array) -> Array:
    """Turn a scaled lambda (6,) into one of wrenches about the object frame's origin."""
    worth = multiplier / grasp.force_scale
    worth[3:] /= grasp.lever_arm
    worth[:3] -= skew(worth[3:]) @ grasp.center
    return worth

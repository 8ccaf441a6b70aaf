# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Volume of the pure forces, or pure torques, that a grasp can apply: the body of the map (Fig. 3b).

The sphere of directions is tiled by triangles. Each direction of the map gives a point of the body
on its surface, alpha u, and from the multiplier a plane that no point of the body passes. The
tetrahedra from the origin to three such points lie inside, since the body is convex; the part of a
triangle's cone below one of its planes holds what the body has there. The triangles with the most
doubt between the two are divided until the interval is as narrow as asked.
"""

from dataclasses import dataclass
import itertools

from grasp_quality import bounds, friction_cone
from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import checked_number
from grasp_quality.exceptions import InvalidTaskError, SolverTimeoutError
from grasp_quality.grasp import Grasp
from grasp_quality.joint_limits import refuse_limits
from grasp_quality.problem import build_problem
from grasp_quality.solve import solve
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SUBSPACES = {'force': slice(0, 3), 'torque': slice(3, 6)}
WIDTH = 0.02          # relative, of the interval, unless another is asked for
MOST_DIRECTIONS = 20_000
SUBDIVISION = 4       # edges of a triangle are cut in so many parts for its outer volume
ROUND = 0.3           # share of the doubt that one round of divisions goes for
ROUNDING = 1e-7       # relative; the points are on the surface to the residual of their proofs
NOTHING = 1e-12       # of a plane's slope, below which it does not bound a direction


@dataclass(frozen=True)
class WrenchVolume:
    """
    Certified interval of a volume.

    Attributes
    ----------
    lower, upper : float [N^3], or [(N m)^3] for torques
    reached : bool
        Whether the interval is as narrow as asked.
    directions : int
        How many directions of the map were solved.

    """

    lower: float
    upper: float
    reached: bool
    directions: int


def volume(grasp: Grasp, subspace: str = 'force', relative_width: float = WIDTH,
           time_limit_s: float | TimeLimit | None = None) -> WrenchVolume:
    """
    Volume of the set of pure forces (or torques) that the grasp can apply.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    subspace : str
        'force': forces without torque about the object frame's origin, as the directions of the
        map; 'torque': torques without force.
    relative_width : float
        In (0, 1): how narrow (upper - lower) / upper shall be.
    time_limit_s : float, optional
        After which the interval reached so far is returned [s].

    Returns
    -------
    WrenchVolume
        Both ends 0 where the forces of the grasp do not span the subspace.

    Raises
    ------
    InvalidTaskError, SolverError

    """
    require_grasp(grasp)
    width = checked_number(
        relative_width, 'relative_width', InvalidTaskError, above=0.0, below=1.0)
    if subspace not in tuple(SUBSPACES):
        raise InvalidTaskError(f'subspace must be one of {list(SUBSPACES)}, got {subspace!r}')
    refuse_limits(grasp.joint_limits, 'the volume')
    rows = SUBSPACES[subspace]
    if not all(grasp.spans(axis) for axis in np.eye(6)[rows]):
        return WrenchVolume(0.0, 0.0, True, 0)
    return _Body(grasp, rows).measured(width, TimeLimit.of(time_limit_s))


class _Body:
    """Points on the surface of the body, the planes through them, and triangles between them."""

    def __init__(self, grasp: Grasp, rows: slice) -> None:
        self._grasp, self._rows = grasp, rows
        self._known: dict[tuple[float, ...], tuple[Array, Array, float]] = {}
        self._box = [(axis, _support(grasp, axis, rows)) for axis in np.vstack(
            [np.eye(3), -np.eye(3)])]

    def measured(self, width: float, limit: TimeLimit | None) -> WrenchVolume:
        """Divide the triangles with the most doubt until the width or a limit is reached."""
        octants = [np.diag(signs) for signs in itertools.product((-1.0, 1.0), repeat=3)]
        parts = [(*self._without_points(t), t) for t in octants]
        reached = False
        try:
            parts = [(*self._volumes(t, limit), t) for t in octants]
            while True:
                inner, outer = (sum(p[i] for p in parts) for i in (0, 1))
                reached = bool(outer - inner <= (width - 2.0 * ROUNDING) * outer)
                if reached or len(self._known) > MOST_DIRECTIONS:
                    break
                parts.sort(key=lambda p: p[0] - p[1])
                doubts = np.cumsum([p[1] - p[0] for p in parts])
                count = 1 + int(np.searchsorted(doubts, ROUND * (outer - inner)))
                divided = [(*self._volumes(t, limit), t) for p in parts[:count]
                           for t in _quarters(p[2])]
                parts = divided + parts[count:]
        except SolverTimeoutError:  # what was found so far holds
            pass
        inner, outer = (float(sum(p[i] for p in parts)) for i in (0, 1))
        return WrenchVolume(
            inner * (1.0 - ROUNDING), outer * (1.0 + ROUNDING), reached, len(self._known))

    def _at(self, direction: Array, limit: TimeLimit | None) -> tuple[Array, Array, float]:
        """Point on the surface along a direction, and a plane n . f <= s of the body."""
        key = tuple(np.round(direction, 12))
        if key not in self._known:
            wrench = np.zeros(6)
            wrench[self._rows] = direction
            solution = solve(build_problem(self._grasp, TaskWrench(wrench)), limit)
            normal = solution.dalpha_dexternal_wrench[self._rows]
            self._known[key] = solution.alpha * direction, normal, solution.alpha_upper
        return self._known[key]

    def _volumes(self, triangle: Array, limit: TimeLimit | None) -> tuple[float, float]:
        """Inner and outer volume of the body in a triangle's cone; rows are directions."""
        found = [self._at(direction, limit) for direction in triangle]
        inner = abs(np.linalg.det(np.stack([point for point, _, _ in found]))) / 6.0
        planes = [(normal, s) for _, normal, s in found] + self._box
        return inner, max(inner, _below(triangle, planes))

    def _without_points(self, triangle: Array) -> tuple[float, float]:
        """Return what is known of a triangle before anything is solved."""
        return 0.0, _below(triangle, self._box)


def _support(grasp: Grasp, axis: Array, rows: slice) -> float:
    """Largest component of any wrench of W along an axis of the subspace."""
    multiplier = np.zeros(6)
    multiplier[rows] = axis
    h = np.einsum('i,ijk->jk', multiplier, grasp.matrix)
    worth = grasp.max_normal_forces * friction_cone.support(h, grasp.scales)
    return float(bounds.support(worth, grasp.bound, grasp.groups))


def _quarters(triangle: Array) -> list[Array]:
    """Four triangles that tile one, with unit rows."""
    a, b, c = triangle
    ab, bc, ca = (m / np.linalg.norm(m) for m in (a + b, b + c, c + a))
    return [np.stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]


def _tiles() -> tuple[Array, NDArray[np.int64]]:
    """Barycentric coordinates (v, 3) of a divided triangle, and corners (t, 3) of its tiles."""
    n = SUBDIVISION
    corners = [(i, j) for i in range(n + 1) for j in range(n + 1 - i)]
    index = {c: v for v, c in enumerate(corners)}
    tiles = [(index[i, j], index[i + 1, j], index[i, j + 1])
             for i in range(n) for j in range(n - i)]
    tiles += [(index[i + 1, j], index[i, j + 1], index[i + 1, j + 1])
              for i in range(n) for j in range(n - i - 1)]
    return np.array([(i, j, n - i - j) for i, j in corners]) / n, np.array(tiles)


COORDINATES, TILES = _tiles()


def _below(triangle: Array, planes: list[tuple[Array, float]]) -> float:
    """Volume of the triangle's cone, each tile of it cut off by the best single plane."""
    directions = COORDINATES @ triangle                          # (v, 3)
    slopes = np.stack([normal for normal, _ in planes]) @ directions.T  # (p, v)
    offsets = np.array([s for _, s in planes])[:, None]
    least = NOTHING * np.abs(slopes).max(axis=1, keepdims=True)
    with np.errstate(divide='ignore', invalid='ignore'):
        reach = np.where(slopes > least, offsets / slopes, np.inf)  # along each direction
    corners = reach[:, TILES]                                    # (p, t, 3)
    bounded = np.isfinite(corners).all(axis=2)
    products = np.where(bounded, np.where(np.isfinite(corners), corners, 0.0).prod(axis=2), np.inf)
    sizes = np.abs(np.linalg.det(directions[TILES])) / 6.0       # (t,)
    return float((sizes * products.min(axis=0)).sum())

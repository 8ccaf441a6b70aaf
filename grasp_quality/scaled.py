# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Scaled problems of many grasps at once: what ``Grasp`` works out for one, compiled for thousands.

Grasps of one pattern (contact count and groups of the bound) share arrays. Calls no compiled code
of another file (see ``kernel``).
"""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import TYPE_CHECKING

from grasp_quality.arrays import Array, Ints, NO_LENGTH
from grasp_quality.grasp import COINCIDENT, Grasp
import numba
import numpy as np

if TYPE_CHECKING:
    from grasp_quality.grasp_set import GraspSet

COMPILE = {'cache': True, 'error_model': 'numpy', 'nogil': True}


@dataclass(frozen=True, eq=False)
class Scaled:
    """
    Grasps of one pattern in scaled units.

    Attributes
    ----------
    groups : (k,) int64 array
    group_count : int
    blocks : (M, k, 4, 6) array
        Scaled grasp matrices, one contact a block, rows n, t1, t2, m_n.
    units : (M, k, 4) array [N, N, N, N m]
        Local forces [t1, t2, n, m_n] that a share of one stands for.
    centers : (M, 3) array [m]
    lever_arms, force_scales, reaches, least_caps : (M,) arrays
        As the properties of ``Grasp``; reaches is cap_total, a0.

    """

    groups: Ints
    group_count: int
    blocks: Array
    units: Array
    centers: Array
    lever_arms: Array
    force_scales: Array
    reaches: Array
    least_caps: Array

    @classmethod
    def of(cls, grasp: Grasp) -> Scaled:
        """Take over what one Grasp has worked out."""
        block, _, groups = grasp.blocks
        return cls(groups, max(grasp.groups) + 1, block[None], np.array(grasp.force_units)[None],
                   np.array(grasp.center)[None], np.array([grasp.lever_arm]),
                   np.array([grasp.force_scale]), np.array([grasp.cap_total]),
                   np.array([grasp.least_cap]))

    @classmethod
    def of_rows(cls, grasps: GraspSet, members: Ints) -> Scaled:
        """Scale the grasps at these indices of a GraspSet, all of one pattern."""
        first = grasps.starts[members[0]]
        k = int(grasps.starts[members[0] + 1] - first)
        groups = np.array(grasps.groups[first:first + k])
        M, count = len(members), int(groups.max()) + 1
        scaled = cls(groups, count, np.empty((M, k, 4, 6)), np.empty((M, k, 4)), np.empty((M, 3)),
                     *np.empty((4, M)))
        scale_grasps(
            grasps.starts, members, groups, count, grasps.positions, grasps.rotations,
            grasps.friction, grasps.torsional_friction, grasps.max_normal_forces, scaled.blocks,
            scaled.units, scaled.centers, scaled.lever_arms, scaled.force_scales, scaled.reaches,
            scaled.least_caps, COINCIDENT, NO_LENGTH)
        return scaled

    def wrenches(self, wrenches: Array, which: Ints) -> Array:
        """Scale tasks or loads, one a row, each for the grasp that ``which`` names."""
        scaled = np.empty((len(which), 6))
        scale_wrenches(wrenches, which, self.centers, self.lever_arms, self.force_scales, scaled)
        return scaled


@numba.njit(**COMPILE)
def scale_grasps(starts: Ints, members: Ints, groups: Ints, group_count: int, positions: Array,
                 rotations: Array, friction: Array, torsional: Array, caps: Array, blocks: Array,
                 units: Array, centers: Array, lever_arms: Array, force_scales: Array,
                 reaches: Array, least_caps: Array, coincident: float, no_length: float) -> None:
    """Fill the arrays of ``Scaled``; numba sees no change of a constant in another file."""
    k = len(groups)
    best = np.empty(group_count)
    for m in range(len(members)):
        first = starts[members[m]]
        largest, least, twist = 0.0, math.inf, 0.0
        center = centers[m]
        center[:] = 0.0
        best[:] = 0.0
        for i in range(k):
            cap = caps[first + i]
            largest, least = max(largest, cap), min(least, cap)
            twist = max(twist, torsional[first + i])
            best[groups[i]] = max(best[groups[i]], cap)
            for j in range(3):
                center[j] += positions[first + i, j]
        away = 0.0
        for j in range(3):
            center[j] /= k
            away = max(away, abs(center[j]))
        arm = 0.0
        for i in range(k):
            x = positions[first + i, 0] - center[0]
            y = positions[first + i, 1] - center[1]
            z = positions[first + i, 2] - center[2]
            arm = max(arm, math.sqrt(x * x + y * y + z * z))
        if not arm > max(coincident * away, no_length):
            arm = twist if twist > no_length else (away if away > no_length else 1.0)
        lever_arms[m], force_scales[m] = arm, largest
        reaches[m], least_caps[m] = best.sum() / largest, least / largest
        for i in range(k):
            row = first + i
            x, y, z = (positions[row, 0] - center[0], positions[row, 1] - center[1],
                       positions[row, 2] - center[2])
            for c in range(4):
                # [n, t1, t2, m_n] from the columns t1, t2, n of the contact frame
                column = 2 if c in (0, 3) else c - 1
                place = 2 if c == 0 else (3 if c == 3 else c - 1)
                scale = 1.0 if c == 0 else (torsional[row] if c == 3 else friction[row])
                units[m, i, place] = scale * caps[row]
                share = scale * caps[row] / largest
                a, b, d = (rotations[row, 0, column] * share, rotations[row, 1, column] * share,
                           rotations[row, 2, column] * share)
                block = blocks[m, i, c]
                if c == 3:
                    block[0], block[1], block[2] = 0.0, 0.0, 0.0
                    block[3], block[4], block[5] = a / arm, b / arm, d / arm
                else:
                    block[0], block[1], block[2] = a, b, d
                    block[3] = (y * d - z * b) / arm
                    block[4] = (z * a - x * d) / arm
                    block[5] = (x * b - y * a) / arm


@numba.njit(**COMPILE)
def scale_wrenches(wrenches: Array, which: Ints, centers: Array, lever_arms: Array,
                   force_scales: Array, scaled: Array) -> None:
    """Express wrenches about the grasps' centres, in shares of force scale and lever arm."""
    for n in range(len(which)):
        m = which[n]
        x, y, z = centers[m, 0], centers[m, 1], centers[m, 2]
        fx, fy, fz = wrenches[n, 0], wrenches[n, 1], wrenches[n, 2]
        force, moment = force_scales[m], force_scales[m] * lever_arms[m]
        scaled[n, 0], scaled[n, 1], scaled[n, 2] = fx / force, fy / force, fz / force
        scaled[n, 3] = (wrenches[n, 3] - (y * fz - z * fy)) / moment
        scaled[n, 4] = (wrenches[n, 4] - (z * fx - x * fz)) / moment
        scaled[n, 5] = (wrenches[n, 5] - (x * fy - y * fx)) / moment

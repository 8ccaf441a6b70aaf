# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The method to beat: friction cones as pyramids, and the convex hull of their edges' wrenches."""

from __future__ import annotations

from grasp_quality import Grasp
import numpy as np
from scipy.spatial import ConvexHull, QhullError


def edge_wrenches(grasp: Grasp, edges: int, turn: float) -> np.ndarray:
    """
    Wrenches of the edges of inscribed pyramids at the caps.

    Soft fingers get edges in the planes of tangential force and of the moment besides.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction and caps.
    edges : int
        Of each friction cone.
    turn : float [rad]
        Of the tangents about the normal: a choice that nothing in the grasp makes.

    Returns
    -------
    (n, 6) array [N, N m]

    """
    angles = turn + 2.0 * np.pi * np.arange(edges) / edges
    rim = np.stack([np.cos(angles), np.sin(angles), np.ones(edges), np.zeros(edges)], axis=1)
    twist = np.array([[0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, -1.0]])
    wrenches = []
    for i in range(len(grasp)):
        shares = np.vstack([rim, twist]) if grasp.scales[i, 3] > 0.0 else rim
        wrenches.append((shares * grasp.force_units[i]) @ grasp.matrix[:, i].T)
    return np.vstack(wrenches)


def hull_radius(grasp: Grasp, edges: int, turn: float = 0.0, options: str = '') -> float | None:
    """
    Radius of the largest ball in the hull of the edges and the origin (the l1 bound).

    None where qhull makes no hull; never below 0.

    """
    points = np.vstack([edge_wrenches(grasp, edges, turn), np.zeros(6)])
    try:
        hull = ConvexHull(points, qhull_options=options or None)
    except QhullError:
        return None
    return max(0.0, float(-hull.equations[:, -1].max()))

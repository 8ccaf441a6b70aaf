# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The grasps of the paper's figures, caps 1 N, lengths in units of R = 1 m."""

from __future__ import annotations

from grasp_quality import Contact, Grasp
import numpy as np


def eight_contacts(friction: float, bound: str = 'linf') -> Grasp:
    """Fig. 3: four contacts on each of the faces x = -1 and x = +1 of a box."""
    return Grasp([
        Contact((x, y, z), (-x, 0.0, 0.0), friction=friction, name=f'{side} {i}', finger=side)
        for x, side in ((-1.0, 'left'), (1.0, 'right'))
        for i, (y, z) in enumerate(((-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)))], bound)


def three_fingers(friction: float = 0.5) -> Grasp:
    """Fig. 5: three contacts on the equator of a ball, at 180, 60 and -60 degrees."""
    angles = np.deg2rad([180.0, 60.0, -60.0])
    points = np.stack([np.cos(angles), np.sin(angles), np.zeros(3)], axis=1)
    return Grasp([Contact(p, -p, friction=friction, name=name, finger=name)
                  for p, name in zip(points, ('thumb', 'index', 'middle'))])


def pinch(friction: float) -> Grasp:
    """Two contacts that face each other on the x axis: flat across it where friction is low."""
    return Grasp([Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), friction=friction, name=name, finger=name)
                  for x, name in ((-1.0, 'left'), (1.0, 'right'))])

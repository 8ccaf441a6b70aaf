# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the node knows of one instant: contacts, and what they feel."""

from __future__ import annotations

from dataclasses import dataclass

from grasp_quality.arrays import Array
from grasp_quality.grasp import Grasp
from grasp_quality.measures import slip_margin
from msg_adapters.message_types import Stamp
import numpy as np


@dataclass(frozen=True, eq=False)
class Scene:
    """
    Contacts of one instant.

    Attributes
    ----------
    grasp : Grasp
        Of the contacts that count as loaded.
    forces : tuple of (4,) array or None
        Measured local force of each, where there is a fresh one.
    frame : str
        Object frame.
    stamp : builtin_interfaces.msg.Time
        When they were sensed.

    """

    grasp: Grasp
    forces: tuple[Array | None, ...]
    frame: str
    stamp: Stamp


def measured_margin(scene: Scene) -> float | None:
    """
    Smallest slip margin of the measured contacts, in [-1, 1]; None when none was measured.

    A force outside its cone has a negative margin, without limit as the normal force goes to zero:
    -1 stands for all that is further outside.

    """
    if all(force is None for force in scene.forces):
        return None
    measured = np.array([np.zeros(4) if f is None else f for f in scene.forces])
    known = [f is not None for f in scene.forces]
    return float(np.clip(slip_margin(scene.grasp, measured)[known], -1.0, 1.0).min())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The bound law: no load exceeds alpha of the contacts as they are, for normals as they are.

What fingers apply at any moment, slipping or not, is at most alpha (of that very wrench, with the
contacts where they are now) times the largest of their normal forces over its cap.
"""

from collections.abc import Sequence
from typing import Any

from benchmarks.truth.felt import felt_contact
from grasp_quality import evaluate, Grasp, TaskWrench
import numpy as np


def bound_ratio(grasp: Grasp, measured: Sequence[Any]) -> float:
    """
    Return the wrench that is measured over the largest one that the law allows.

    Parameters
    ----------
    grasp : Grasp
        Contact i, with its friction and its cap, is that of finger i.
    measured : sequence of MeasuredContact
        All contacts with their forces, one a finger.

    """
    loaded = [contact for contact in measured if contact.force[2] > 0.0]
    if not loaded:
        return 0.0
    now = Grasp([felt_contact(grasp, contact) for contact in loaded], grasp.bound)
    forces = np.array([rotation.T @ contact.R_object_contact @ contact.force[:3]
                       for rotation, contact in zip(now.rotations, loaded)])    # (k, 3)
    forces = np.column_stack([forces, [contact.force[3] for contact in loaded]])
    share = float((forces[:, 2] / now.max_normal_forces).max())
    return 1.0 / (evaluate(now, TaskWrench(now.wrench(forces))).alpha * share)

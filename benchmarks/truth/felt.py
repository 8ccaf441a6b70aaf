# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The grasp as it is felt: contacts where the simulation has them, in frames of little change."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from grasp_quality import Contact, Grasp
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def felt_grasp(grasp: Grasp, measured: Iterable[Any]) -> Grasp:
    """
    Return a grasp with the contacts that were measured moved to where they are.

    Parameters
    ----------
    grasp : Grasp
        Contact i is that of finger i.
    measured : iterable of MeasuredContact
        At most one a finger; a contact without one stays where it was.

    """
    contacts = list(grasp.contacts)
    for contact in measured:
        contacts[contact.finger] = felt_contact(grasp, contact)
    return Grasp(contacts, grasp.bound)


def felt_contact(grasp: Grasp, measured: Any) -> Contact:
    """Return the contact of a grasp that belongs to a measured one, moved to where it is."""
    return replace(grasp.contacts[measured.finger], normal=None, position=measured.position,
                   rotation=turned(grasp.rotations[measured.finger], measured.normal))


def turned(rotation: Array, normal: Array) -> Array:
    """Return a rotation (3, 3), turned the short way until its third column is the normal."""
    before = rotation[:, 2]
    x, y, z = np.cross(before, normal)
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn = np.eye(3) + K + K @ K / (1.0 + before @ normal)
    return np.asarray(turn @ rotation, dtype=np.float64)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measurement noise on contacts."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from grasp_quality_hand.contact_reading import rotation_with_z
import numpy as np


@dataclass(frozen=True)
class ContactNoise:
    """
    Standard deviations of what is measured at a contact, each axis by itself.

    Attributes
    ----------
    position : float
        [m]
    normal : float
        Of the normal's tilt [rad].
    force : float
        Of each force component; a contact without load stays without [N].

    """

    position: float = 0.0
    normal: float = 0.0
    force: float = 0.0

    def measure(self, contacts: Sequence[Any], rng: np.random.Generator) -> list[Any]:
        """Return MeasuredContacts with noise."""
        if not (self.position or self.normal or self.force):
            return list(contacts)
        return [self._one(contact, rng) for contact in contacts]

    def _one(self, contact: Any, rng: np.random.Generator) -> Any:
        """Return one MeasuredContact with noise; its force keeps its share along each axis."""
        normal = contact.normal + self.normal * rng.normal(size=3)
        force = contact.force.copy()
        if force[2] > 0.0:
            force[:3] += self.force * rng.normal(size=3)
        if self.normal:
            R = rotation_with_z(normal / np.linalg.norm(normal))
            in_object = contact.R_object_contact @ force[:3]
            force[:3] = R.T @ in_object
        else:
            R = contact.R_object_contact
        return replace(contact, position=contact.position + self.position * rng.normal(size=3),
                       R_object_contact=R, force=force)

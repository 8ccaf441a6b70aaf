# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The rules of ``force_rules`` for parts that belong together, or for what came of them."""

from collections.abc import Sequence

from grasp_quality_hand.audit_parts import (
    Contacts, Forces, joints_of, limits_alone, limits_of, LocalWrench, Quality, Settings)
from grasp_quality_hand.force_rules import (
    Array, broken_alone, broken_balance, broken_forces, broken_joints, SMALL)
import numpy as np

OWN_CAPS = 1e3  # largest cap of a contact's own over the node's, or over any force beside it


def wrong(part: Forces, contacts: Contacts, quality: Quality | None, settings: Settings,
          allowance_s: float) -> list[str]:
    """Tell what is wrong with forces that belong to these parts; None: any quality will do."""
    said = []
    if quality is not None and not quality.optimal:
        said.append('the quality beside them is not OPTIMAL')
    if part.age_s is not None and part.age_s > settings.max_contact_age + allowance_s:
        said.append(f'sent {part.age_s:.4f} s after their contacts, max_contact_age is '
                    f'{settings.max_contact_age:g} s')
    limits = limits_of(contacts, settings)
    said += broken_forces(part.forces, limits, settings.force_bound)
    if said:
        return said
    said = broken_joints(part.forces, joints_of(contacts, list(limits)))
    if quality is None:
        return said
    alpha = 0.0 if part.are_holding else quality.alpha
    return said + broken_balance(part.forces, limits, alpha * quality.task - quality.load)


def wrong_alone(part: Forces, settings: Sequence[Settings]) -> list[str]:
    """Tell what is wrong with forces whatever the contacts and the quality were."""
    if not settings or any(own.contact_source != 'pose_array' for own in settings):
        sizes = [np.abs(force.wrench[:3]).max() for force in part.forces]
        return broken_alone(part.forces, OWN_CAPS * max(
            [*sizes, *(own.max_normal_force for own in settings)]))
    return min((broken_alone(part.forces, own.max_normal_force) or broken_forces(
        part.forces, limits_alone(part.forces, own), own.force_bound)
        for own in settings), key=len)


def is_among(part: LocalWrench, wrenches: Array, contacts: Contacts, settings: Settings) -> bool:
    """Tell whether a wrench is one of these (k, 6) in the object frame [N, N m], turned."""
    if not contacts.may_be_of(settings) or not len(wrenches):
        return False
    limits = limits_of(contacts, settings).get(part.name)
    if limits is None:
        return False
    local = (wrenches.reshape(-1, 2, 3) @ limits.R).reshape(-1, 6)
    return bool((np.abs(local - part.wrench).max(axis=1) <= SMALL * limits.cap).any())


def that_count(settings: Sequence[Settings], contacts: Sequence[Contacts]) -> list[Contacts]:
    """Return the contacts that a node of one of these parameters listens to."""
    return [c for c in contacts if not settings or any(c.may_be_of(own) for own in settings)]

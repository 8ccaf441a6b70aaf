# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the contacts are and feel, and what about it is doubtful.

The live loop only keeps what it has read; sentences are made of it when somebody reports, once a
second. A doubt is no failure: what is doubted counts as it was given.
"""

from __future__ import annotations

from collections.abc import Container
from typing import NamedTuple

from grasp_quality.arrays import Array
from grasp_quality.contact_set import ContactSet
from grasp_quality.node_settings import Settings
import numpy as np

PULLING = 0.02  # share of its cap from which a pull is no noise; min_contact_force knows better
APART = 3.0     # [m] along an axis: contacts of hands are nearer, unless in millimetres
MOST_FRICTION = 5.0  # soft rubber has 2
LISTED = 8      # contacts that a sentence names


class Felt(NamedTuple):
    """
    Measured forces of the contacts of one instant, of those that do not count too.

    Attributes
    ----------
    contacts : ContactSet
    forces : list of (4,) array [N, N, N, N m] or None
        [t1, t2, n, m_n] of each, finger on object, where a fresh one came that can be used.
    refused : dict
        By name, why a fresh wrench cannot be used.

    """

    contacts: ContactSet
    forces: list[Array | None]
    refused: dict[str, str]

    def loaded(self, least: float) -> list[int]:
        """Return the contacts whose measured normal force reaches the least that counts [N]."""
        return [i for i, force in enumerate(self.forces)
                if force is not None and force[2] >= least]


def doubts(felt: Felt, settings: Settings, heard: Container[str]) -> tuple[str, ...]:
    """
    Say what a user should know of contacts and forces before trusting what is made of them.

    Parameters
    ----------
    felt : Felt
        By the contacts that there are now.
    settings : Settings
        Of the node.
    heard : container of str
        Names of the contacts for which a wrench ever came.

    Returns
    -------
    tuple of str, a sentence each; empty when nothing is doubtful

    """
    said = (_unloaded(felt, settings.min_contact_force), _pulling(felt, settings),
            _missing(felt, settings, heard), _apart(felt.contacts), _sticky(felt.contacts))
    return tuple(filter(None, said))


def _unloaded(felt: Felt, least: float) -> str:
    loaded, count = felt.loaded(least), len(felt.forces)
    if least <= 0.0 or len(loaded) == count:
        return ''
    return f'{len(loaded)} of {count} contacts loaded: ' + _listed([
        f'{name} is not (' + (
            f'{force[2]:.3g} N of min_contact_force {least:g} N)' if force is not None
            else 'its wrench cannot be used)' if name in felt.refused
            else 'no fresh measured wrench)')
        for i, (name, force) in enumerate(zip(felt.contacts.names, felt.forces))
        if i not in loaded])


def _pulling(felt: Felt, settings: Settings) -> str:
    """Fingers push; one that pulls the object by more than noise was measured the other way."""
    caps = felt.contacts.max_normal_forces
    pulling = [f'{name} {force[2]:.3g} N' for name, force, cap in zip(
        felt.contacts.names, felt.forces, caps) if force is not None
        and force[2] <= -(settings.min_contact_force or PULLING * cap)]
    return (
        f'measured normal force below zero: {_listed(pulling)}; it is that of the finger on the '
        'object, positive along the inward normal: negate a wrench of the object on the finger '
        'before it is published, or turn +z of the contact into the object') if pulling else ''


def _missing(felt: Felt, settings: Settings, heard: Container[str]) -> str:
    if not felt.refused and all(force is None for force in felt.forces):
        return ''  # fingers that do not feel
    missing = [name for name, force in zip(felt.contacts.names, felt.forces)
               if force is None and name not in felt.refused]
    return ('no fresh measured wrench of ' + _listed([
        f'{name} ({_absence(name, settings, heard)})' for name in missing])) if missing else ''


def _absence(name: str, settings: Settings, heard: Container[str]) -> str:
    topic = f'~/contact_wrenches/{name}'
    if name in heard:
        return f'the last on {topic} is older than max_contact_age {settings.max_contact_age:g} s'
    if name in settings.contact_names:
        return f'none ever came on {topic}'
    return f'{topic} is not listened to: contact_names, which name these topics, lack it'


def _apart(contacts: ContactSet) -> str:
    apart = float(np.ptp(contacts.positions, axis=0).max())
    return (f'contacts are {apart:.3g} m apart: positions are in metres, are these in '
            'millimetres?') if apart > APART else ''


def _sticky(contacts: ContactSet) -> str:
    sticky = [f'{name} {mu:.3g}' for name, mu in zip(contacts.names, contacts.friction)
              if mu > MOST_FRICTION]
    return (f'friction coefficient above {MOST_FRICTION:g}: {_listed(sticky)}; it is the largest '
            'tangential over the normal force, no angle and no percentage') if sticky else ''


def _listed(items: list[str]) -> str:
    more = len(items) - LISTED
    return ', '.join(items[:LISTED]) + (f' and {more} more' if more > 0 else '')

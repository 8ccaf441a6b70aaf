# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Bounds on the normal forces: which combinations of n_i / f_max,i a hand can press with.

Contacts are partitioned into groups, and each group obeys sum_i n_i / f_max,i <= 1: one group for
``l1``, one group a contact for ``linf``, one group a finger for ``finger``. ``l2`` bounds the
Euclidean norm of all n_i / f_max,i instead (the paper's norms on the normals, section II).
"""

from collections.abc import Sequence

from grasp_quality.arrays import Array
from grasp_quality.exceptions import InvalidGraspError
import numpy as np

BOUNDS = ('l1', 'l2', 'linf', 'finger')


def groups_of(bound: str, fingers: Sequence[str]) -> tuple[int, ...]:
    """
    Partition the contacts.

    Parameters
    ----------
    bound : str
        'l1', 'l2', 'linf' or 'finger'.
    fingers : sequence of str
        Finger of every contact; read for 'finger' only.

    Returns
    -------
    tuple of int, group of every contact, numbered from 0 in order of appearance ('l2': all 0).

    """
    if bound not in BOUNDS:
        raise InvalidGraspError(f'bound must be one of {list(BOUNDS)}, got {bound!r}')
    if bound == 'linf':
        return tuple(range(len(fingers)))
    if bound in ('l1', 'l2'):
        return (0,) * len(fingers)
    missing = [i for i, finger in enumerate(fingers) if not finger]
    if missing:
        raise InvalidGraspError(
            f"bound 'finger' needs the finger of every contact, but contacts {missing} have none: "
            "set Contact.finger, or use bound 'linf'")
    order = {finger: g for g, finger in enumerate(dict.fromkeys(fingers))}
    return tuple(order[finger] for finger in fingers)


def group_maxima(values: Array, groups: tuple[int, ...]) -> Array:
    """Largest value of each group, (number of groups,)."""
    largest = np.full(max(groups) + 1, -np.inf)
    np.maximum.at(largest, list(groups), values)
    return largest


def gauge(shares: Array, bound: str, groups: tuple[int, ...]) -> float:
    """
    Smallest factor by which the bound must be widened to admit the normals.

    Parameters
    ----------
    shares : (k,) array
        n_i / f_max,i.
    bound : str
        One of ``BOUNDS``.
    groups : (k,) tuple of int
        Group of each contact, from ``groups_of``.

    Returns
    -------
    float, at most 1 when the bound holds.

    """
    if bound == 'linf':
        return float(shares.max())
    if bound == 'l2':
        return float(np.sqrt(shares @ shares))
    return float(np.bincount(groups, weights=shares).max())


def support(values: Array, bound: str, groups: tuple[int, ...]) -> float:
    """
    Largest sum_i values_i n_i / f_max,i over all normals n >= 0 inside the bound.

    Parameters
    ----------
    values : (k,) array
        Worth of each contact's normal force at its cap.
    bound : str
        One of ``BOUNDS``.
    groups : (k,) tuple of int
        Group of each contact, from ``groups_of``.

    """
    worth = np.maximum(values, 0.0)
    if bound == 'linf':
        return float(worth.sum())
    if bound == 'l1':
        return float(worth.max())
    if bound == 'l2':
        return float(np.sqrt(worth @ worth))
    return float(group_maxima(worth, groups).sum())

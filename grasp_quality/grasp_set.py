# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Many grasps as a structure of arrays: what ``evaluate_many`` computes with.

Building a Grasp takes longer than solving its problem, so that thousands of them are better made
here, checked all at once. The contacts of all grasps stand one after the other, each grasp with
as many as it has. Grasps of equal contact count come from ``GraspSet.of_arrays``, variations of
one grasp (samples of uncertain contacts) from ``GraspSet.varied``:

    varied = GraspSet.varied(grasp, positions=..., normals=..., friction=...)  # (M, k, 3), (M, k)
    evaluate_many(varied, task, external_wrench=loads)  # loads (M, 6) or (6,)

Grasp objects come from ``GraspSet.of``; indexing gives a Grasp.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from grasp_quality import bounds
from grasp_quality.arguments import plain_grasps
from grasp_quality.arrays import ANY, checked, floats, frozen, SMALLEST
from grasp_quality.contact import (
    ContactModel, FARTHEST, IDENTITY, model_of, ROTATION_TOLERANCE)
from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import InvalidContactError, InvalidGraspError
from grasp_quality.frames import frames_of_normals
from grasp_quality.grasp import Grasp, MAX_CAP_RATIO
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class GraspSet(Sequence):  # type: ignore[type-arg]
    """
    Contacts of M grasps in their object frames; each row is one contact.

    Parameters
    ----------
    starts : (M + 1,) array_like of int
        First contact of every grasp, and the number of all contacts.
    positions : (n, 3) array_like [m]
    rotations : (n, 3, 3) array_like
        R_object_contact.
    friction, torsional_friction : (n,) array_like [-], [m]
        As far as the contact models let them act: zero for what a contact does not transmit.
    max_normal_forces : (n,) array_like [N]
    groups : (n,) array_like of int
        Group of the force bound, numbered from 0 in each grasp (``bounds.groups_of``).
    is_l2 : (M,) array_like of bool
        Whether the bound is l2 instead of that of the groups.

    Raises
    ------
    InvalidContactError, InvalidGraspError
        Name the first grasp that breaks a rule.

    """

    starts: NDArray[np.int64]
    positions: Array
    rotations: Array
    friction: Array
    torsional_friction: Array
    max_normal_forces: Array
    groups: NDArray[np.int64]
    is_l2: NDArray[np.bool_]

    def __post_init__(self) -> None:
        """Validate and copy."""
        def put(name: str, value: NDArray[np.generic]) -> None:
            object.__setattr__(self, name, frozen(value))

        put('starts', np.array(self.starts, dtype=np.int64))
        n, count = int(self.starts[-1]), len(self.starts) - 1
        if self.starts[0] != 0 or (np.diff(self.starts) < 1).any():
            raise InvalidGraspError('every grasp needs at least one contact')
        for name, shape in (('positions', (n, 3)), ('rotations', (n, 3, 3)), ('friction', (n,)),
                            ('torsional_friction', (n,)), ('max_normal_forces', (n,))):
            put(name, checked(getattr(self, name), shape, name, InvalidContactError))
        put('groups', np.array(self.groups, dtype=np.int64))
        put('is_l2', np.array(self.is_l2, dtype=bool))
        if self.groups.shape != (n,) or self.is_l2.shape != (count,):
            raise InvalidGraspError(
                f'groups must have one entry for each of {n} contacts and is_l2 one for each of '
                f'{count} grasps, got {self.groups.shape} and {self.is_l2.shape}')
        self._check()

    def _check(self) -> None:
        R = self.rotations
        skew = np.abs(R.transpose(0, 2, 1) @ R - IDENTITY).max(axis=(1, 2))
        for broken, rule in (
                ((skew > ROTATION_TOLERANCE) | (np.linalg.det(R) < 0.0),
                 'rotation must be a right-handed orthonormal matrix'),
                (np.abs(self.positions).max(axis=1) > FARTHEST,
                 f'position must lie within {FARTHEST:g} m of the origin'),
                ((self.friction < 0.0) | (self.torsional_friction < 0.0),
                 'friction and torsional_friction must be at least 0'),
                (self.max_normal_forces < SMALLEST, 'max_normal_force must be greater than 0')):
            if broken.any():
                row = int(np.flatnonzero(broken)[0])
                grasp = int(np.searchsorted(self.starts, row, side='right')) - 1
                raise InvalidContactError(
                    f'grasp {grasp}, contact {row - self.starts[grasp]}: {rule}, got position '
                    f'{self.positions[row].tolist()}, friction {self.friction[row]:g}, '
                    f'{self.torsional_friction[row]:g} m, cap {self.max_normal_forces[row]:g}, '
                    f'rotation {R[row].tolist()}')
        largest = np.maximum.reduceat(self.max_normal_forces, self.starts[:-1])
        least = np.minimum.reduceat(self.max_normal_forces, self.starts[:-1])
        if (largest > MAX_CAP_RATIO * least).any():
            i = int(np.flatnonzero(largest > MAX_CAP_RATIO * least)[0])
            raise InvalidGraspError(
                f'grasp {i}: max_normal_force of one grasp may span a factor of {MAX_CAP_RATIO:g} '
                f'at most, got {least[i]:g} to {largest[i]:g} N')

    @classmethod
    def of(cls, grasps: Iterable[Grasp]) -> GraspSet:
        """Stack Grasp objects."""
        grasps = plain_grasps(grasps)
        scales = np.concatenate([g.scales for g in grasps])
        return cls(
            np.cumsum([0] + [len(g) for g in grasps]),
            np.concatenate([g.positions for g in grasps]),
            np.concatenate([g.rotations for g in grasps]), scales[:, 0], scales[:, 3],
            np.concatenate([g.max_normal_forces for g in grasps]),
            np.concatenate([g.groups for g in grasps]),
            np.array([g.bound == 'l2' for g in grasps]))

    @classmethod
    def of_arrays(
            cls, positions: ArrayLike, normals: ArrayLike | None = None, *,
            rotations: ArrayLike | None = None,
            model: ContactModel | str | Sequence[ContactModel | str] = ContactModel.PCWF,
            friction: ArrayLike = 0.5, torsional_friction: ArrayLike = 0.0,
            max_normal_force: ArrayLike = 1.0, bound: str = 'linf',
            fingers: Sequence[str] = ()) -> GraspSet:
        """
        Make M grasps of k contacts each.

        Parameters
        ----------
        positions : (M, k, 3) array_like [m]
            Contact points in the object frame.
        normals : (M, k, 3) array_like
            Inward, of any length but zero; tangents are chosen as ``Contact`` chooses them.
        rotations : (M, k, 3, 3) array_like
            Instead of normals.
        model : ContactModel, or its name
            One for all, or a sequence with one for each of the k contacts.
        friction, torsional_friction, max_normal_force : array_like [-], [m], [N]
            Broadcast to (M, k).
        bound : str
            As in ``Grasp``.
        fingers : (k,) sequence of str
            For the finger bound.

        """
        points: Array = checked(positions, (None, None, 3), 'positions', InvalidContactError)
        M, k = points.shape[:2]
        if (normals is None) == (rotations is None):
            raise InvalidContactError('give exactly one of normals and rotations')
        if normals is not None:
            given: Array = checked(normals, (M, k, 3), 'normals', InvalidContactError, ANY)
            frames = frames_of_normals(given.reshape(-1, 3))
        elif rotations is not None:
            frames = checked(rotations, (M, k, 3, 3), 'rotations', InvalidContactError)
        models = [model_of(m) for m in (
            [model] * k if isinstance(model, (ContactModel, str)) else model)]
        groups = bounds.groups_of(bound, list(fingers) or [''] * k)
        if not M or not k or len(models) != k or len(groups) != k:
            raise InvalidGraspError(
                f'got {M} grasps of {k} contacts, {len(models)} models and {len(groups)} fingers: '
                'there must be at least one grasp and one contact, and a model and a finger for '
                'each of them')
        slides = [m is not ContactModel.FPC for m in models]
        twists = [m is ContactModel.SFCE for m in models]
        return cls(
            np.arange(M + 1) * k, points.reshape(-1, 3), frames.reshape(-1, 3, 3),
            (_spread(friction, M, k, 'friction') * slides).ravel(),
            (_spread(torsional_friction, M, k, 'torsional_friction') * twists).ravel(),
            _spread(max_normal_force, M, k, 'max_normal_force').ravel(), np.tile(groups, M),
            np.full(M, bound == 'l2'))

    @classmethod
    def varied(
            cls, grasp: Grasp, *, positions: ArrayLike | None = None,
            normals: ArrayLike | None = None, rotations: ArrayLike | None = None,
            friction: ArrayLike | None = None,
            torsional_friction: ArrayLike | None = None,
            max_normal_force: ArrayLike | None = None, count: int = 1) -> GraspSet:
        """
        Make variations of one grasp: what is left out stays as it is.

        Parameters
        ----------
        grasp : Grasp
            What is varied.
        positions, normals, rotations : (M, k, 3), (M, k, 3), (M, k, 3, 3) array_like
            Contact points [m], and inward normals or R_object_contact.
        friction, torsional_friction, max_normal_force : (M, k) array_like
            [-], [m], [N]
        count : int
            M, where nothing but the task or the load varies.

        """
        cls.of([grasp])  # refuses what a set does not know
        k, old = len(grasp), grasp.contacts
        given = [np.shape(a) for a in (positions, normals, rotations, friction,
                                       torsional_friction, max_normal_force) if a is not None]
        M = given[0][0] if given and given[0] else count
        if normals is None and rotations is None:
            rotations = np.broadcast_to(grasp.rotations, (M, k, 3, 3))
        return cls.of_arrays(
            np.broadcast_to(grasp.positions, (M, k, 3)) if positions is None else positions,
            normals, rotations=rotations, model=old.models,
            friction=old.friction if friction is None else friction,
            torsional_friction=(
                old.torsional_friction if torsional_friction is None else torsional_friction),
            max_normal_force=(
                old.max_normal_forces if max_normal_force is None else max_normal_force),
            bound=grasp.bound, fingers=old.fingers)

    def __len__(self) -> int:
        """Count the grasps."""
        return len(self.starts) - 1

    def __getitem__(self, index: int) -> Grasp:  # type: ignore[override]
        """Return one grasp, its contacts without names; its frictionless ones keep friction 0."""
        index = range(len(self))[index]
        rows = slice(self.starts[index], self.starts[index + 1])
        k = rows.stop - rows.start
        contacts = ContactSet(
            self.positions[rows], self.rotations[rows], (ContactModel.SFCE,) * k,
            self.friction[rows], self.torsional_friction[rows], self.max_normal_forces[rows],
            ('',) * k, [str(g) for g in self.groups[rows]])
        return Grasp(contacts, 'l2' if self.is_l2[index] else 'finger')


def _spread(values: ArrayLike, M: int, k: int, name: str) -> Array:
    array = floats(values, name, 'numbers', InvalidContactError)
    try:
        return np.broadcast_to(array, (M, k))
    except ValueError as exc:
        raise InvalidContactError(
            f'{name} must broadcast to ({M}, {k}) numbers, got {values!r}') from exc

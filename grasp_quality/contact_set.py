# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Many contacts as a structure of arrays: what a Grasp computes with and messages are read into.

The same facts as a list of Contact objects, checked all at once: building eight Contact objects
takes longer than solving their problem. Indexing gives a Contact, slicing a ContactSet.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NoReturn, overload, TYPE_CHECKING

from grasp_quality.arrays import Array, Bools, checked, frozen, SMALLEST
from grasp_quality.contact import (
    Contact, ContactModel, FARTHEST, IDENTITY, model_of, ROTATION_TOLERANCE)
from grasp_quality.exceptions import InvalidContactError, InvalidGraspError
import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)
class ContactSet(Sequence[Contact]):
    """
    Contacts in the object frame; each row is one contact.

    Parameters
    ----------
    positions : (k, 3) array_like [m]
    rotations : (k, 3, 3) array_like
        R_object_contact; columns t1, t2, inward normal.
    models : sequence of ContactModel or str
    friction, torsional_friction, max_normal_forces : (k,) array_like [-], [m], [N]
    names, fingers : sequences of str

    Raises
    ------
    InvalidContactError
        Names the first contact that breaks a rule.

    """

    positions: Array
    rotations: Array
    models: tuple[ContactModel, ...]
    friction: Array
    torsional_friction: Array
    max_normal_forces: Array
    names: tuple[str, ...]
    fingers: tuple[str, ...]

    if TYPE_CHECKING:  # anything like an array may be given
        def __init__(self, positions: ArrayLike, rotations: ArrayLike,
                     models: Sequence[ContactModel | str], friction: ArrayLike,
                     torsional_friction: ArrayLike, max_normal_forces: ArrayLike,
                     names: Sequence[str], fingers: Sequence[str]) -> None: ...

    def __post_init__(self) -> None:
        """Validate and copy."""
        k = len(self.names)
        for field, shape in (('positions', (k, 3)), ('rotations', (k, 3, 3)), ('friction', (k,)),
                             ('torsional_friction', (k,)), ('max_normal_forces', (k,))):
            object.__setattr__(
                self, field, checked(getattr(self, field), shape, field, InvalidContactError))
        for field in ('models', 'names', 'fingers'):
            object.__setattr__(self, field, tuple(getattr(self, field)))
            if len(getattr(self, field)) != k:
                raise InvalidContactError(f'{field} must have one entry for each of {k} contacts')
        if k:
            self._check()

    def moved(self, positions: ArrayLike, rotations: ArrayLike) -> ContactSet:
        """
        Return the same contacts elsewhere; only their places are checked.

        Parameters
        ----------
        positions : (k, 3) array_like [m]
            In the object frame.
        rotations : (k, 3, 3) array_like
            R_object_contact.

        Raises
        ------
        InvalidContactError

        """
        contacts, k = object.__new__(ContactSet), len(self)
        contacts.__dict__.update(
            self.__dict__,
            positions=checked(positions, (k, 3), 'positions', InvalidContactError),
            rotations=checked(rotations, (k, 3, 3), 'rotations', InvalidContactError))
        if k:
            contacts._check_places()
        return contacts

    def _check_places(self) -> None:
        R = self.rotations
        skew = np.abs(R.transpose(0, 2, 1) @ R - IDENTITY)
        if skew.max() > ROTATION_TOLERANCE or np.linalg.det(R).min() < 0.0:
            self._refuse((skew.max(axis=(1, 2)) > ROTATION_TOLERANCE) | (np.linalg.det(R) < 0.0),
                         'rotation must be a right-handed orthonormal matrix (columns t1, t2, '
                         'inward normal)')
        if np.abs(self.positions).max() > FARTHEST:
            self._refuse(np.abs(self.positions).max(axis=1) > FARTHEST,
                         f'position must lie within {FARTHEST:g} m of the origin')

    def _check(self) -> None:
        self._check_places()
        if self.friction.min() < 0.0:
            self._refuse(self.friction < 0.0, 'friction must be at least 0')
        if self.torsional_friction.min() < 0.0:
            self._refuse(self.torsional_friction < 0.0, 'torsional_friction must be at least 0')
        if self.max_normal_forces.min() < SMALLEST:
            self._refuse(self.max_normal_forces < SMALLEST,
                         f'max_normal_force must be greater than 0, at least {SMALLEST:g}')
        if not all(isinstance(model, ContactModel) for model in self.models):
            object.__setattr__(self, 'models', tuple(
                model_of(model, f'contact {i} ({self.names[i]!r}): ')
                for i, model in enumerate(self.models)))

    def _refuse(self, broken: Bools | list[bool], rule: str) -> NoReturn:
        i = int(np.flatnonzero(broken)[0])
        raise InvalidContactError(
            f'contact {i} ({self.names[i]!r}): {rule}, got position '
            f'{self.positions[i].tolist()}, model {self.models[i]}, friction '
            f'{self.friction[i]:g}, torsional_friction {self.torsional_friction[i]:g}, '
            f'max_normal_force {self.max_normal_forces[i]:g}, '
            f'rotation {self.rotations[i].tolist()}')

    @classmethod
    def of(cls, contacts: Iterable[Contact]) -> ContactSet:
        """Stack Contact objects."""
        return cls(
            np.array([c.position for c in contacts]).reshape(-1, 3),
            np.array([c.rotation for c in contacts]).reshape(-1, 3, 3),
            [c.model for c in contacts], [c.friction for c in contacts],
            [c.torsional_friction for c in contacts], [c.max_normal_force for c in contacts],
            [c.name for c in contacts], [c.finger for c in contacts])

    def subset(self, indices: Iterable[int]) -> ContactSet:
        """Return the contacts at these indices, in their order, as another ContactSet."""
        rows = list(indices)
        return ContactSet(
            self.positions[rows], self.rotations[rows], [self.models[i] for i in rows],
            self.friction[rows], self.torsional_friction[rows], self.max_normal_forces[rows],
            [self.names[i] for i in rows], [self.fingers[i] for i in rows])

    @property
    def effective_friction(self) -> Array:
        """Coulomb coefficients (k,) [-] that the models let act: 0 for FPC."""
        return frozen(self.friction * [m is not ContactModel.FPC for m in self.models])

    @property
    def effective_torsional_friction(self) -> Array:
        """Torsional coefficients (k,) [m] that the models let act: 0 but for SFCE."""
        return frozen(self.torsional_friction * [m is ContactModel.SFCE for m in self.models])

    def __len__(self) -> int:
        """Count the contacts."""
        return len(self.names)

    @overload
    def __getitem__(self, index: int) -> Contact: ...

    @overload
    def __getitem__(self, index: slice) -> ContactSet: ...

    def __getitem__(self, index: int | slice) -> Contact | ContactSet:
        """Return one contact as a Contact, or a slice of them as a ContactSet."""
        if isinstance(index, slice):
            return self.subset(range(len(self))[index])
        return Contact(
            position=self.positions[index], rotation=self.rotations[index],
            model=self.models[index], friction=self.friction[index],
            torsional_friction=self.torsional_friction[index],
            max_normal_force=self.max_normal_forces[index], name=self.names[index],
            finger=self.fingers[index])


def as_contact_set(contacts: Iterable[Contact]) -> ContactSet:
    """Return a ContactSet of a sequence of Contact objects, or the set that was given."""
    if isinstance(contacts, ContactSet):
        return contacts
    try:
        contacts = tuple(contacts)
    except TypeError as exc:
        raise InvalidGraspError(
            f'contacts must be a sequence of Contact, got {contacts!r}') from exc
    strangers = [c for c in contacts if not isinstance(c, Contact)]
    if strangers:
        raise InvalidGraspError(f'contacts must be Contact objects, got {strangers[0]!r}')
    return ContactSet.of(contacts)

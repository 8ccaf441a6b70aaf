# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
One contact: where a finger touches the object, and what it can transmit there.

The contact frame has its origin at the contact point and its +z axis along the inward normal. The
three models nest: FPC transmits n >= 0; PCWF adds |t| <= mu n; SFCE couples the tangential force
with a moment about the normal, |t|^2 / mu^2 + m_n^2 / gamma^2 <= n^2 (the paper, section II).
"""

from __future__ import annotations

from dataclasses import dataclass
import enum
from typing import TYPE_CHECKING

from grasp_quality.arrays import ANY, Array, checked, checked_number, frozen, SMALLEST
from grasp_quality.exceptions import InvalidContactError
import numpy as np
from numpy.typing import ArrayLike

FARTHEST = 1e3  # [m], of any coordinate: one far contact would drown the others' torques
IDENTITY = frozen(np.eye(3))
ROTATION_TOLERANCE = 1e-6  # largest |R^T R - I| entry that still counts as a rotation


class ContactModel(enum.Enum):
    """What a contact transmits; the names are those of the grasping literature."""

    FPC = 'FPC'    # frictionless point contact
    PCWF = 'PCWF'  # point contact with (Coulomb) friction
    SFCE = 'SFCE'  # soft finger contact, elliptic approximation


def model_of(value: object, label: str = '') -> ContactModel:
    """Return the model of a ContactModel or its name."""
    try:
        return ContactModel(value)
    except ValueError as exc:
        raise InvalidContactError(
            f'{label}model must be one of {[m.value for m in ContactModel]}, or a ContactModel, '
            f'got {value!r}') from exc


@dataclass(frozen=True, eq=False)
class Contact:
    """
    A contact in the object frame.

    Parameters
    ----------
    position : (3,) array_like [m]
        Contact point in the object frame.
    normal : (3,) array_like, optional
        Inward normal (into the object) in the object frame, of any length but zero. The tangents
        t1, t2 are then chosen by a fixed rule; give ``rotation`` instead to choose them yourself.
    model : ContactModel or str
        Or its name, 'FPC', 'PCWF' or 'SFCE'; PCWF unless given.
    friction : float [-]
        Coulomb coefficient mu >= 0, 0.5 unless given; not used by FPC.
    torsional_friction : float [m]
        gamma >= 0, the largest moment about the normal per newton of normal force, 0 unless given;
        used by SFCE only, whatever it is elsewhere.
    max_normal_force : float [N]
        f_max > 0; 1 N unless given.
    name, finger : str
        What the contact is called and which finger it belongs to (for the finger bound).
    rotation : (3, 3) array_like, optional
        R_object_contact with columns t1, t2, inward normal; instead of ``normal``.

    Raises
    ------
    InvalidContactError

    """

    position: Array
    normal: Array = None  # type: ignore[assignment]  # never None once made
    model: ContactModel = ContactModel.PCWF
    friction: float = 0.5
    torsional_friction: float = 0.0
    max_normal_force: float = 1.0
    name: str = ''
    finger: str = ''
    rotation: Array = None  # type: ignore[assignment]  # never None once made

    if TYPE_CHECKING:  # anything like an array may be given
        def __init__(self, position: ArrayLike, normal: ArrayLike | None = None,
                     model: ContactModel | str = ContactModel.PCWF, friction: float = 0.5,
                     torsional_friction: float = 0.0, max_normal_force: float = 1.0,
                     name: str = '', finger: str = '', rotation: ArrayLike | None = None) -> None:
            ...

    def __post_init__(self) -> None:
        """Validate, copy and complete the fields."""
        label = f'contact {self.name!r}: ' if self.name else 'contact: '

        def put(field: str, value: object) -> None:
            object.__setattr__(self, field, value)

        put('position', checked(self.position, (3,), label + 'position', InvalidContactError))
        if np.abs(self.position).max() > FARTHEST:
            raise InvalidContactError(
                f'{label}position must lie within {FARTHEST:g} m of the origin, '
                f'got {self.position.tolist()}')
        put('rotation', self._frame(label))
        put('normal', self.rotation[:, 2])
        put('model', model_of(self.model, label))
        for field in ('friction', 'torsional_friction'):
            put(field, checked_number(
                getattr(self, field), label + field, InvalidContactError, minimum=0.0))
        put('max_normal_force', checked_number(
            self.max_normal_force, label + 'max_normal_force', InvalidContactError, SMALLEST, 0.0))

    def _frame(self, label: str) -> Array:
        if (self.normal is None) == (self.rotation is None):
            raise InvalidContactError(
                f'{label}give exactly one of normal and rotation, got '
                + ('neither' if self.normal is None else 'both'))
        if self.rotation is None:
            normal = checked(
                self.normal, (3,), label + 'normal', InvalidContactError, ANY)
            return frozen(frame_from_normal(normal, label))
        rotation = checked(self.rotation, (3, 3), label + 'rotation', InvalidContactError)
        skew = np.abs(rotation.T @ rotation - IDENTITY).max()
        (a, b, c), (d, e, f), (g, h, i) = rotation.tolist()
        determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
        if skew > ROTATION_TOLERANCE or determinant < 0.0:
            raise InvalidContactError(
                f'{label}rotation must be a right-handed orthonormal matrix (columns t1, t2, '
                f'inward normal), got {rotation.tolist()}')
        return rotation

    @property
    def effective_friction(self) -> float:
        """Coulomb coefficient that the model lets act: 0 for FPC."""
        return 0.0 if self.model is ContactModel.FPC else self.friction

    @property
    def effective_torsional_friction(self) -> float:
        """Torsional coefficient [m] that the model lets act: 0 but for SFCE."""
        return self.torsional_friction if self.model is ContactModel.SFCE else 0.0


def frame_from_normal(normal: Array, label: str = '') -> Array:
    """
    Build R_object_contact (3, 3) from an inward normal of any length but zero.

    t1 is the coordinate axis least aligned with the normal, made orthogonal to it, so that the
    frame depends on nothing but the normal.

    """
    largest = np.abs(normal).max()
    if largest == 0.0:
        raise InvalidContactError(f'{label}normal must not be zero, got {normal.tolist()}')
    n = normal / largest
    n = n / np.sqrt(n @ n)
    axis = np.zeros(3)
    axis[np.argmin(np.abs(n))] = 1.0
    t1 = axis - (axis @ n) * n
    t1 /= np.sqrt(t1 @ t1)
    t2 = np.array([n[1] * t1[2] - n[2] * t1[1],
                   n[2] * t1[0] - n[0] * t1[2],
                   n[0] * t1[1] - n[1] * t1[0]])
    return np.stack([t1, t2, n], axis=1)

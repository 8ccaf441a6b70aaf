# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contacts: PoseArray and ContactArray messages to a core ContactSet in the object frame.

Zero in a field of a ContactArray means the node's default; a PoseArray takes everything but the
poses from the defaults. +z of each pose is the inward normal.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from grasp_quality.arrays import Array
from grasp_quality.contact import ContactModel
from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import InvalidContactError
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
from msg_adapters.message_types import Contacts, Item, Pose, Poses
from msg_adapters.number_checks import checked_numbers, SMALLEST
from msg_adapters.poses import frames_of

MODEL_DEFAULT = 0  # these are the constants of Contact.msg
MODELS = {1: ContactModel.FPC, 2: ContactModel.PCWF, 3: ContactModel.SFCE}


@dataclass(frozen=True)
class ContactDefaults:
    """
    What messages leave open.

    Parameters
    ----------
    model : ContactModel
    friction : float [-]
    torsional_friction : float [m]
    max_normal_force : float [N]
    names, fingers : tuple of str
        Of the poses of a PoseArray, in order; empty: contact_0, contact_1, ..., each its own
        finger.

    """

    model: ContactModel = ContactModel.PCWF
    friction: float = 0.5
    torsional_friction: float = 0.005
    max_normal_force: float = 10.0
    names: tuple[str, ...] = ()
    fingers: tuple[str, ...] = ()


def contacts_from_poses(message: Poses, defaults: ContactDefaults,
                        transform: Transform | None = None,
                        like: ContactSet | None = None) -> ContactSet:
    """
    Read a geometry_msgs/PoseArray.

    Parameters
    ----------
    message : geometry_msgs.msg.PoseArray
        Contact frames, +z along the inward normal, in header.frame_id.
    defaults : ContactDefaults
        Model, friction, caps and names, which poses do not carry.
    transform : Transform, optional
        Into the object frame.
    like : ContactSet, optional
        Of an earlier message of as many poses, read with the same defaults: all but the poses is
        taken from it, which saves time.

    Returns
    -------
    ContactSet, empty for an empty message

    Raises
    ------
    InvalidMessageError

    """
    count = len(message.poses)
    fields = [f'poses[{i}]' for i in range(count)]
    if like is not None and len(like) == count:
        return _refusing(like.moved, *_frames(message.poses, fields, transform))
    names = defaults.names or tuple(f'contact_{i}' for i in range(count))
    fingers = defaults.fingers or names
    if count and count != len(names):
        raise InvalidMessageError(
            f'poses must hold one pose for each of the {len(names)} contact_names '
            f'{list(names)}, got {count}: publish them all (contact_wrenches tell which are '
            'loaded), leave contact_names empty, or use contact_source contact_array')
    return _refusing(
        ContactSet, *_frames(message.poses, fields, transform), models=[defaults.model] * count,
        friction=[defaults.friction] * count,
        torsional_friction=[defaults.torsional_friction] * count,
        max_normal_forces=[defaults.max_normal_force] * count,
        names=names[:count], fingers=fingers[:count])


def contacts_from_array(message: Contacts, defaults: ContactDefaults,
                        transform: Transform | None = None) -> ContactSet:
    """
    Read a grasp_quality_msgs/ContactArray.

    Parameters, result and errors are those of ``contacts_from_poses``.

    """
    items = [(f'contacts[{i}]', item) for i, item in enumerate(message.contacts)]
    names = [item.name or f'contact_{i}' for i, (_, item) in enumerate(items)]
    seen = set()
    for name, (field, _) in zip(names, items):
        if name in seen:
            raise InvalidMessageError(f'{field}.name must be unique, got {name!r} twice')
        seen.add(name)

    def numbers(name: str, default: float) -> list[float]:
        return [_number(item, name, default, field) for field, item in items]

    frames = _frames([item.pose for _, item in items], [f'{field}.pose' for field, _ in items],
                     transform)
    return _refusing(
        ContactSet, *frames, models=[_model(item.model, defaults, field) for field, item in items],
        friction=numbers('friction_coefficient', defaults.friction),
        torsional_friction=numbers('torsional_friction_coefficient', defaults.torsional_friction),
        max_normal_forces=numbers('max_normal_force', defaults.max_normal_force),
        names=names, fingers=[item.finger or name for name, (_, item) in zip(names, items)])


def _frames(poses: Sequence[Pose], names: Sequence[str], transform: Transform | None
            ) -> tuple[Array, Array]:
    """Positions (k, 3) [m] and rotations (k, 3, 3) of poses in the object frame."""
    positions, rotations = frames_of(poses, names)
    if transform is not None:
        positions, rotations = positions @ transform.R.T + transform.p, transform.R @ rotations
    return positions, rotations


def _refusing(make: Callable[..., ContactSet], *arrays: Array, **fields: Any) -> ContactSet:
    """Call what makes a ContactSet; what it refuses is the message's fault."""
    try:
        return make(*arrays, **fields)
    except InvalidContactError as exc:
        raise InvalidMessageError(str(exc)) from exc


def _model(code: int, defaults: ContactDefaults, field: str) -> ContactModel:
    if code == MODEL_DEFAULT:
        return defaults.model
    if code not in MODELS:
        raise InvalidMessageError(
            f'{field}.model must be one of 0 (default), 1 (FPC), 2 (PCWF), 3 (SFCE), got {code}')
    return MODELS[code]


def _number(item: Item, name: str, default: float, field: str) -> float:
    value, = checked_numbers((getattr(item, name),), f'{field}.{name}')
    if value != 0.0 and value < SMALLEST:
        raise InvalidMessageError(
            f'{field}.{name} must be at least {SMALLEST:g}, or 0 for the default, got {value}')
    return value or default

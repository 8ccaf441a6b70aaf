# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contacts: PoseArray and ContactArray messages to core Contact objects in the object frame.

Zero in a field of a ContactArray means the node's default; a PoseArray takes everything but the
poses from the defaults. +z of each pose is the inward normal.
"""

from dataclasses import dataclass

from grasp_quality.contact import Contact, ContactModel
from grasp_quality.exceptions import InvalidContactError
from grasp_quality_msgs.msg import Contact as ContactMsg
from msg_adapters.errors import InvalidMessageError
from msg_adapters.number_checks import checked_numbers, SMALLEST
from msg_adapters.poses import pose_arrays

MODELS = {ContactMsg.MODEL_FPC: ContactModel.FPC, ContactMsg.MODEL_PCWF: ContactModel.PCWF,
          ContactMsg.MODEL_SFCE: ContactModel.SFCE}


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
    names: tuple = ()
    fingers: tuple = ()


def contacts_from_poses(message, defaults, transform=None):
    """
    Read a geometry_msgs/PoseArray.

    Parameters
    ----------
    message : geometry_msgs.msg.PoseArray
    defaults : ContactDefaults
    transform : Transform, optional
        Into the object frame.

    Returns
    -------
    list of Contact, empty for an empty message

    Raises
    ------
    InvalidMessageError

    """
    count = len(message.poses)
    names = defaults.names or tuple(f'contact_{i}' for i in range(count))
    fingers = defaults.fingers or names
    if count and count != len(names):
        raise InvalidMessageError(
            f'poses must hold one pose for each of the {len(names)} contact_names '
            f'{list(names)}, got {count}: publish them all (contact_wrenches tell which are '
            'loaded), leave contact_names empty, or use contact_source contact_array')
    return [
        _contact(f'poses[{i}]', pose, transform, name=names[i], finger=fingers[i],
                 model=defaults.model, friction=defaults.friction,
                 torsional_friction=defaults.torsional_friction,
                 max_normal_force=defaults.max_normal_force)
        for i, pose in enumerate(message.poses)]


def contacts_from_array(message, defaults, transform=None):
    """
    Read a grasp_quality_msgs/ContactArray.

    Parameters, result and errors are those of ``contacts_from_poses``.

    """
    contacts, seen = [], set()
    for i, item in enumerate(message.contacts):
        field = f'contacts[{i}]'
        name = item.name or f'contact_{i}'
        if name in seen:
            raise InvalidMessageError(f'{field}.name must be unique, got {name!r} twice')
        seen.add(name)
        contacts.append(_contact(
            field, item.pose, transform, name=name, finger=item.finger or name,
            model=_model(item.model, defaults, field),
            friction=_number(item, 'friction_coefficient', defaults.friction, field),
            torsional_friction=_number(
                item, 'torsional_friction_coefficient', defaults.torsional_friction, field),
            max_normal_force=_number(
                item, 'max_normal_force', defaults.max_normal_force, field)))
    return contacts


def _contact(field, pose, transform, **values):
    position, rotation = pose_arrays(pose, field if 'poses' in field else f'{field}.pose')
    if transform is not None:
        position, rotation = transform.R @ position + transform.p, transform.R @ rotation
    try:
        return Contact(position=position, rotation=rotation, **values)
    except InvalidContactError as exc:
        raise InvalidMessageError(f'{field}: {exc}') from exc


def _model(code, defaults, field):
    if code == ContactMsg.MODEL_DEFAULT:
        return defaults.model
    if code not in MODELS:
        raise InvalidMessageError(
            f'{field}.model must be one of 0 (default), 1 (FPC), 2 (PCWF), 3 (SFCE), got {code}')
    return MODELS[code]


def _number(item, name, default, field):
    value, = checked_numbers((getattr(item, name),), f'{field}.{name}')
    if value != 0.0 and value < SMALLEST:
        raise InvalidMessageError(
            f'{field}.{name} must be at least {SMALLEST:g}, or 0 for the default, got {value}')
    return value or default

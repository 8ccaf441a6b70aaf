# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured contact wrenches: WrenchStamped to the local force of one contact."""

from grasp_quality.arrays import Array
from grasp_quality.contact import Contact
from grasp_quality.wrench import cross
from msg_adapters.errors import InvalidMessageError
from msg_adapters.message_types import StampedWrench
from msg_adapters.wrenches import wrench_array
import numpy as np


def local_force(message: StampedWrench, contact: Contact, object_frame: str) -> Array:
    """
    Read the measured wrench of one contact, finger on object.

    Parameters
    ----------
    message : geometry_msgs.msg.WrenchStamped
        In the contact frame (frame_id = the contact's name), about the contact point; or in the
        object frame, about its origin.
    contact : Contact
        Contact in the object frame whose name the topic carries.
    object_frame : str
        Name of the object frame.

    Returns
    -------
    (4,) array [N, N, N, N m]: t1, t2, n, m_n

    Raises
    ------
    InvalidMessageError

    """
    field = f'contact_wrenches/{contact.name}'
    wrench = wrench_array(message.wrench, f'{field}: wrench')
    frame = message.header.frame_id
    if frame == contact.name:
        return wrench[[0, 1, 2, 5]]
    if frame == object_frame:
        force, torque = wrench[:3], wrench[3:] - cross(contact.position, wrench[:3])
        return np.append(contact.rotation.T @ force, contact.normal @ torque)
    raise InvalidMessageError(
        f'{field}: header.frame_id must be the contact frame {contact.name!r} or the object frame '
        f'{object_frame!r}, got {frame!r}')

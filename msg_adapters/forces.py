# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact forces: core solutions to messages, finger on object."""

from geometry_msgs.msg import WrenchStamped
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
from msg_adapters.wrenches import fill_xyz, to_wrench
import numpy as np
from std_msgs.msg import Header


def force_array(header, grasp=None, forces=(), cone_usage=()):
    """
    Build a ContactForceArray in the object frame.

    Parameters
    ----------
    header : std_msgs.msg.Header
        Object frame, and the stamp of the contacts that the forces belong to.
    grasp : Grasp
        Only needed when there are forces.
    forces : (k, 4) or (0, 4) array [N, N, N, N m]
        In the contact frames.
    cone_usage : (k,) array
        Share of each friction cone in use.

    """
    message = ContactForceArray(header=header)
    if len(forces):
        in_object = np.einsum('kij,kj->ki', grasp.rotations, forces[:, :3])
        moments = grasp.rotations[:, :, 2] * forces[:, 3:]
        wrenches = np.concatenate([in_object, moments], axis=1)
        rows = zip(grasp.names, grasp.positions.tolist(), grasp.rotations[:, :, 2].tolist(),
                   wrenches.tolist(), cone_usage.tolist())
        message.forces = [_contact_force(*row) for row in rows]
    return message


def _contact_force(name, position, normal, wrench, usage):
    message = ContactForce()
    message.name, message.cone_usage = name, usage
    fill_xyz(message.position, position)
    fill_xyz(message.normal, normal)
    to_wrench(wrench, message.wrench)
    return message


def contact_frame_wrench(stamp, name, force=(0.0, 0.0, 0.0, 0.0)):
    """
    Build a WrenchStamped in a contact's own frame from its local force (4,).

    frame_id is the contact's name; a zero wrench tells that there is no answer.

    """
    t1, t2, n, m_n = force
    message = WrenchStamped(header=Header(stamp=stamp, frame_id=name))
    to_wrench((t1, t2, n, 0.0, 0.0, m_n), message.wrench)
    return message

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact forces: core solutions to messages, finger on object."""

import numpy as np
from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
from std_msgs.msg import Header

from grasp_quality_msgs.msg import ContactForce, ContactForceArray
from msg_adapters.wrenches import to_point, to_vector, to_wrench


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

    """
    message = ContactForceArray(header=header)
    if len(forces):
        in_object = np.einsum('kij,kj->ki', grasp.rotations, forces[:, :3])
        moments = grasp.rotations[:, :, 2] * forces[:, 3:]
        wrenches = np.concatenate([in_object, moments], axis=1)
        message.forces = [
            ContactForce(name=name, position=to_point(contact.position),
                         normal=to_vector(contact.normal), wrench=to_wrench(wrench),
                         cone_usage=float(usage))
            for name, contact, wrench, usage in zip(
                grasp.names, grasp.contacts, wrenches, cone_usage)]
    return message


def contact_frame_wrench(stamp, name, force=(0.0, 0.0, 0.0, 0.0)):
    """
    Build a WrenchStamped in a contact's own frame from its local force (4,).

    frame_id is the contact's name; a zero wrench tells that there is no answer.

    """
    t1, t2, n, m_n = (float(v) for v in force)
    return WrenchStamped(
        header=Header(stamp=stamp, frame_id=name),
        wrench=Wrench(force=Vector3(x=t1, y=t2, z=n), torque=Vector3(x=0.0, y=0.0, z=m_n)))

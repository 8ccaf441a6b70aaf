# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact forces: core solutions to messages, finger on object."""

from collections.abc import Sequence
from typing import cast

from builtin_interfaces.msg import Time
from geometry_msgs.msg import WrenchStamped
from grasp_quality.arrays import Array
from grasp_quality.grasp import Grasp
from grasp_quality.solution import NO_FORCES, NO_USAGE
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
from msg_adapters.wrenches import fill_xyz, to_wrench
import numpy as np
from std_msgs.msg import Header


def force_array(header: Header, grasp: Grasp | None = None, forces: Array = NO_FORCES,
                cone_usage: Array = NO_USAGE) -> ContactForceArray:
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
        grasp = cast(Grasp, grasp)
        in_object = np.einsum('kij,kj->ki', grasp.rotations, forces[:, :3])
        moments = grasp.rotations[:, :, 2] * forces[:, 3:]
        wrenches = np.concatenate([in_object, moments], axis=1)
        rows = zip(grasp.names, grasp.positions.tolist(), grasp.rotations[:, :, 2].tolist(),
                   wrenches.tolist(), cone_usage.tolist())
        message.forces = [_contact_force(*row) for row in rows]
    return message


def _contact_force(name: str, position: list[float], normal: list[float], wrench: list[float],
                   usage: float) -> ContactForce:
    message = ContactForce()
    message.name, message.cone_usage = name, usage
    fill_xyz(message.position, position)
    fill_xyz(message.normal, normal)
    to_wrench(wrench, message.wrench)
    return message


def contact_frame_wrench(stamp: Time, name: str,
                         force: Sequence[float] | Array = (0.0, 0.0, 0.0, 0.0)) -> WrenchStamped:
    """
    Build a WrenchStamped in a contact's own frame from its local force (4,).

    frame_id is the contact's name; a zero wrench tells that there is no answer.

    """
    t1, t2, n, m_n = force
    message = WrenchStamped(header=Header(stamp=stamp, frame_id=name))
    to_wrench((t1, t2, n, 0.0, 0.0, m_n), message.wrench)
    return message

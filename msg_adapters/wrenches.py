# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches, points and vectors: message parts to and from arrays, force before torque, SI."""

import numpy as np
from geometry_msgs.msg import Point, Vector3, Wrench

from msg_adapters.number_checks import checked_numbers


def wrench_array(message, name):
    """
    Read a geometry_msgs/Wrench.

    Parameters
    ----------
    message : geometry_msgs.msg.Wrench
    name : str
        Field name, for the error.

    Returns
    -------
    (6,) array [N, N m]: fx fy fz tx ty tz

    Raises
    ------
    InvalidMessageError
        When a component is not finite, or too large.

    """
    force, torque = message.force, message.torque
    return np.array(checked_numbers(
        (force.x, force.y, force.z, torque.x, torque.y, torque.z), name))


def to_wrench(array):
    """Return a geometry_msgs/Wrench of fx fy fz tx ty tz (6,) [N, N m]."""
    fx, fy, fz, tx, ty, tz = (float(v) for v in array)
    return Wrench(force=Vector3(x=fx, y=fy, z=fz), torque=Vector3(x=tx, y=ty, z=tz))


def to_vector(array):
    """Return a geometry_msgs/Vector3 of (3,)."""
    x, y, z = (float(v) for v in array)
    return Vector3(x=x, y=y, z=z)


def to_point(array):
    """Return a geometry_msgs/Point of (3,) [m]."""
    x, y, z = (float(v) for v in array)
    return Point(x=x, y=y, z=z)

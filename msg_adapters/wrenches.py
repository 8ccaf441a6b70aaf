# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches, points and vectors: message parts to and from arrays, force before torque, SI."""

from collections.abc import Iterable
from typing import Any

from grasp_quality.arrays import Array
from msg_adapters.message_types import Wrench, Xyz
from msg_adapters.number_checks import checked_numbers, SMALLEST
import numpy as np


def wrench_array(message: Wrench, name: str) -> Array:
    """
    Read a geometry_msgs/Wrench.

    Parameters
    ----------
    message : geometry_msgs.msg.Wrench
        Force [N] and torque [N m].
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


def is_zero(wrench: Array) -> bool:
    """Whether a wrench (6,) [N, N m] is too small to be one."""
    return not np.abs(wrench).max() >= SMALLEST


def to_wrench(array: Iterable[float], message: Any = None) -> Any:
    """Return a geometry_msgs/Wrench of fx fy fz tx ty tz (6,) [N, N m]; fill message if given."""
    # filling a default message in place takes half the time of giving it new parts
    message = _new_wrench() if message is None else message
    fx, fy, fz, tx, ty, tz = map(float, array)
    force, torque = message.force, message.torque
    force.x, force.y, force.z = fx, fy, fz
    torque.x, torque.y, torque.z = tx, ty, tz
    return message


def _new_wrench() -> Any:
    from geometry_msgs.msg import Wrench
    return Wrench()


def fill_xyz(message: Xyz, array: Iterable[float]) -> None:
    """Write (3,) into a Point or Vector3."""
    message.x, message.y, message.z = map(float, array)

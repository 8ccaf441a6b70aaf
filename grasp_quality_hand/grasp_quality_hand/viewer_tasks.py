# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""From the positions of the page's sliders to the request that sets the node's task."""

from dataclasses import dataclass

from grasp_quality_msgs.srv import SetTask
from msg_adapters.wrenches import to_wrench
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

WRENCH, CONE, POLYTOPE = 'one direction', 'cone', 'polytope'
KINDS = (WRENCH, CONE, POLYTOPE)
FORCE, TORQUE = 'force', 'torque'
AROUND = 'task, swayed to 4 sides'  # by half its size
AXES = 'all 6 axis directions'
SIDES = '4 sides of the task'
PRESETS = (AROUND, AXES, SIDES)


@dataclass(frozen=True)
class TaskChoice:
    """
    What the controls stand at.

    Attributes
    ----------
    kind : str
        One of KINDS.
    quantity : str
        FORCE or TORQUE.
    azimuth_deg, elevation_deg : float
        Direction in the object frame [degrees], azimuth from +x to +y, elevation towards +z.
    size : float
        Of the task [N or N m].
    half_angle_deg : float
        Of the cone [degrees], below 90.
    preset : str
        One of PRESETS: the wrenches of a polytope.
    load : tuple of 3 or 6 float
        External force, and torque about its origin if any [N, N m], object frame.

    """

    kind: str = WRENCH
    quantity: str = FORCE
    azimuth_deg: float = 0.0
    elevation_deg: float = 90.0
    size: float = 1.0
    half_angle_deg: float = 20.0
    preset: str = AROUND
    load: tuple[float, ...] = (0.0, 0.0, 0.0)


def direction(azimuth_deg: float, elevation_deg: float) -> Array:
    """Return the unit vector (3,) of a direction."""
    azimuth, elevation = np.deg2rad(azimuth_deg), np.deg2rad(elevation_deg)
    return np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                     np.sin(elevation)])


def angles(vector: Array) -> tuple[float, float]:
    """Return azimuth and elevation [degrees] of a vector (3,) that is not zero."""
    x, y, z = vector / np.linalg.norm(vector)
    return float(np.rad2deg(np.arctan2(y, x))), float(np.rad2deg(np.arcsin(np.clip(z, -1, 1))))


def sideways(along: Array) -> tuple[Array, Array]:
    """Return two unit vectors (3,) perpendicular to a unit vector and to each other."""
    axis = np.eye(3)[np.argmin(np.abs(along))]
    first = axis - along * (along @ axis)
    first /= np.linalg.norm(first)
    return first, np.cross(along, first)


def set_task_request(choice: TaskChoice) -> SetTask.Request:
    """Build the request that makes the live loop evaluate a choice."""
    along = direction(choice.azimuth_deg, choice.elevation_deg)
    first, second = sideways(along)

    def wrench(vector: Array) -> Array:
        part = choice.size * vector
        zero = np.zeros(3)
        return np.concatenate([part, zero] if choice.quantity == FORCE else [zero, part])

    request = SetTask.Request(external_wrench=to_wrench((*choice.load, 0.0, 0.0, 0.0)[:6]))
    if choice.kind == WRENCH:
        request.kind = SetTask.Request.WRENCH
        request.task_wrench = to_wrench(wrench(along))
    elif choice.kind == CONE:
        request.kind = SetTask.Request.CONE
        request.axis = to_wrench(wrench(along))
        request.lateral_x, request.lateral_y = to_wrench(wrench(first)), to_wrench(wrench(second))
        request.half_angle = float(np.deg2rad(choice.half_angle_deg))
    else:
        request.kind = SetTask.Request.POLYTOPE
        request.task_wrenches = [to_wrench(wrench(v)) for v in _corners(choice, along)]
    return request


def _corners(choice: TaskChoice, along: Array) -> list[Array]:
    first, second = sideways(along)
    sides = [first, -first, second, -second]
    if choice.preset == AROUND:
        return [along + 0.5 * side for side in sides]
    if choice.preset == AXES:
        return [*np.eye(3), *-np.eye(3)]
    return sides

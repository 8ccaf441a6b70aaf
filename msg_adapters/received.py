# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What a controller reads: forces and joint states, checked before they move a motor."""

from collections.abc import Collection
from typing import Any

from msg_adapters.errors import InvalidMessageError
from msg_adapters.number_checks import checked_numbers
from msg_adapters.wrenches import wrench_array
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def read_forces(message: Any) -> tuple[tuple[str, ...], Array, Array]:
    """
    Read a grasp_quality_msgs/ContactForceArray.

    Returns
    -------
    names of the contacts; (k, 3) array of points [m]; (k, 6) array of forces and moments of the
    finger on the object about these points [N, N m]; all in the header frame. Empty for no answer.

    Raises
    ------
    InvalidMessageError

    """
    names, points, wrenches = [], [], []
    for i, item in enumerate(message.forces):
        position = item.position
        points.append(checked_numbers(
            (position.x, position.y, position.z), f'forces[{i}].position'))
        wrenches.append(wrench_array(item.wrench, f'forces[{i}].wrench'))
        names.append(str(item.name))
    if len(set(names)) < len(names):
        raise InvalidMessageError(f'forces must have unique names, got {names}')
    return (tuple(names), np.array(points).reshape(-1, 3), np.array(wrenches).reshape(-1, 6))


def read_joint_state(
        message: Any, joints: Collection[str] | None = None,
        driven: Collection[str] | None = None,
        ) -> tuple[dict[str, float], dict[str, float], dict[str, float]]:
    """
    Read a sensor_msgs/JointState.

    Where ``joints`` are given, of these only, and rates and efforts only of those that are
    ``driven``, too: others may stand beside them, with NaN for what they do not measure.

    Returns
    -------
    positions [rad, m], rates [rad/s, m/s] and efforts [N m, N] by joint; the last two are empty
    where the message has none

    Raises
    ------
    InvalidMessageError
        A length does not fit the names, or a number that is read is not finite.

    """
    all_names = [str(name) for name in message.name]
    kept = [i for i, name in enumerate(all_names) if joints is None or name in joints]
    names = [all_names[i] for i in kept]
    if len(set(names)) < len(names):
        raise InvalidMessageError(f'name must be unique, got {names}')

    def numbers(field: str, among: Collection[str]) -> dict[str, float]:
        values = getattr(message, field)
        if len(values) not in (0, len(all_names)):
            raise InvalidMessageError(
                f'{field} must hold one number for each of the {len(all_names)} names, got '
                f'{len(values)}')
        if not len(values):
            return {}
        read = {all_names[i]: values[i] for i in kept if all_names[i] in among}
        return dict(zip(read, checked_numbers(read.values(), field)))

    positions = numbers('position', names)
    if len(positions) < len(names):
        raise InvalidMessageError(f'position must hold one number for each of {names}, got none')
    of_driven = names if driven is None else driven
    return positions, numbers('velocity', of_driven), numbers('effort', of_driven)

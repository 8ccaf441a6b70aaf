# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Joint limits: the Jacobian columns of a ContactArray to torques of local contact forces."""

from typing import Any

from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import InvalidGraspError
from grasp_quality.joint_limits import JointLimits
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
from msg_adapters.number_checks import checked_numbers, SMALLEST
import numpy as np


def joint_limits_from(message: Any, contacts: ContactSet, transform: Transform | None = None,
                      max_size: int | None = None) -> JointLimits | None:
    """
    Read the joint limits of a grasp_quality_msgs/ContactArray.

    Parameters
    ----------
    message : grasp_quality_msgs.msg.ContactArray
        Twists stand in the axes of its header frame.
    contacts : ContactSet
        Its contacts, in the object frame.
    transform : Transform, optional
        From the header frame into the object frame.
    max_size : int, optional
        Largest number of twists.

    Returns
    -------
    JointLimits, or None when the message has none

    Raises
    ------
    InvalidMessageError

    """
    items = list(getattr(message, 'joint_limits', ()))  # recordings before there were any
    if not items:
        return None
    count = len(contacts)
    if max_size is not None and len(items) * count > max_size:
        raise InvalidMessageError(
            f'joint_limits must hold at most {max_size} twists (parameter max_request_size), got '
            f'{len(items)} joints of {count} contacts')
    jacobians = np.zeros((len(items), count, 6))
    axes = contacts.rotations if transform is None else transform.R.T @ contacts.rotations
    for j, item in enumerate(items):
        field = f'joint_limits[{j}]'
        if len(item.twists) != count:
            raise InvalidMessageError(
                f'{field}.twists must hold one twist for each of the {count} contacts, got '
                f'{len(item.twists)}')
        for i, twist in enumerate(item.twists):
            linear, angular = twist.linear, twist.angular
            jacobians[j, i] = checked_numbers(
                (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z),
                f'{field}.twists[{i}]')
    pairs = [checked_numbers((item.max_torque, item.gravity_torque), f'joint_limits[{j}]')
             for j, item in enumerate(items)]
    weak = [j for j, (limit, _) in enumerate(pairs) if limit < SMALLEST]
    if weak:
        raise InvalidMessageError(
            f'joint_limits[{weak[0]}].max_torque must be at least {SMALLEST:g}, got '
            f'{pairs[weak[0]][0]:g}: leave out a joint without a limit')
    try:
        return JointLimits.of_jacobians(
            [item.name for item in items], [limit for limit, _ in pairs], jacobians, axes,
            [gravity for _, gravity in pairs])
    except InvalidGraspError as exc:
        raise InvalidMessageError(f'joint_limits: {exc}') from exc

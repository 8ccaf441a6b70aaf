# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of force_to_effort, all read at the start, and the bridge that they make."""

from pathlib import Path
from typing import Any

from grasp_quality_hand.effort_bridge import EffortBridge
from grasp_quality_hand.effort_command import EffortCommand, Holding
from grasp_quality_hand.hand_kinematics import BadHand, EARTH, HandKinematics
import numpy as np
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.exceptions import ParameterUninitializedException
from rclpy.node import Node
from rclpy.parameter import Parameter

# name: (default or type of a list, description, range)
TABLE: dict[str, tuple[Any, str, tuple[float, float] | None]] = {
    'robot_description': ('', 'URDF of the hand, as text', None),
    'robot_description_file': ('', 'File of the URDF, where robot_description is empty', None),
    'base_frame': ('', "Link that forces or poses of the object are given in; empty: the URDF's "
                   'root', None),
    'object_frame': ('object', 'Frame of the object, whose poses come on object_pose', None),
    'joints': (Parameter.Type.STRING_ARRAY, "Joints in the order of the controller's joints",
               None),
    'contact_names': (Parameter.Type.STRING_ARRAY, 'Contacts that may have forces', None),
    'contact_links': (Parameter.Type.STRING_ARRAY, 'Link that makes each of contact_names', None),
    'rate': (200.0, 'Rate of the commands [Hz]', (1.0, 1000.0)),
    'gravity_compensation': (True, "Whether the efforts carry the hand's own links", None),
    'gravity': (list(EARTH), "Gravity in the frame of the URDF's root [m/s^2]", None),
    'max_effort_rate': (50.0, 'Slew limit of every joint while following, and of '
                        'stiffness and damping in a hold [N m/s]', (1e-3, 1e6)),
    'max_force_age': (0.1, 'Age of the contacts behind the forces [s] from which to hold',
                      (1e-3, 10.0)),
    'max_joint_age': (0.1, 'Age of joint states [s] from which to hold', (1e-3, 10.0)),
    'max_pose_age': (0.1, 'Age of the pose of the object [s] from which to hold', (1e-3, 10.0)),
    'ramp_time': (0.2, 'From the last efforts to the holding ones [s]', (0.0, 10.0)),
    'holding_efforts': (Parameter.Type.DOUBLE_ARRAY, 'Efforts to hold with, one a joint [N m]; '
                        'not set: the mean of those that followed good forces last', None),
    'holding_stiffness': (0.0, 'Of the posture at which a hold begins [N m/rad]', (0.0, 1e4)),
    'holding_damping': (0.0, 'Of the joints in a hold [N m s/rad]', (0.0, 1e4))}


def declare(node: Node) -> dict[str, Any]:
    """Declare all parameters, read-only; return their values, None for a list that is not set."""
    values: dict[str, Any] = {}
    for name, (default, description, limits) in TABLE.items():
        descriptor = ParameterDescriptor(description=description, read_only=True)
        if limits is not None:
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=limits[0], to_value=limits[1])]
        node.declare_parameter(name, default, descriptor)
        try:
            values[name] = node.get_parameter(name).value
        except ParameterUninitializedException:
            values[name] = None
    return values


def make_bridge(values: dict[str, Any]) -> tuple[EffortBridge, HandKinematics]:
    """
    Make the bridge that parameters describe.

    Raises
    ------
    BadHand
        A parameter breaks a rule.

    """
    names, links = list(values['contact_names'] or ()), list(values['contact_links'] or ())
    if not names or len(names) != len(links) or len(set(names)) < len(names):
        raise BadHand(f'contact_names must be unique and contact_links name one link for each, '
                      f'got {names} and {links}')
    gravity = np.array(values['gravity'], dtype=np.float64)
    if gravity.shape != (3,) or not np.isfinite(gravity).all():
        raise BadHand(f'gravity must be three finite numbers, got {values["gravity"]}')
    hand = HandKinematics(_urdf(values), list(values['joints'] or ()), values['base_frame'],
                          gravity.tolist())
    efforts = None
    if values['holding_efforts'] is not None:
        efforts = np.array(values['holding_efforts'], dtype=np.float64)
        if efforts.shape != hand.effort_limits.shape or not (
                np.abs(efforts) <= hand.effort_limits).all():
            raise BadHand(
                f'holding_efforts must hold one effort within the limits '
                f'{hand.effort_limits.tolist()} for each of {list(hand.joints)}, got '
                f'{efforts.tolist()}')
    command = EffortCommand(hand.effort_limits, values['max_effort_rate'], Holding(
        values['ramp_time'], efforts, values['holding_stiffness'], values['holding_damping']))
    return EffortBridge(
        hand, dict(zip(names, links)), command, values['max_force_age'], values['max_joint_age'],
        values['max_pose_age'], values['object_frame'], values['gravity_compensation'],
        1.0 / values['rate']), hand


def _urdf(values: dict[str, Any]) -> str:
    if values['robot_description']:
        return str(values['robot_description'])
    path = values['robot_description_file']
    if not path:
        raise BadHand('give the URDF of the hand: parameter robot_description or '
                      'robot_description_file')
    try:
        return Path(path).expanduser().read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise BadHand(f'robot_description_file {path!r} cannot be read: {error}') from None

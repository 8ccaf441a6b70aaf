# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameters of the node: one table of descriptors.

A new parameter is a row of ``TABLE`` and a field of ``node_settings.Settings``, where rules
between parameters stand. Values are checked in the on-set callback and swapped in the
post-set callback, so that a rejected set changes nothing. Bags are replayed with the same Settings
and without ROS, which is why only the functions that talk to a node import it.
"""

from collections.abc import Iterable
from dataclasses import fields
import difflib
import enum
from typing import Any

from grasp_quality.node_settings import LEAST_AGE_S, Settings
from grasp_quality.uncertainty import LARGEST_POSITION, LARGEST_TILT

LARGE = 1e6
LARGEST_AGE_S = 3600.0
NEAR = 0.85  # likeness of a misspelt name


class Type(enum.IntEnum):
    """Types of parameters, by the numbers of rcl_interfaces/ParameterType."""

    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9


# name: (type, description with unit, range or None, read-only)
TABLE: dict[str, tuple[Type, str, tuple[float, float] | None, bool]] = {
    'object_frame': (Type.STRING, 'Frame of the object; empty: the frame the contacts come in',
                     None, False),
    'contact_source': (Type.STRING, 'Topic the contacts are taken from: pose_array '
                       '(~/contact_poses) or contact_array (~/contacts)', None, True),
    'contact_names': (Type.STRING_ARRAY, 'Names of the poses of a pose_array, in order; not set: '
                      'contact_0, contact_1, ...', None, True),
    'contact_fingers': (Type.STRING_ARRAY, 'Finger of each of contact_names, for the finger bound',
                        None, True),
    'contact_model': (Type.STRING, 'Contact model: FPC, PCWF or SFCE', None, False),
    'friction_coefficient': (Type.DOUBLE, 'Coulomb friction coefficient mu [-]', (0.0, 100.0),
                             False),
    'torsional_friction_coefficient': (Type.DOUBLE, 'Torsional friction coefficient gamma [m]',
                                       (0.0, 100.0), False),
    'max_normal_force': (Type.DOUBLE, 'Largest normal force of a contact [N], > 0', (0.0, LARGE),
                         False),
    'force_bound': (Type.STRING, 'Bound on the normal forces: linf, l1, l2 or finger', None,
                    False),
    'barrier_weight': (Type.DOUBLE, 'Weight eps of the friction margin, eq. (11), in the unit of '
                       'alpha', (0.0, LARGE), False),
    'alpha_reserve': (Type.DOUBLE, 'Share d of alpha given up for unique forces with margin that '
                      'do not jump [-]; 0: forces of the largest alpha', (0.0, 1.0), False),
    'force_rate_limit': (Type.DOUBLE, 'Largest change of the force of a contact on '
                         '~/contact_forces [N/s], a moment counted as m_n / gamma; 0: none; '
                         '~/holding_forces and services are not limited', (0.0, LARGE), False),
    'task_wrench': (Type.DOUBLE_ARRAY, 'Task of the live loop: fx fy fz [N] tx ty tz [N m] in the '
                    'object frame; not set: none until one is given', None, False),
    'min_contact_force': (Type.DOUBLE, 'Measured normal force [N] from which a contact counts as '
                          'loaded; 0: all count, measured or not', (0.0, LARGE), False),
    'wanted_margin': (Type.DOUBLE, 'Slip margin [-] that the changes on ~/margin restore',
                      (0.0, 0.99), False),
    'margin_warning': (Type.DOUBLE, 'Measured slip margin [-] below which /diagnostics warns; -1: '
                       'never', (-1.0, 1.0), False),
    'max_contact_age': (Type.DOUBLE, 'Age [s] beyond which contacts are stale',
                        (LEAST_AGE_S, LARGEST_AGE_S), False),
    'max_load_age': (Type.DOUBLE, 'Age [s] beyond which a load of ~/external_wrench is stale, a '
                     'failure as is none at all; one that set_task gave (not zero) does not age. '
                     '0: loads do not age, and none is no load', (0.0, LARGEST_AGE_S), False),
    'solver_time_limit': (Type.DOUBLE, 'Time limit of one request or evaluation [s], > 0',
                          (0.0, 3600.0), False),
    'max_request_size': (Type.INTEGER, 'Largest number of contacts, wrenches or directions of one '
                         'message or request', (1, 1_000_000), False),
    'map_directions': (Type.INTEGER, 'Directions of a wrench map that names none', (2, 1_000_000),
                       False),
    'marker_rate': (Type.DOUBLE, 'Most often that markers are published [Hz]', (0.1, 1000.0),
                    True),
    'marker_force_scale': (Type.DOUBLE, 'Length of a newton in the markers [m/N]; 0: chosen by '
                           'the size of the grasp', (0.0, LARGE), False),
    'display_time_share': (Type.DOUBLE, 'Share of the time that goes into the force map while '
                           'somebody watches it [-]', (1e-3, 1.0), False),
    'quantile_samples': (Type.INTEGER, 'Grasps drawn for alpha_quantile of the live loop; 0: it '
                         'is off', (0, 1_000_000), False),
    'quantile_level': (Type.DOUBLE, 'Level of the quantile of alpha: the share of grasps that may '
                       'apply less [-]', (0.0, 1.0), False),
    'contact_noise': (Type.DOUBLE, 'Standard deviation of every coordinate of the contact points '
                      '[m], for alpha_quantile', (0.0, LARGEST_POSITION), False),
    'normal_noise': (Type.DOUBLE, 'Standard deviation of the tilt of the contact normals about '
                     'each tangent [rad], for alpha_quantile', (0.0, LARGEST_TILT), False),
    'friction_noise': (Type.DOUBLE, 'Standard deviation of the friction coefficients [-], for '
                       'alpha_quantile', (0.0, 100.0), False),
    'load_noise': (Type.DOUBLE_ARRAY, 'Standard deviations of the external wrench fx fy fz [N] tx '
                   'ty tz [N m] in the object frame, for alpha_quantile; not set: none', None,
                   False),
    'autostart': (Type.BOOL, 'Configure and activate at start', None, True),
    'allow_unsecured': (Type.BOOL, 'Activate although security was asked for '
                        '(ROS_SECURITY_ENABLE) and may not be in force', None, True),
}


def declare(node: Any) -> Settings:
    """
    Declare all parameters on a node and return their checked values.

    Raises
    ------
    ValueError
        When an override breaks a rule.

    """
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
    from rclpy.parameter import Parameter
    for name, (kind, description, limits, read_only) in TABLE.items():
        descriptor = ParameterDescriptor(description=description, read_only=read_only)
        if limits is not None and kind is Type.DOUBLE:
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=limits[0], to_value=limits[1])]
        elif limits is not None:
            descriptor.integer_range = [IntegerRange(from_value=limits[0], to_value=limits[1])]
        default = getattr(Settings, name)
        # a list without elements has no type of its own: such a parameter starts not set
        node.declare_parameter(
            name, Parameter.Type(kind) if default == () else default, descriptor)
    return Settings(**{f.name: _value(node, f.name) for f in fields(Settings)})


def _value(node: Any, name: str) -> Any:
    from rclpy.exceptions import ParameterUninitializedException
    try:
        value = node.get_parameter(name).value
    except ParameterUninitializedException:
        return getattr(Settings, name)
    return tuple(value) if TABLE[name][0] >= Type.DOUBLE_ARRAY else value


def changed(settings: Settings, parameters: Iterable[Any]) -> Settings:
    """Return settings with a list of rclpy Parameters applied; those of others are passed over."""
    changes = {}
    for parameter in parameters:
        if parameter.name in TABLE:
            value = parameter.value
            is_array = TABLE[parameter.name][0] >= Type.DOUBLE_ARRAY
            changes[parameter.name] = tuple(value or ()) if is_array else value
    return Settings(**{**{f.name: getattr(settings, f.name) for f in fields(Settings)}, **changes})


def check(settings: Settings, parameters: Iterable[Any]) -> Any:
    """Answer an on-set callback: whether these parameters would be valid together."""
    from rcl_interfaces.msg import SetParametersResult
    try:
        changed(settings, parameters)
    except (ValueError, TypeError) as exc:
        return SetParametersResult(successful=False, reason=str(exc))
    return SetParametersResult(successful=True)


def unknown_overrides(node: Any) -> tuple[str, ...]:
    """
    Say which overrides look like a parameter misspelt, so that they change nothing.

    Others are passed over: a file for all nodes (``/**``) holds parameters of others too.
    """
    given = getattr(node, '_parameter_overrides', {})  # rclpy tells of them nowhere else
    near = {name: difflib.get_close_matches(name, TABLE, 1, NEAR) for name in sorted(given)
            if not node.has_parameter(name) and not name.startswith('qos_overrides.')}
    return tuple(f'there is no parameter {name!r}, its value changes nothing: {found[0]!r} may be '
                 'meant' for name, found in near.items() if found)

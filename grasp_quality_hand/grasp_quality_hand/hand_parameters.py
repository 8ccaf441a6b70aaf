# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of the simulated hand."""

from typing import Any, NamedTuple

from grasp_quality_hand.effort_input import COMMAND_TIMEOUT
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_model import DAMPING
from grasp_quality_hand.simulation import DCLAW, POINTS, SQUEEZE_FORCE
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult

FROM_NEXT_LOAD = ', from the next load_object on'


class _Parameter(NamedTuple):
    """One parameter: default, description, range of a number, choices of a name."""

    default: float | int | str
    description: str
    limits: tuple[float, float] | None = None
    choices: tuple[str, ...] = ()
    read_only: bool = False


PARAMETERS: dict[str, _Parameter] = {
    'hand': _Parameter(DCLAW, "D'Claw, or three ideal contact points", None, (DCLAW, POINTS),
                       True),
    'target_node': _Parameter('grasp_quality', 'node whose input topics get the contacts',
                              read_only=True),
    'effort_controller': _Parameter(
        'effort_controller', 'efforts are taken from <this>/commands, one for each joint in the '
        'order of /joint_states', read_only=True),
    'rate': _Parameter(100.0, 'rate of all topics [Hz]', (10.0, 500.0), read_only=True),
    'object': _Parameter('cube', 'what ~/load_object loads', None, tuple(OBJECTS)),
    'object_mass': _Parameter(0.0, f'[kg], 0 = as the object is{FROM_NEXT_LOAD}', (0.0, 5.0)),
    'object_friction': _Parameter(
        0.0, f'[-], 0 = as the object is; its torsional friction goes with it{FROM_NEXT_LOAD}',
        (0.0, 2.0)),
    'squeeze_force': _Parameter(SQUEEZE_FORCE, 'largest normal force of the squeeze [N]'
                                f'{FROM_NEXT_LOAD}', (0.1, 30.0)),
    'command_timeout': _Parameter(
        COMMAND_TIMEOUT, "age of an effort command [s] beyond which the hand's own controller "
        f'takes over{FROM_NEXT_LOAD}', (0.01, 10.0)),
    'joint_damping': _Parameter(
        DAMPING, "of D'Claw's motors [N m s/rad]; it brakes what slips, too"
        f'{FROM_NEXT_LOAD}', (0.0, 10.0)),
    'position_noise': _Parameter(0.0, 'standard deviation of contact positions [m]',
                                 (0.0, 0.01), read_only=True),
    'normal_noise': _Parameter(0.0, 'standard deviation of contact normals [rad]', (0.0, 0.5),
                               read_only=True),
    'force_noise': _Parameter(0.0, 'standard deviation of contact forces [N]', (0.0, 10.0),
                              read_only=True),
    'drop_rate': _Parameter(0.0, 'share of messages that get lost, in and out', (0.0, 1.0),
                            read_only=True),
    'delay': _Parameter(0.0, 'by which messages are late, in and out [s]', (0.0, 1.0),
                        read_only=True),
    'seed': _Parameter(0, 'of noise and losses', read_only=True),
}


def declare_parameters(node: Any) -> None:
    """Declare all parameters on a node, and refuse names that are not among the choices."""
    for name, parameter in PARAMETERS.items():
        limits = [] if parameter.limits is None else [
            FloatingPointRange(from_value=parameter.limits[0], to_value=parameter.limits[1])]
        choices = f': {", ".join(parameter.choices)}' if parameter.choices else ''
        node.declare_parameter(name, parameter.default, ParameterDescriptor(
            description=parameter.description + choices, floating_point_range=limits,
            read_only=parameter.read_only))
        if parameter.choices:
            _check(name, node.get_parameter(name).value)
    node.add_on_set_parameters_callback(_refuse_unknown)


def _check(name: str, value: Any) -> None:
    """Raise ValueError for a value that is not among the choices."""
    if value not in PARAMETERS[name].choices:
        raise ValueError(f'{name} {value!r} is not known: it must be one of '
                         f'{", ".join(PARAMETERS[name].choices)}')


def _refuse_unknown(parameters: list[Any]) -> SetParametersResult:
    """Refuse a value that is not among the choices."""
    try:
        for parameter in parameters:
            if PARAMETERS.get(parameter.name) and PARAMETERS[parameter.name].choices:
                _check(parameter.name, parameter.value)
    except ValueError as error:
        return SetParametersResult(successful=False, reason=str(error))
    return SetParametersResult(successful=True)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Tasks and loads: service requests and parameters to core tasks, in the object frame."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from grasp_quality.arrays import Array
from grasp_quality.task import TaskCone, TaskPolytope, TaskWrench
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
from msg_adapters.message_types import ConeFields, Framed, PolytopeFields, Wrench
from msg_adapters.number_checks import checked_numbers, SMALLEST
from msg_adapters.wrenches import is_zero, wrench_array
import numpy as np

WRENCH, CONE, POLYTOPE = 1, 2, 3  # these are the kinds of SetTask.srv


@dataclass(frozen=True)
class HeldTask:
    """
    A task wrench that is held like a SetTask request of kind WRENCH.

    Attributes
    ----------
    task_wrench : geometry_msgs.msg.Wrench
    header : std_msgs.msg.Header

    """

    task_wrench: Wrench
    header: Framed
    kind: int = WRENCH


@dataclass(frozen=True)
class HeldLoad:
    """An external wrench that is held, as a WrenchStamped."""

    wrench: Wrench
    header: Framed


@dataclass(frozen=True)
class NoFrame:
    """Header of what stands in the object frame."""

    frame_id: str = ''


def load_from(message: Wrench, transform: Transform | None,
              name: str = 'external_wrench') -> Array:
    """Read an external wrench (6,) [N, N m] in the object frame; all zero is no load."""
    return _moved(wrench_array(message, name), transform)


def wrench_task(message: Wrench, transform: Transform | None,
                name: str = 'task_wrench') -> TaskWrench:
    """Read a geometry_msgs/Wrench as a TaskWrench; it must not be zero."""
    return TaskWrench(_nonzero(wrench_array(message, name), transform, name))


def cone_task(message: ConeFields, transform: Transform | None, surface_samples: int) -> TaskCone:
    """Read axis, lateral_x, lateral_y and half_angle of a request as a TaskCone."""
    return TaskCone(
        _nonzero(wrench_array(message.axis, 'axis'), transform, 'axis'),
        _moved(wrench_array(message.lateral_x, 'lateral_x'), transform),
        _moved(wrench_array(message.lateral_y, 'lateral_y'), transform),
        float(message.half_angle), surface_samples)


def polytope_task(message: PolytopeFields, transform: Transform | None, limit: int,
                  parallelotope: bool = True) -> TaskPolytope:
    """Read task_wrenches and weights of a request as a TaskPolytope of at most limit wrenches."""
    wrenches = wrench_rows(message.task_wrenches, transform, limit, 'task_wrenches')
    if not len(wrenches):
        raise InvalidMessageError('task_wrenches must hold at least one wrench, got none')
    if len(message.weights) not in (0, len(wrenches)):
        raise InvalidMessageError(
            f'weights must be empty or hold one number for each of the {len(wrenches)} '
            f'task_wrenches, got {len(message.weights)}')
    weights = checked_numbers(message.weights, 'weights')
    return TaskPolytope(wrenches, weights or None, parallelotope)


def wrench_rows(messages: Sequence[Wrench], transform: Transform | None, limit: int,
                name: str) -> Array:
    """Read a list of wrenches (n, 6), none of them zero, n at most limit."""
    if len(messages) > limit:
        raise InvalidMessageError(
            f'{name} must hold at most {limit} wrenches (parameter max_request_size), '
            f'got {len(messages)}')
    return np.array([
        _nonzero(wrench_array(message, f'{name}[{i}]'), transform, f'{name}[{i}]')
        for i, message in enumerate(messages)]).reshape(-1, 6)


def live_task(request: Any, transform: Transform | None,
              limit: int) -> TaskWrench | TaskCone | TaskPolytope:
    """
    Read a SetTask request for the live loop.

    The loop publishes neither the cone's surface nor the parallelotope, so both are left out.

    """
    if request.kind == WRENCH:
        return wrench_task(request.task_wrench, transform)
    if request.kind == CONE:
        return cone_task(request, transform, surface_samples=0)
    if request.kind == POLYTOPE:
        return polytope_task(request, transform, limit, parallelotope=False)
    raise InvalidMessageError(
        f'kind must be 1 (WRENCH), 2 (CONE) or 3 (POLYTOPE), got {request.kind}')


def _moved(wrench: Array, transform: Transform | None) -> Array:
    return wrench if transform is None else transform.wrench(wrench)


def _nonzero(wrench: Array, transform: Transform | None, name: str) -> Array:
    if is_zero(wrench):
        raise InvalidMessageError(
            f'{name} must not be zero (below {SMALLEST:g}): it has no direction to scale')
    return _moved(wrench, transform)

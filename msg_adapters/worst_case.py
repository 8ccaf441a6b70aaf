# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The worst case: BallRadius requests to ellipsoids of wrenches, and the answer to messages."""

from __future__ import annotations

from grasp_quality.ball import BallRadius as Answer, WIDTH
from grasp_quality.status import Status
from grasp_quality.task import TaskEllipsoid
from grasp_quality_msgs.srv import BallRadius
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
from msg_adapters.number_checks import checked_numbers, SMALLEST
from msg_adapters.results import status_result
from msg_adapters.tasks import wrench_rows
from msg_adapters.wrenches import to_wrench, wrench_array
import numpy as np

TORQUE_LENGTH = 1.0  # [m], when the request leaves it open
ROWS = {BallRadius.Request.SUBSPACE_ALL: slice(0, 6),
        BallRadius.Request.SUBSPACE_FORCE: slice(0, 3),
        BallRadius.Request.SUBSPACE_TORQUE: slice(3, 6)}
NO_PROOF = 'the time limit came before the interval was as narrow as asked: it is proved, but wide'


def ellipsoid_from(request: BallRadius.Request, transform: Transform | None,
                   limit: int) -> TaskEllipsoid:
    """
    Read the ball or the ellipsoid of a request, in the object frame.

    Raises
    ------
    InvalidMessageError, InvalidTaskError

    """
    if wrench_array(request.external_wrench, 'external_wrench').any():
        raise InvalidMessageError(
            'external_wrench must be zero: the ball is around the wrench zero; to weigh a load, '
            'ask evaluate_task_wrench')
    if len(request.axes):
        return TaskEllipsoid(wrench_rows(request.axes, transform, limit, 'axes'))
    length, = checked_numbers([request.torque_length], 'torque_length')
    if length < 0.0:
        raise InvalidMessageError(f'torque_length [m] must be at least 0, got {length:g}')
    if 0.0 < length < SMALLEST:
        raise InvalidMessageError(
            f'torque_length [m] must be 0 (1 m then) or at least {SMALLEST:g}, got {length:g}')
    if request.subspace not in ROWS:
        raise InvalidMessageError(
            f'subspace must be one of {sorted(ROWS)} (SUBSPACE_*), got {request.subspace}')
    length = length or TORQUE_LENGTH
    axes = np.diag([1.0, 1.0, 1.0, length, length, length])[ROWS[request.subspace]]
    return TaskEllipsoid(axes if transform is None else [transform.wrench(axis) for axis in axes])


def width_from(request: BallRadius.Request) -> float:
    """Read the relative width that a request asks for."""
    width, = checked_numbers([request.relative_width], 'relative_width')
    return width or WIDTH


def fill_ball_radius(response: BallRadius.Response, answer: Answer) -> None:
    """Write an answer into a response."""
    response.result = status_result(Status.OPTIMAL)
    response.result.message = '' if answer.reached else NO_PROOF
    response.lower, response.upper = float(answer.lower), float(answer.upper)
    response.reached = answer.reached
    response.weakest_wrench = to_wrench(answer.weakest_wrench)
    response.limiting_contacts = list(answer.limiting_contacts)

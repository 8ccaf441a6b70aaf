# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Result codes: which outcome of the core, or which error, is told in which words."""

from grasp_quality.exceptions import GraspQualityError, SolverError, SolverTimeoutError
from grasp_quality.solution import Status
from grasp_quality_msgs.msg import ResultCode
from msg_adapters.errors import (
    NoContactsError, NotActiveError, StaleContactsError, TransformError)

CODES = (  # first match wins
    (NoContactsError, ResultCode.NO_CONTACTS),
    (StaleContactsError, ResultCode.STALE_CONTACTS),
    (NotActiveError, ResultCode.NOT_ACTIVE),
    (TransformError, ResultCode.TRANSFORM_FAILED),
    (SolverTimeoutError, ResultCode.TIMED_OUT),
    (SolverError, ResultCode.SOLVER_FAILED),
    (GraspQualityError, ResultCode.INVALID_REQUEST),
)

PINNED = ('alpha is pinned: the grasp cannot produce the task wrench at all, the external wrench '
          'alone decides alpha')


def error_result(error):
    """Build the ResultCode of an exception; one that nobody expected is SOLVER_FAILED."""
    for kind, code in CODES:
        if isinstance(error, kind):
            return ResultCode(code=code, message=str(error))
    return ResultCode(
        code=ResultCode.SOLVER_FAILED,
        message=f'internal error, please report it: {type(error).__name__}: {error}')


def status_result(status, detail='', pinned=False):
    """Build the ResultCode of an answer; detail says more where it is infeasible."""
    if status is Status.INFEASIBLE:
        return ResultCode(code=ResultCode.INFEASIBLE, message=detail or (
            'no contact forces inside the friction cones and the force bound balance the '
            'external wrench together with any share of the task'))
    if status is Status.OPTIMAL_NO_INTERIOR:
        return ResultCode(code=ResultCode.OPTIMAL, message=status.value)
    return ResultCode(code=ResultCode.OPTIMAL, message=PINNED if pinned else '')


def code_name(code):
    """Name of a result code, for logs and diagnostics."""
    return next((name for name in ('OPTIMAL', 'INFEASIBLE', 'NO_CONTACTS', 'STALE_CONTACTS',
                                   'INVALID_REQUEST', 'TRANSFORM_FAILED', 'SOLVER_FAILED',
                                   'TIMED_OUT', 'NOT_ACTIVE', 'UNDEFINED')
                 if getattr(ResultCode, name) == code), str(code))

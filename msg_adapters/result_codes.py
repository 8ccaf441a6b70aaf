# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Result codes as plain numbers: which outcome of the core, or which error, is told how."""

import enum

from grasp_quality.exceptions import GraspQualityError, SolverError, SolverTimeoutError
from grasp_quality.status import Status
from msg_adapters.errors import (
    NoContactsError, NotActiveError, StaleContactsError, TransformError)


class Code(enum.IntEnum):
    """The constants of ResultCode.msg."""

    UNDEFINED = 0
    OPTIMAL = 1
    INFEASIBLE = 2
    NO_CONTACTS = -1
    STALE_CONTACTS = -2
    INVALID_REQUEST = -3
    TRANSFORM_FAILED = -4
    SOLVER_FAILED = -5
    TIMED_OUT = -6
    NOT_ACTIVE = -7


CODES = (  # first match wins
    (NoContactsError, Code.NO_CONTACTS),
    (StaleContactsError, Code.STALE_CONTACTS),
    (NotActiveError, Code.NOT_ACTIVE),
    (TransformError, Code.TRANSFORM_FAILED),
    (SolverTimeoutError, Code.TIMED_OUT),
    (SolverError, Code.SOLVER_FAILED),
    (GraspQualityError, Code.INVALID_REQUEST),
)
NO_FORCES = (
    'no contact forces inside the friction cones and the force bound balance the external wrench '
    'together with any share of the task')


def error_code(error: BaseException) -> tuple[Code, str]:
    """Return the Code and the words of an exception; one nobody expected is SOLVER_FAILED."""
    for kind, code in CODES:
        if isinstance(error, kind):
            return code, str(error)
    return (Code.SOLVER_FAILED,
            f'internal error, please report it: {type(error).__name__}: {error}')


def status_code(status: Status, detail: str = '', remark: str = '') -> tuple[Code, str]:
    """Return the Code and the words of an answer: detail where it is infeasible, else remark."""
    if status is Status.INFEASIBLE:
        return Code.INFEASIBLE, detail or NO_FORCES
    if status is Status.OPTIMAL_NO_INTERIOR:
        return Code.OPTIMAL, '; '.join(filter(None, [status.value, remark]))
    if status is Status.OPTIMAL:
        return Code.OPTIMAL, remark
    return Code.SOLVER_FAILED, f'internal error, please report it: unknown status {status!r}'

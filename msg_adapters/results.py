# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Result codes: the ResultCode messages of outcomes and errors."""

from grasp_quality.status import Status
from grasp_quality_msgs.msg import ResultCode
from msg_adapters.result_codes import Code, error_code, status_code


def error_result(error: BaseException) -> ResultCode:
    """Build the ResultCode of an exception; one that nobody expected is SOLVER_FAILED."""
    code, words = error_code(error)
    return ResultCode(code=int(code), message=words)


def status_result(status: Status, detail: str = '', remark: str = '') -> ResultCode:
    """Build the ResultCode of an answer; detail is told where it is infeasible, else remark."""
    code, words = status_code(status, detail, remark)
    return ResultCode(code=int(code), message=words)


def code_name(code: int) -> str:
    """Name of a result code, for logs and diagnostics."""
    return Code(code).name if code in list(Code) else str(code)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Result codes: one for every kind of outcome, and success only where there is an answer."""

from grasp_quality import (
    GraspQualityError, InvalidContactError, InvalidGraspError, InvalidTaskError, SolverError,
    SolverTimeoutError, Status)
from grasp_quality.remarks import remark
from grasp_quality_msgs.msg import ResultCode
from msg_adapters import errors
from msg_adapters.result_codes import Code, status_code
from msg_adapters.results import code_name, error_result, status_result
import pytest


@pytest.mark.parametrize('kind, code', [
    (errors.NoContactsError, ResultCode.NO_CONTACTS),
    (errors.StaleContactsError, ResultCode.STALE_CONTACTS),
    (errors.InvalidMessageError, ResultCode.INVALID_REQUEST),
    (errors.TransformError, ResultCode.TRANSFORM_FAILED),
    (errors.NotActiveError, ResultCode.NOT_ACTIVE),
    (InvalidContactError, ResultCode.INVALID_REQUEST),
    (InvalidGraspError, ResultCode.INVALID_REQUEST),
    (InvalidTaskError, ResultCode.INVALID_REQUEST),
    (SolverError, ResultCode.SOLVER_FAILED),
    (SolverTimeoutError, ResultCode.TIMED_OUT)])
def test_every_error_has_its_code_and_keeps_its_words(kind, code):
    result = error_result(kind('why, and the way out'))
    assert (result.code, result.message) == (code, 'why, and the way out')
    assert issubclass(kind, GraspQualityError)


def test_an_unexpected_error_is_a_failure_that_says_its_type():
    result = error_result(ZeroDivisionError('division by zero'))
    assert result.code == ResultCode.SOLVER_FAILED
    assert 'please report' in result.message and 'ZeroDivisionError' in result.message


def test_optimal_needs_no_words_but_where_margin_is_missing():
    assert status_result(Status.OPTIMAL) == ResultCode(code=ResultCode.OPTIMAL)
    flat = status_result(Status.OPTIMAL_NO_INTERIOR)
    assert flat.code == ResultCode.OPTIMAL and 'margin' in flat.message


def test_a_remark_is_told_with_the_answer():
    pinned = status_result(Status.OPTIMAL, remark=remark(pinned=True, powerless=False))
    assert pinned.code == ResultCode.OPTIMAL and pinned.message.startswith('alpha is pinned')
    flat = status_result(Status.OPTIMAL_NO_INTERIOR, remark='and more')
    assert 'margin' in flat.message and flat.message.endswith('; and more')
    assert status_result(Status.INFEASIBLE, 'why', 'no answer').message == 'why'
    assert status_code(Status.OPTIMAL) == (Code.OPTIMAL, '')


def test_what_is_no_known_status_is_no_success():
    code, words = status_code(None)
    assert code is Code.SOLVER_FAILED and 'please report it: unknown status None' in words


def test_infeasible_is_explained():
    assert status_result(Status.INFEASIBLE).code == ResultCode.INFEASIBLE
    assert 'balance' in status_result(Status.INFEASIBLE).message
    assert 'balance' in status_code(Status.INFEASIBLE)[1]
    assert status_result(Status.INFEASIBLE, 'needs 3 times the caps').message == (
        'needs 3 times the caps')


def test_a_message_that_nobody_filled_in_is_no_success():
    assert ResultCode().code == ResultCode.UNDEFINED != ResultCode.OPTIMAL


@pytest.mark.parametrize('name', [
    'UNDEFINED', 'OPTIMAL', 'INFEASIBLE', 'NO_CONTACTS', 'STALE_CONTACTS', 'INVALID_REQUEST',
    'TRANSFORM_FAILED', 'SOLVER_FAILED', 'TIMED_OUT', 'NOT_ACTIVE'])
def test_codes_have_names(name):
    assert code_name(getattr(ResultCode, name)) == name


def test_an_unknown_code_is_told_by_number():
    assert code_name(42) == '42'

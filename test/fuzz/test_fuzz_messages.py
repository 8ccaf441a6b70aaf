# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Spoilt messages through the node's own code; the long form is ``make fuzz``."""

import copy
import math
from pathlib import Path

from benchmarks.fuzz.asking import Asker
from benchmarks.fuzz.cases import case_of, read, write
from benchmarks.fuzz.crosschecks import crosscheck, Verdict
from benchmarks.fuzz.fields import to_plain
from benchmarks.fuzz.judging import ANSWERED, CODES, judge, result_of
from benchmarks.fuzz.runs import replay, run, settings_of
from grasp_quality_msgs.msg import ResultCode
import pytest

CORPUS = sorted((Path(__file__).parent / 'corpus').glob('*.json'))
QUESTIONS = 2_500


def test_no_spoilt_question_gets_a_wrong_answer():
    tally = run(range(QUESTIONS), check_every=150)
    assert not tally.violations
    assert tally.questions == QUESTIONS and tally.messages > QUESTIONS
    assert tally.solved > 0.5 * QUESTIONS and tally.on_wire > 0
    assert set(tally.codes) <= set(CODES.values())
    assert tally.checks[Verdict.AGREES.value] > 0


@pytest.mark.parametrize('path', CORPUS, ids=lambda path: path.stem)
def test_a_past_failure_stays_repaired(path):
    assert not replay(path), read(path).rule


def test_a_case_is_the_same_from_its_file(tmp_path):
    for seed in range(60):
        case = case_of(seed)
        write(case, tmp_path / 'case.json')
        again = read(tmp_path / 'case.json')
        assert (again.kind, again.settings, again.on_wire) == (
            case.kind, case.settings, case.on_wire)
        assert {name: repr(to_plain(message)) for name, message in again.messages.items()} == {
            name: repr(to_plain(message)) for name, message in case.messages.items()}


@pytest.fixture(scope='module')
def asked():
    """Return a function that finds a question with a code, and its true answer."""
    asker = Asker()

    def find(kind, code, fits=lambda case, answer: True):
        for seed in range(2_000):
            case = case_of(seed)
            if case.kind == kind:
                answer = asker.ask(case, settings_of(case), False)
                if result_of(case, answer).code == code and fits(case, answer):
                    assert not judge(case, settings_of(case), answer)
                    return case, copy.deepcopy(answer)
        raise AssertionError(f'no {kind} with {code}')
    return find


def loaded(case, answer):
    """Whether there is an alpha, by forces of ordinary size, and nothing between it and lambda."""
    return answer.response.alpha > 1e-2 and not case.messages['request'].contacts.joint_limits \
        and settings_of(case).barrier_weight == settings_of(case).alpha_reserve == 0.0


@pytest.mark.parametrize('spoil, words', [
    (lambda r: setattr(r, 'alpha', 1.001 * r.alpha), 'alpha'),
    (lambda r: setattr(r, 'alpha', 0.999 * r.alpha), 'missing to alpha task'),
    (lambda r: setattr(r, 'alpha_upper', 1.01 * r.alpha_upper), 'bounds it'),
    (lambda r: setattr(r, 'alpha', math.nan), 'no number'),
    (lambda r: setattr(r.forces.forces[0].wrench.force, 'x', -1e9), 'forces'),
    (lambda r: r.forces.forces.pop(), 'only'),
    (lambda r: setattr(r.result, 'code', ResultCode.INFEASIBLE), 'and yet'),
    (lambda r: setattr(r.result, 'code', ResultCode.INVALID_REQUEST), 'without a reason'),
    (lambda r: setattr(r.result, 'code', ResultCode.UNDEFINED), 'the code is 0')])
def test_the_judge_sees_a_lie(asked, spoil, words):
    case, answer = asked('evaluate_task_wrench', ResultCode.OPTIMAL, loaded)
    spoil(answer.response)
    assert any(words in text for text in judge(case, settings_of(case), answer))


def test_the_judge_sees_a_multiplier_that_proves_nothing(asked):
    case, answer = asked('evaluate_task_wrench', ResultCode.OPTIMAL, loaded)
    force = answer.response.dalpha_dexternal_wrench.force
    force.x, force.y, force.z = force.y + 1.0, force.z, force.x
    assert any('multiplier' in text for text in judge(case, settings_of(case), answer))


def test_another_solver_sees_a_wrong_status(asked):
    case, answer = asked('evaluate_task_wrench', ResultCode.OPTIMAL, loaded)
    assert crosscheck(case, settings_of(case), answer)[0] is Verdict.AGREES
    wrong = copy.deepcopy(answer)
    wrong.response.alpha *= 1.01
    assert crosscheck(case, settings_of(case), wrong)[0] is Verdict.DIFFERS
    wrong.response.result.code = ResultCode.INFEASIBLE
    assert crosscheck(case, settings_of(case), wrong)[0] is Verdict.DIFFERS


def test_every_answered_kind_is_among_the_questions():
    kinds = {case_of(seed).kind for seed in range(3_000)}
    assert len(kinds) == 9 and ANSWERED == (ResultCode.OPTIMAL, ResultCode.INFEASIBLE)

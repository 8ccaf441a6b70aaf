# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The service ~/explain: what limits a task, and what would change it."""

from grasp_quality_msgs.msg import ResultCode
from grasp_quality_msgs.srv import Explain
from grasps import ANTIPODAL, contact_array, SINGLE, SOLVER, vector, wrench
import pytest


@pytest.fixture(scope='module')
def client(start):
    return start().client


def test_the_weaker_finger_is_named_and_a_newton_helps(client):
    contacts = contact_array(ANTIPODAL, name=['left', 'right'], max_normal_force=[10.0, 3.0])
    answer = client.call(Explain, 'explain', contacts=contacts, task_wrench=wrench(fy=1.0))
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.alpha == pytest.approx(3.0, rel=SOLVER)
    assert answer.alpha_upper >= answer.alpha
    assert (answer.limiting_contact, answer.limiting_reason) == ('right', 'slip')
    left, right = answer.contacts
    assert (left.name, left.limit, right.name, right.limit) == ('left', '', 'right', 'slip')
    assert right.share == pytest.approx(1.0, rel=1e-5)
    assert right.dalpha_dmax_force == pytest.approx(1.0, rel=1e-3)
    assert left.dalpha_dmax_force == pytest.approx(0.0, abs=1e-3)
    assert (answer.best_contact, answer.best_kind) == ('right', 'max_force')
    assert answer.best_size == 1.0 and not vector(answer.best_direction).any()
    assert answer.best_alpha == pytest.approx(4.0, rel=SOLVER)
    assert not answer.smooth  # a pair of point contacts cannot turn the object about its line
    assert 'right by slip (100 %)' in answer.text
    assert answer.joints == [] and len(answer.joint_shares) == 0
    assert answer.solve_time.sec + answer.solve_time.nanosec > 0


def test_infeasible_is_only_that(client):
    answer = client.call(
        Explain, 'explain', contacts=contact_array(SINGLE), task_wrench=wrench(fx=1.0),
        external_wrench=wrench(fx=-99.0))
    assert answer.result.code == ResultCode.INFEASIBLE and answer.result.message
    assert (answer.alpha, answer.best_alpha, answer.contacts, answer.text) == (0.0, 0.0, [], '')


def test_bad_requests_get_a_code(client):
    answer = client.call(Explain, 'explain', contacts=contact_array(ANTIPODAL))
    assert answer.result.code == ResultCode.INVALID_REQUEST
    assert 'task_wrench must not be zero' in answer.result.message
    answer = client.call(Explain, 'explain', task_wrench=wrench(fx=1.0))
    assert answer.result.code == ResultCode.NO_CONTACTS and answer.alpha == 0.0

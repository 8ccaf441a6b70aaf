# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A solver that fails, lies or sleeps, injected into a true node.

Whatever it says is proved before it is published: a solver that fails or lies is SOLVER_FAILED
with no forces, by topic and by service. A slow one is TIMED_OUT at ``solver_time_limit``, and what
comes after the contacts are ``max_contact_age`` old is STALE_CONTACTS. The first good solve after
that is published.
"""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, pose_array, SOLVER, wrench
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rig import faulty, inject, MAX_AGE_S, Record, TASK

LIMIT_S = 0.25


@pytest.fixture(scope='module')
def node(start, tmp_path_factory):
    fault = tmp_path_factory.mktemp('fault') / 'fault.txt'
    fault.write_text('none')

    node = start(start_node=faulty(fault), max_contact_age=MAX_AGE_S, task_wrench=TASK,
                 solver_time_limit=LIMIT_S)
    node.expected = {'internal error'}  # one of the faults is no SolverError
    node.fault = fault
    node.outputs, node.record = Outputs(node.client), Record(node.client)
    publisher = node.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    node.feed = lambda: publisher.publish(pose_array(ANTIPODAL, node.client.now()))
    return node


@pytest.fixture(autouse=True)
def healed(node):
    """Before and after a fault the node answers, and in between it said nothing wrong."""
    node.record.forget()
    assert node.outputs.answer(node.feed).quality.alpha == pytest.approx(10.0, rel=SOLVER)
    yield
    inject(node, 'none')
    assert node.outputs.answer(node.feed).quality.alpha == pytest.approx(10.0, rel=SOLVER)
    node.record.check(MAX_AGE_S)
    assert all(abs(m.alpha - 10.0) < 1e-4 for m in node.record.optimal())


def ask(node):
    return node.client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench', node.feed,
                            contacts=contact_array(ANTIPODAL), task_wrench=wrench(fy=1.0))


@pytest.mark.parametrize('fault', [
    'raises', 'crashes', 'nan', 'infinite', 'unbalanced', 'lopsided', 'slipping', 'unproved'])
def test_what_cannot_be_proved_is_not_published(node, fault):
    inject(node, fault)
    node.outputs.failure(ResultCode.SOLVER_FAILED, node.feed)
    answer = ask(node)
    assert answer.result.code == ResultCode.SOLVER_FAILED and answer.result.message
    assert answer.alpha == answer.alpha_upper == 0.0 and not answer.forces.forces


def test_an_alpha_that_is_too_large_is_held_to_its_proof(node):
    """The proof takes no more than the forces give: the answer is the true one."""
    inject(node, 'stronger')
    found = node.outputs.answer(node.feed)
    assert found.quality.alpha == pytest.approx(10.0, rel=SOLVER)


def test_a_slow_solver_is_timed_out(node):
    inject(node, f'slow {1.2 * LIMIT_S}')
    quality = node.outputs.failure(ResultCode.TIMED_OUT, node.feed)
    assert 'time limit' in quality.result.message
    answer = ask(node)
    assert answer.result.code == ResultCode.TIMED_OUT and not answer.forces.forces


def test_what_comes_after_the_contacts_are_stale_is_withheld(node):
    """The solver ends within its limit by its own clock, and hands its answer over too late."""
    inject(node, f'late {1.1 * MAX_AGE_S}')
    node.outputs.failure(ResultCode.STALE_CONTACTS, node.feed)

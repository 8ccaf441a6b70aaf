# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Diagnostics: rate, age, solve time and result of the live loop, once a second."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseArray
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
import pytest


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='0.5', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]').client


@pytest.fixture(scope='module')
def report(client):
    """Return a function that waits for a report whose values meet a condition."""
    heard = client.listen(DiagnosticArray, '/diagnostics')

    def wait(condition, feed=None):
        found = client.fresh(
            heard, lambda m: m.status[0].name.endswith('live loop') and condition(values(m)),
            'a report', feed)
        assert found.header.stamp.sec > 0
        return found.status[0]
    return wait


def values(message):
    return {pair.key: pair.value for pair in message.status[0].values}


def test_missing_contacts_are_a_warning(client, report):
    status = report(lambda v: v['result'] == 'NO_CONTACTS')
    assert status.level == DiagnosticStatus.WARN
    assert status.name == 'grasp_quality: live loop'
    assert status.hardware_id == client.target
    assert 'no contacts received yet' in status.message


def test_answers_are_counted_and_timed(client, report):
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    sent = []

    def feed():
        sent.append(publisher.publish(pose_array(ANTIPODAL, client.now())))

    report(lambda v: v['result'] == 'OPTIMAL', feed)
    sent.clear()
    status = report(lambda v: float(v['failures per second']) == 0.0, feed)
    found = {pair.key: pair.value for pair in status.values}
    assert status.level == DiagnosticStatus.OK
    assert found['result'] == 'OPTIMAL' and found['lifecycle'] == 'active'
    assert 0.0 < float(found['answers per second']) <= 1.5 * len(sent)
    assert 0.0 < float(found['longest solve time [ms]']) < 2000.0
    assert 0.0 <= float(found['oldest contacts [ms]']) <= 500.0
    assert float(found['alpha']) == pytest.approx(10.0, rel=1e-4)
    assert found['measured slip margin'] == 'not measured'
    assert found['limiting contact'] in ('contact_0', 'contact_1')


def test_silence_is_a_warning_again(report):
    status = report(lambda v: v['result'] == 'STALE_CONTACTS' and v['answers per second'] == '0.0')
    assert status.level == DiagnosticStatus.WARN
    assert 'alpha' not in {pair.key for pair in status.values}


def test_a_deactivated_node_still_reports(client, report):
    assert client.call(ChangeState, 'change_state', transition=Transition(
        id=Transition.TRANSITION_DEACTIVATE)).success
    status = report(lambda v: v['lifecycle'] == 'not active')
    assert status.level == DiagnosticStatus.WARN

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What a newcomer gets wrong is named where one looks: on /diagnostics, in the log, or both."""

from types import SimpleNamespace

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from felt_contacts import felt_contacts
from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ContactArray, ContactForceArray
from grasps import ANTIPODAL, contact_array, pose, pose_array, SOLVER, wrench
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

PUSH = wrench(fz=5.0)
ALONG_Y = '[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]'


@pytest.fixture(scope='module')
def fingers(start):
    """Return a client, a feed of poses and of wrenches by name, and a wait for a report."""
    client = start(contact_names='[left, right]', max_contact_age='0.5', min_contact_force='0.5',
                   task_wrench=ALONG_Y).client
    return SimpleNamespace(client=client, make=felt_contacts(client), report=reports(client))


def reports(client):
    """Return a function that waits for a report of this node that meets a condition."""
    heard = client.listen(DiagnosticArray, '/diagnostics')

    def wait(condition, what, feed=None):
        return client.fresh(
            heard, lambda m: m.status[0].hardware_id == client.target
            and m.status[0].name.endswith('live loop') and condition(m.status[0]),
            what, feed).status[0]  # beside those of the auditor
    return wait


def values(status):
    return {pair.key: pair.value for pair in status.values}


def ask_for_load(client, least):
    answer = client.call(SetParameters, 'set_parameters', parameters=[
        Parameter('min_contact_force', value=least).to_parameter_msg()])
    assert answer.results[0].successful


def test_all_is_well_with_two_loaded_fingers(fingers):
    status = fingers.report(lambda s: s.level == DiagnosticStatus.OK, 'OK',
                            fingers.make(left=PUSH, right=PUSH))
    assert values(status)['result'] == 'OPTIMAL'


def test_a_finger_that_does_not_count_is_named(fingers):
    words = '1 of 2 contacts loaded: right is not (0.1 N of min_contact_force 0.5 N)'
    status = fingers.report(lambda s: words in s.message, words,
                            fingers.make(left=PUSH, right=wrench(fz=0.1)))
    assert status.level == DiagnosticStatus.WARN
    assert values(status)['result'] == 'OPTIMAL' and words in values(status).values()


@pytest.mark.parametrize('least', [0.0, 0.5])
def test_a_wrench_of_the_wrong_sign_is_named(fingers, least):
    ask_for_load(fingers.client, least)
    status = fingers.report(lambda s: 'right -5 N' in s.message, 'the wrong sign',
                            fingers.make(left=PUSH, right=wrench(fz=-5.0)))
    assert status.level == DiagnosticStatus.WARN
    for words in ('finger on the object', 'positive along the inward normal', 'negate'):
        assert words in status.message
    ask_for_load(fingers.client, 0.5)


def test_a_contact_without_a_wrench_is_named_with_its_topic(fingers):
    """Of `left` there were some in the tests before; they are too old now."""
    ask_for_load(fingers.client, 0.0)
    status = fingers.report(
        lambda s: 'no fresh measured wrench of left' in s.message, 'the missing one',
        fingers.make(right=PUSH))
    assert status.level == DiagnosticStatus.WARN
    assert '~/contact_wrenches/left is older than max_contact_age 0.5 s' in status.message
    assert float(values(status)['measured slip margin']) == pytest.approx(1.0)
    fingers.report(lambda s: s.level == DiagnosticStatus.OK, 'no sensors at all', fingers.make())
    ask_for_load(fingers.client, 0.5)


def test_doubts_end_with_the_contacts(fingers):
    pulling = fingers.make(left=wrench(fz=-5.0), right=wrench(fz=-5.0))
    fingers.report(lambda s: 'left -5 N, right -5 N' in s.message, 'the wrong sign', pulling)
    fingers.report(lambda s: values(s)['result'] == 'STALE_CONTACTS', 'silence')
    status = fingers.report(lambda s: 'below zero' not in s.message, 'no doubts')
    assert status.level == DiagnosticStatus.WARN


def test_contacts_in_millimetres_are_pointed_out(fingers):
    publisher = fingers.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    far = [pose((-35.0, 0.0, 0.0), (1, 0, 0)), pose((35.0, 0.0, 0.0), (-1, 0, 0))]
    status = fingers.report(
        lambda s: '70 m apart' in s.message and 'millimetres' in s.message, 'a doubt about metres',
        lambda: publisher.publish(pose_array(far, fingers.client.now())))
    assert status.level == DiagnosticStatus.WARN


@pytest.fixture(scope='module')
def misled(start):
    """Start a node that listens to contact arrays, with a misspelt parameter."""
    return start(contact_source='contact_array', friction_coeficient='0.9', use_sim_time='false',
                 max_contact_age='2.0', task_wrench=ALONG_Y)


def test_refusals_do_not_hide_each_other_in_the_log(misled):
    answers = [misled.client.call(kind, name) for kind, name in (
        (srv.EvaluateTaskWrench, 'evaluate_task_wrench'), (srv.WrenchMap, 'wrench_map'),
        (srv.EvaluateTaskCone, 'evaluate_task_cone'), (srv.MinimumForces, 'minimum_forces'),
        (srv.RobustAlpha, 'robust_alpha'), (srv.BallRadius, 'ball_radius'),
        (srv.Explain, 'explain'), (srv.SetTask, 'set_task'))]
    answers.append(misled.client.call(srv.SetTask, 'set_task', kind=1))
    assert all(answer.result.code < 0 for answer in answers)
    lines = [f'{name}: ' for name in (
        'evaluate_task_wrench', 'wrench_map', 'evaluate_task_cone', 'minimum_forces',
        'robust_alpha', 'ball_radius', 'explain')]
    lines += [f'set_task: {answer.result.message}' for answer in answers[-2:]]
    misled.client.until(
        lambda: all(line in misled.process.log() for line in lines), 'nine refusals in the log')


def test_contacts_on_the_other_topic_are_pointed_out(misled):
    client, report = misled.client, reports(misled.client)
    words = 'no contacts received yet on ~/contacts (parameter contact_source is contact_array)'
    assert 'somebody' not in report(lambda s: words in s.message, words).message
    poses = client.node.create_publisher(PoseArray, f'{client.target}/contact_poses', 1)
    words = ('nobody publishes there, but somebody on ~/contact_poses: to listen there, start '
             'the node with contact_source pose_array')
    report(lambda s: words in s.message, words)
    client.until(lambda: words in misled.process.log(), 'a line in the log')
    client.node.destroy_publisher(poses)
    report(lambda s: 'no contacts' in s.message and 'somebody' not in s.message, 'its end')


def test_a_misspelt_parameter_is_named_and_those_of_ros_are_not(misled):
    words = ("there is no parameter 'friction_coeficient', its value changes nothing: "
             "'friction_coefficient' may be meant")
    assert misled.process.log().count(words) == 1
    assert misled.process.log().count('there is no parameter') == 1
    publisher = misled.client.publisher(ContactArray, 'contacts', BEST_EFFORT)

    def feed():
        publisher.publish(contact_array(ANTIPODAL, misled.client.now()))

    found = Outputs(misled.client).answer(feed)
    assert found.quality.alpha == pytest.approx(10.0, rel=SOLVER)  # the default: mu = 0.5
    status = reports(misled.client)(
        lambda s: values(s)['result'] == 'OPTIMAL' and words in s.message, words, feed)
    assert status.level == DiagnosticStatus.WARN


def test_somebody_else_who_publishes_forces_is_named(fingers):
    topic = f'{fingers.client.target}/contact_forces'
    words = f'another node publishes on {topic}: two nodes of one name?'
    fingers.report(lambda status: words not in status.message, 'no such warning')
    rival = fingers.client.node.create_publisher(ContactForceArray, topic, 1)
    status = fingers.report(lambda status: words in status.message, 'the warning')
    assert status.level == DiagnosticStatus.WARN and words in values(status).values()
    fingers.client.node.destroy_publisher(rival)
    fingers.report(lambda status: words not in status.message, 'the end of the warning')

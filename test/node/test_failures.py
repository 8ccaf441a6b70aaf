# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The failure contract: silence, old stamps and bad messages are told at once, and pass."""

import math
import time

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseArray, Quaternion
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
from grasps import ANTIPODAL, CIRCLE, pose_array, SOLVER, wrench
from harness import BEST_EFFORT
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from msg_adapters.stamps import stamp_ns
from outputs import Outputs
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

MAX_AGE_S = 0.5
TASK = '[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]'


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age=MAX_AGE_S, task_wrench=TASK,
                 contact_names='[left, right]').client


@pytest.fixture(scope='module')
def publisher(client):
    return client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)


@pytest.fixture(scope='module')
def feed(client, publisher):
    """Return a feed of good poses."""
    return lambda: publisher.publish(pose_array(ANTIPODAL, client.now()))


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client, ['left', 'right'])


def test_silence_is_told_by_a_lower_age_as_soon_as_it_is_set(start):
    node = start(max_contact_age=60.0, task_wrench=TASK)  # looks every 15 s
    client, outputs = node.client, Outputs(node.client)
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)

    def feed():
        publisher.publish(pose_array(ANTIPODAL, client.now()))

    outputs.answer(feed)
    result, = client.call(SetParameters, 'set_parameters', feed, parameters=[
        Parameter('max_contact_age', value=MAX_AGE_S).to_parameter_msg()]).results
    assert result.successful
    outputs.answer(feed)
    silent = time.monotonic()
    outputs.failure(ResultCode.STALE_CONTACTS)
    assert time.monotonic() - silent < 2 * MAX_AGE_S


def test_before_the_first_contacts_there_are_none(outputs):
    quality = outputs.failure(ResultCode.NO_CONTACTS)
    assert 'no contacts received yet' in quality.result.message


def test_silence_is_told_within_twice_the_age_and_passes(client, outputs, feed):
    for _ in range(3):
        outputs.answer(feed)
        feed()
        silent = time.monotonic()
        quality = outputs.failure(ResultCode.STALE_CONTACTS)
        assert time.monotonic() - silent < 2 * MAX_AGE_S
        assert 'max_contact_age is 0.5 s' in quality.result.message


def test_silence_is_repeated_faster_than_contacts_grow_old(client, outputs):
    outputs.failure(ResultCode.STALE_CONTACTS)
    begin = time.monotonic()
    outputs.forget()
    client.until(lambda: len(outputs.quality) >= 4, 'four more reports')
    assert time.monotonic() - begin < 2 * MAX_AGE_S
    assert not any(message.forces for message in outputs.forces)


def test_services_refuse_stale_contacts_too(client, outputs):
    outputs.failure(ResultCode.STALE_CONTACTS)
    for kind, name in ((srv.EvaluateTaskWrench, 'evaluate_task_wrench'),
                       (srv.MinimumForces, 'minimum_forces'), (srv.WrenchMap, 'wrench_map')):
        answer = client.call(kind, name)
        assert answer.result.code == ResultCode.STALE_CONTACTS
        assert 'max_contact_age' in answer.result.message


@pytest.mark.parametrize('ahead_s, words', [(10, 'ahead of this clock'), (-10, 's old')])
def test_stamps_far_from_now_are_stale_however_often_they_come(
        client, outputs, publisher, feed, ahead_s, words):
    def late():
        stamp = client.now()
        stamp.sec += ahead_s
        publisher.publish(pose_array(ANTIPODAL, stamp))

    outputs.answer(feed)
    quality = outputs.failure(ResultCode.STALE_CONTACTS, late)
    assert words in quality.result.message
    outputs.answer(feed)


def test_a_stamp_before_the_epoch_is_stale(outputs, publisher):
    outputs.failure(ResultCode.STALE_CONTACTS, lambda: publisher.publish(
        pose_array(ANTIPODAL, Time(sec=-7))))


def test_without_a_stamp_the_arrival_counts(client, outputs, publisher):
    outputs.failure(ResultCode.STALE_CONTACTS)
    outputs.forget()
    client.until(
        lambda: any(m.result.code == ResultCode.OPTIMAL and m.header.stamp == Time()
                    for m in outputs.quality),
        'an answer', lambda: publisher.publish(pose_array(ANTIPODAL)))
    outputs.failure(ResultCode.STALE_CONTACTS)


def spoilt(**fields):
    """Return the antipodal poses with the second one changed."""
    message = pose_array(ANTIPODAL, frame=fields.pop('frame', 'object'))
    position = message.poses[1].position
    position.x = fields.pop('x', position.x)
    message.poses[1].orientation = fields.pop('turn', message.poses[1].orientation)
    return message


@pytest.mark.parametrize('message, words', [
    (spoilt(x=math.nan), 'poses[1].position must be finite'),
    (spoilt(x=-math.inf), 'poses[1].position must be finite'),
    (spoilt(x=1e300), 'poses[1].position must be finite'),
    (spoilt(turn=Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)), 'poses[1].orientation must be'),
    (spoilt(turn=Quaternion(x=1.0, y=1.0, z=1.0, w=1.0)), 'poses[1].orientation must be'),
    (spoilt(frame=''), 'header.frame_id of the contacts must not be empty'),
    (pose_array(CIRCLE), 'poses must hold one pose for each of the 2 contact_names')])
def test_a_bad_message_is_answered_and_the_next_good_one_recovers(
        client, outputs, publisher, feed, message, words):
    def bad():
        message.header.stamp = client.now()
        publisher.publish(message)

    outputs.answer(feed)
    quality = outputs.failure(ResultCode.INVALID_REQUEST, bad)
    assert words in quality.result.message
    found = outputs.answer(feed)
    assert found.quality.alpha == pytest.approx(10.0, rel=SOLVER)


def test_no_poses_are_no_contacts(client, outputs, publisher, feed):
    outputs.answer(feed)
    outputs.failure(ResultCode.NO_CONTACTS, lambda: publisher.publish(
        pose_array([], client.now())))
    outputs.answer(feed)


def test_a_late_joiner_gets_nothing_old(client, outputs, feed):
    """After the node fell silent, whoever joins hears only what comes after."""
    outputs.answer(feed)

    def change(transition):
        assert client.call(
            ChangeState, 'change_state', feed, transition=Transition(id=transition)).success

    change(Transition.TRANSITION_DEACTIVATE)
    quality = client.listen(GraspQuality, 'quality')
    forces = client.listen(ContactForceArray, 'contact_forces')
    joined = stamp_ns(client.now())
    change(Transition.TRANSITION_ACTIVATE)
    client.until(lambda: any(m.forces for m in forces), 'new forces', feed)
    assert all(stamp_ns(m.header.stamp) > joined for m in forces if m.forces)
    assert all(stamp_ns(m.header.stamp) > joined
               for m in quality if m.result.code == ResultCode.OPTIMAL)
    assert not any(m.result.code == ResultCode.NOT_ACTIVE for m in quality)


def test_without_a_task_the_loop_says_how_to_set_one(start):
    client = start(max_contact_age='2.0').client
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)

    def feed():
        publisher.publish(pose_array(ANTIPODAL, client.now()))

    outputs = Outputs(client)
    quality = outputs.failure(ResultCode.INVALID_REQUEST, feed)
    assert 'no task set' in quality.result.message
    assert 'holding_forces need one too' in quality.result.message
    client.call(srv.SetTask, 'set_task', kind=1, task_wrench=wrench(fy=1.0))
    outputs.answer(feed)


def test_a_solver_out_of_time_fails_like_everything_else(start):
    client = start(max_contact_age='2.0', task_wrench=TASK, solver_time_limit='0.000001').client
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    quality = Outputs(client).failure(
        ResultCode.TIMED_OUT, lambda: publisher.publish(pose_array(ANTIPODAL, client.now())))
    assert 'time limit' in quality.result.message
    assert quality.header.frame_id == 'object' and quality.header.stamp != Time()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The live loop: contact poses in, alpha and contact forces out, for whatever task is set."""

import math

from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import (
    ANTIPODAL, check_forces, CIRCLE, EIGHT, numbers, pose_array, SOLVER, total_wrench, vector,
    wrench)
from harness import BEST_EFFORT
from msg_adapters.poses import pose_arrays
from msg_adapters.stamps import seconds, stamp_ns
import numpy as np
from outputs import Outputs
import pytest
from std_msgs.msg import Header

REACH = 10.0 + 5.0 * math.sqrt(3.0)  # of CIRCLE along -x [N]


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='2.0', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]').client


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of poses."""
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda poses: lambda: publisher.publish(pose_array(poses, client.now()))


@pytest.fixture(scope='module')
def outputs(client, feed):
    return Outputs(client, [f'contact_{i}' for i in range(3)], feed(CIRCLE))


def set_task(client, **fields):
    answer = client.call(srv.SetTask, 'set_task', **fields)
    assert answer.result.code == ResultCode.OPTIMAL, answer.result


def near(alpha):
    """Match answers about an alpha: the newest task may take a sample to arrive."""
    return lambda quality: quality.alpha == pytest.approx(alpha, rel=SOLVER)


def test_poses_alone_are_enough(outputs, feed):
    found = outputs.answer(feed(CIRCLE))
    quality = found.quality
    assert quality.header.frame_id == found.forces.header.frame_id == 'object'
    assert numbers(quality.task_wrench).tolist() == [0, 1, 0, 0, 0, 0]
    assert quality.alpha <= quality.alpha_upper <= quality.alpha * (1 + 1e-5)
    assert (quality.alpha_lower, quality.holdable) == (0.0, True)
    assert quality.friction_margin == pytest.approx(
        1.0 - max(item.cone_usage for item in found.forces.forces), abs=1e-12)
    assert quality.limiting_contact in ('contact_0', 'contact_1', 'contact_2')
    assert 0.0 < seconds(quality.solve_time) < 2.0
    assert 0.0 <= seconds(quality.contact_age) <= 2.0
    assert (quality.slip_measured, quality.measured_slip_margin) == (False, 0.0)


def test_forces_balance_by_the_messages_alone(outputs, feed, client):
    task = wrench(1.0, -2.0, 3.0, 0.1, 0.2, -0.3)
    load = wrench(fz=-3.0, tx=0.1)
    set_task(client, kind=1, task_wrench=task, external_wrench=load)
    found = outputs.answer(feed(CIRCLE), lambda q: q.task_wrench == task)
    wanted = found.quality.alpha * numbers(task)
    np.testing.assert_allclose(
        total_wrench(found.forces) + numbers(load), wanted, atol=1e-6)
    check_forces(found.forces)

    total = np.zeros(6)  # the same from the plain wrench topics and the poses that were sent
    for name, message in found.wrenches.items():
        assert message.header.frame_id == name
        position, R = pose_arrays(CIRCLE[int(name[-1])], name)
        force = R @ vector(message.wrench.force)
        total[:3] += force
        total[3:] += R @ vector(message.wrench.torque) + np.cross(position, force)
    np.testing.assert_allclose(total + numbers(load), wanted, atol=1e-6)


@pytest.mark.parametrize('task, alpha', [
    (wrench(fx=1.0), 10.0), (wrench(fx=-1.0), REACH), (wrench(fz=5.0), 3.0)])
def test_set_task_wrench(client, outputs, feed, task, alpha):
    set_task(client, kind=1, task_wrench=task)
    found = outputs.answer(feed(CIRCLE), near(alpha))
    assert found.quality.task_wrench == task


def test_set_task_cone(client, outputs, feed):
    """The task wrench told is the one reached, over alpha; alpha is that of the cone."""
    tilt = math.radians(20)
    set_task(client, kind=2, axis=wrench(-math.cos(tilt), math.sin(tilt)),
             lateral_x=wrench(math.sin(tilt), math.cos(tilt)), lateral_y=wrench(fz=1.0),
             half_angle=math.radians(60))
    found = outputs.answer(feed(CIRCLE), near(REACH * math.cos(tilt)))
    reached = found.quality.alpha * numbers(found.quality.task_wrench)
    np.testing.assert_allclose(reached, [-REACH, 0, 0, 0, 0, 0], atol=1e-3)
    np.testing.assert_allclose(total_wrench(found.forces), reached, atol=1e-6)


def test_set_task_polytope_follows_its_weakest_wrench(client, outputs, feed):
    set_task(client, kind=3, task_wrenches=[wrench(fx=-1.0), wrench(fx=1.0), wrench(fz=1.0)])
    found = outputs.answer(feed(CIRCLE), near(10.0))
    assert found.quality.task_wrench == wrench(fx=1.0)
    np.testing.assert_allclose(total_wrench(found.forces), [10, 0, 0, 0, 0, 0], atol=1e-5)


def test_a_refused_task_leaves_the_one_before(client, outputs, feed):
    set_task(client, kind=1, task_wrench=wrench(fz=1.0))
    answer = client.call(srv.SetTask, 'set_task', kind=1, task_wrench=wrench(fx=math.nan))
    assert answer.result.code == ResultCode.INVALID_REQUEST
    outputs.answer(feed(CIRCLE), near(15.0))


def test_task_and_load_stream_in(client, outputs, feed):
    """A streamed load stays until a task is set. Four contacts: alpha = sqrt(20^2 - 12^2) / 2."""
    tasks = client.publisher(WrenchStamped, 'task_wrench')
    loads = client.publisher(WrenchStamped, 'external_wrench')
    stream = feed(ANTIPODAL * 2)

    def all_three():
        stream()
        tasks.publish(WrenchStamped(header=Header(frame_id='object'), wrench=wrench(fy=2.0)))
        loads.publish(WrenchStamped(wrench=wrench(fz=-12.0)))

    outputs.answer(all_three, near(8.0))
    found = outputs.answer(stream)
    assert found.quality.alpha == pytest.approx(8.0, rel=SOLVER)
    np.testing.assert_allclose(
        total_wrench(found.forces), [0, 16, 12, 0, 0, 0], atol=1e-5)
    set_task(client, kind=1, task_wrench=wrench(fy=2.0))
    outputs.answer(stream, near(10.0))


@pytest.mark.parametrize('topic, fields', [
    ('task_wrench', {'wrench': wrench(fy=math.nan)}), ('task_wrench', {}),
    ('external_wrench', {'wrench': wrench(tz=math.inf)})])
def test_a_bad_stream_is_answered_and_the_next_good_one_recovers(
        client, outputs, feed, topic, fields):
    publisher = client.publisher(WrenchStamped, topic)
    publisher.publish(WrenchStamped(**fields))
    quality = outputs.failure(ResultCode.INVALID_REQUEST, feed(CIRCLE))
    assert f'{topic} must' in quality.result.message
    set_task(client, kind=1, task_wrench=wrench(fz=1.0))
    outputs.answer(feed(CIRCLE), near(15.0))


def test_a_stream_in_another_frame_needs_tf2(client, outputs, feed):
    loads = client.publisher(WrenchStamped, 'external_wrench')
    loads.publish(WrenchStamped(header=Header(frame_id='world'), wrench=wrench(fz=-1.0)))
    quality = outputs.failure(ResultCode.TRANSFORM_FAILED, feed(CIRCLE))
    assert "'world' is not the object frame 'object'" in quality.result.message
    loads.publish(WrenchStamped())
    outputs.answer(feed(CIRCLE))


def test_a_load_beyond_the_grasp_is_infeasible(client, outputs, feed):
    set_task(client, kind=1, task_wrench=wrench(fx=1.0), external_wrench=wrench(fz=-15.1))
    quality = outputs.failure(ResultCode.INFEASIBLE, feed(CIRCLE))
    assert quality.task_wrench == wrench(fx=1.0) and quality.header.frame_id == 'object'
    set_task(client, kind=1, task_wrench=wrench(fx=1.0))
    outputs.answer(feed(CIRCLE), near(10.0))


def test_of_a_burst_the_newest_is_answered_and_nothing_goes_back(client, outputs):
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    newest = []

    def burst():
        messages = [pose_array(EIGHT, client.now()) for _ in range(20)]
        for message in messages:
            publisher.publish(message)
        newest.append(messages[-1].header.stamp)

    outputs.forget()
    client.until(
        lambda: any(m.header.stamp in newest for m in outputs.quality), 'the newest', burst)
    stamps = [stamp_ns(m.header.stamp) for m in outputs.quality]
    assert stamps == sorted(stamps)


def test_services_use_the_latest_contacts(client, outputs, feed):
    outputs.answer(feed(EIGHT[:4]))
    answer = client.call(
        srv.EvaluateTaskWrench, 'evaluate_task_wrench', feed(EIGHT), task_wrench=wrench(fx=1.0))
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.alpha == pytest.approx(40.0, rel=SOLVER)
    assert answer.forces.header.stamp.sec > 0
    answer = client.call(srv.MinimumForces, 'minimum_forces', feed(EIGHT),
                         external_wrench=wrench(fx=-20.0))
    assert answer.peak == pytest.approx(0.5, rel=SOLVER)

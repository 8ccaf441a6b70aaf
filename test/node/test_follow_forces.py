# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Forces for controllers: a reserve buys margin, and a rate limit keeps them from jumping."""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, check_forces, CIRCLE, numbers, pose_array, SOLVER, total_wrench, \
    vector
from harness import BEST_EFFORT
import numpy as np
from outputs import Outputs
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

ALONG_Y, ALONG_Z = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='0.5', task_wrench=str(ALONG_Y)).client


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client)


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of poses."""
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda poses: lambda: publisher.publish(pose_array(poses, client.now()))


@pytest.fixture(scope='module')
def change(client):
    def change(**values):
        results = client.call(SetParameters, 'set_parameters', parameters=[
            Parameter(name, value=value).to_parameter_msg() for name, value in values.items()
        ]).results
        return results[-1]
    return change


@pytest.fixture
def restored(change):
    """Put everything back behind a test."""
    yield
    for name, value in (('force_rate_limit', 0.0), ('alpha_reserve', 0.0),
                        ('barrier_weight', 0.0), ('task_wrench', ALONG_Y)):
        assert change(**{name: value}).successful


def check(found):
    """Assert that published forces are admissible and apply the alpha published with them."""
    check_forces(found.forces)
    applied = found.quality.alpha * numbers(found.quality.task_wrench)
    assert total_wrench(found.forces) == pytest.approx(applied, abs=1e-6)


def test_a_reserve_gives_margin_for_alpha(outputs, feed, change, restored):
    assert outputs.answer(feed(ANTIPODAL)).quality.friction_margin < 1e-5
    assert change(alpha_reserve=0.1).successful
    found = outputs.answer(
        feed(ANTIPODAL), lambda q: q.alpha == pytest.approx(9.0, rel=SOLVER))
    check(found)
    assert found.quality.friction_margin > 0.01
    assert found.quality.alpha_upper == pytest.approx(10.0, rel=SOLVER)
    assert not found.quality.force_rate_limited


def test_a_reserve_and_a_barrier_weight_are_refused_together(change, restored):
    assert change(alpha_reserve=0.1).successful
    refused = change(barrier_weight=0.1)
    assert not refused.successful and 'two ways to buy margin' in refused.reason


def test_published_forces_change_no_faster_than_the_limit(client, outputs, feed, change, restored):
    """A task that turns from y to z asks for forces 10 N away; at 5 N/s that takes seconds."""
    assert change(alpha_reserve=0.05).successful
    outputs.answer(feed(CIRCLE), lambda q: numbers(q.task_wrench)[1] == 1.0)
    assert change(force_rate_limit=5.0).successful
    outputs.answer(feed(CIRCLE))
    outputs.forget()
    assert change(task_wrench=ALONG_Z).successful
    found = outputs.answer(
        feed(CIRCLE), lambda q: numbers(q.task_wrench)[2] == 1.0 and q.force_rate_limited)
    check(found)
    assert 0.0 <= found.quality.alpha < 0.94 * found.quality.alpha_upper
    outputs.answer(feed(CIRCLE), lambda q: not q.force_rate_limited
                   and q.alpha == pytest.approx(0.95 * q.alpha_upper, rel=SOLVER))
    complete = [m for m in outputs.forces if m.forces]
    stamps = [m.header.stamp.sec + 1e-9 * m.header.stamp.nanosec for m in complete]
    sets = [np.array([vector(f.wrench.force) for f in m.forces]) for m in complete]
    for before, after in zip(sets[5:], sets[10:]):
        assert np.isfinite(after).all() and np.isfinite(before).all()
    # over many samples the jitter of a single one does not matter
    moved = max(np.linalg.norm(sets[-1] - sets[0], axis=1))
    assert moved <= 5.0 * (stamps[-1] - stamps[0] + 0.5)


def test_a_failure_is_a_failure_with_a_limit_too(outputs, feed, change, restored):
    assert change(force_rate_limit=5.0).successful
    outputs.answer(feed(ANTIPODAL))
    outputs.failure(ResultCode.STALE_CONTACTS)
    check(outputs.answer(feed(ANTIPODAL)))


def test_other_contacts_begin_anew(outputs, feed, change, restored):
    assert change(force_rate_limit=1e-3).successful
    outputs.answer(feed(ANTIPODAL))
    found = outputs.answer(feed(CIRCLE), names=['contact_0', 'contact_1', 'contact_2'])
    check(found)

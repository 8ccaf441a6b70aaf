# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A request that takes long is bounded in time, and nobody else waits for it."""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import GraspQuality, ResultCode
from grasps import EIGHT, pose_array, wrench
from harness import BEST_EFFORT
import pytest


@pytest.fixture(scope='module')
def client(start):
    """Return a client of a node whose maps take seconds: l2 has no batch kernel."""
    return start(force_bound='l2', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]',
                 max_contact_age='2.0', solver_time_limit='1.0').client


@pytest.fixture(scope='module')
def feed(client):
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda: publisher.publish(pose_array(EIGHT, client.now()))


def test_the_live_loop_goes_on_and_the_request_is_timed_out(client, feed):
    qualities = client.listen(GraspQuality, 'quality')
    client.fresh(qualities, lambda m: m.result.code == ResultCode.OPTIMAL, 'an answer', feed)
    qualities.clear()
    answer = client.call(srv.WrenchMap, 'wrench_map', feed, resolution=45)
    assert answer.result.code == ResultCode.TIMED_OUT and not answer.alphas
    assert 'time limit' in answer.result.message
    live = [m for m in qualities if m.result.code == ResultCode.OPTIMAL]
    assert len(live) >= 10  # fed every 10 ms for a second; a node that waits has none
    assert {m.result.code for m in qualities} == {ResultCode.OPTIMAL}


def test_short_questions_overtake_a_long_one(client, feed):
    map_client = client.node.create_client(srv.WrenchMap, f'{client.target}/wrench_map')
    client.until(map_client.service_is_ready, 'the map service', feed)
    long = map_client.call_async(srv.WrenchMap.Request(resolution=45))
    answer = client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench', feed,
                         task_wrench=wrench(fx=1.0))
    assert answer.result.code == ResultCode.OPTIMAL
    assert not long.done()
    client.until(long.done, 'the end of the map', feed)
    assert long.result().result.code == ResultCode.TIMED_OUT

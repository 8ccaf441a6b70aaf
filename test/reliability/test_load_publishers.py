# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Publishers of loads that die or freeze, and come back.

With ``max_load_age`` STALE_CONTACTS with no forces is published within twice that age of the last
load, whether contacts go on or are sensed rarely, and the next load is answered.
"""

import signal
import time

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rig import kill, MAX_AGE_S, Record, start_feed, TASK


@pytest.fixture(params=[2.0, 60.0], ids=['contacts go on', 'contacts are rare'])
def loaded(request, start, tmp_path):
    """Return a node whose loads age, and a function that starts publishers of loads."""
    node = start(max_contact_age=request.param, max_load_age=MAX_AGE_S, task_wrench=TASK)
    node.record, node.outputs = Record(node.client), Outputs(node.client)
    publisher = node.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    node.feed = lambda: publisher.publish(pose_array(ANTIPODAL, node.client.now()))
    node.later = node.feed if request.param < 60.0 else None
    begun = []

    def begin():
        begun.append(start_feed(
            tmp_path / f'load_{len(begun)}.txt', node.namespace, '--load', '-3.0'))
        return begun[-1]

    node.loads = begin
    yield node
    for process in begun:
        if process.popen.poll() is None:
            process.end()


def silence(node, silent_ns):
    """Check that a silence of loads is told in time; nothing is answered any more."""
    found = node.client.until(
        lambda: next((sent for m, sent in node.record.quality if sent > silent_ns
                      and m.result.code == ResultCode.STALE_CONTACTS), None),
        'STALE_CONTACTS', node.later)
    assert (found - silent_ns) * 1e-9 < 2 * MAX_AGE_S
    quality = next(m for m, sent in node.record.quality if sent == found)
    assert 'max_load_age' in quality.result.message
    end = time.monotonic() + MAX_AGE_S
    node.client.until(lambda: time.monotonic() > end, 'time', node.later)
    assert not any(m.forces for m, sent in node.record.forces if sent > found)


def test_a_killed_publisher_is_told_and_its_successor_answered(loaded):
    for _ in range(2):
        loads = loaded.loads()
        loaded.outputs.answer(loaded.feed)
        kill(loads)
        silence(loaded, time.time_ns())
    loaded.loads()
    found = loaded.outputs.answer(loaded.feed)
    assert found.quality.external_wrench.force.z == -3.0


def test_a_frozen_load_is_stale_however_often_it_speaks(loaded):
    loads = loaded.loads()
    loaded.outputs.answer(loaded.feed)
    loads.popen.send_signal(signal.SIGUSR1)
    silence(loaded, time.time_ns())

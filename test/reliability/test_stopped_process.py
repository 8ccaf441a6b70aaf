# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A node that gets no processor for longer than ``max_contact_age``, as under SIGSTOP.

When it goes on, samples that waited for it are older than the age: it says STALE_CONTACTS, and
forces come with the first fresh sample. That holds for contacts without stamps too: when they were
sent counts as well as when they arrived.
"""

import signal
import time

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT
from msg_adapters.stamps import stamp_ns
import pytest
from rcl_interfaces.srv import GetParameters
from rig import MAX_AGE_S


@pytest.mark.parametrize('stamped', [True, False])
def test_after_a_stop_nothing_old_is_answered(hand, poses, stamped):
    publisher = hand.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)

    def sample():
        message = pose_array(ANTIPODAL, hand.client.now() if stamped else None)
        publisher.publish(message)
        return message.header.stamp

    hand.outputs.answer(poses(ANTIPODAL))
    last = sample()
    hand.client.until(lambda: any(  # so that it is at rest when it is stopped
        m.header.stamp == last for m, _ in hand.record.quality), 'the answer')
    hand.process.popen.send_signal(signal.SIGSTOP)
    stopped = time.monotonic()
    hand.client.until(lambda: time.monotonic() > stopped + 1.5 * MAX_AGE_S, 'contacts to age',
                      lambda: time.monotonic() < stopped + 0.4 * MAX_AGE_S and sample())
    hand.record.forget()
    hand.process.popen.send_signal(signal.SIGCONT)
    hand.client.until(lambda: any(
        m.result.code == ResultCode.STALE_CONTACTS for m, _ in hand.record.quality), 'STALE')
    for _ in range(10):  # whatever waited in its queues is worked off
        assert hand.client.call(GetParameters, 'get_parameters').values == []
    assert not any(m.forces for m, _ in hand.record.forces)
    hand.record.check(MAX_AGE_S)
    resumed = stamp_ns(hand.client.now())
    found = hand.outputs.answer(poses(ANTIPODAL))
    assert stamp_ns(found.quality.header.stamp) >= resumed

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contact publishers that die, come back, come twice, or say the same for ever.

STALE_CONTACTS with no forces is published within twice ``max_contact_age`` of the last sample that
counted, and the next good sample is answered: nobody has to restart the node.
"""

import signal

from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, CIRCLE, EIGHT
from msg_adapters.stamps import stamp_ns
import pytest
from rig import kill, MAX_AGE_S, positions

pytestmark = pytest.mark.robot


def test_a_killed_publisher_is_told_and_its_successor_answered(hand, feeds):
    feed = feeds()
    hand.outputs.answer(None)
    kill(feed)
    assert hand.record.until_failure(ResultCode.STALE_CONTACTS) < 2 * MAX_AGE_S
    hand.outputs.failure(ResultCode.STALE_CONTACTS)
    feeds()
    hand.outputs.answer(None)
    hand.record.check(MAX_AGE_S)


def test_of_two_publishers_every_answer_is_for_one_sample(hand, feeds):
    """Contacts of two grasps, interleaved: never forces of one on the points of the other."""
    known = [positions(poses) for poses in (ANTIPODAL, CIRCLE)]
    alphas = {}
    feeds('--grasp', 'ANTIPODAL')
    alphas[2] = hand.outputs.answer(None).quality.alpha
    feeds('--grasp', 'CIRCLE')

    def both():
        return {len(m.forces) for m, _ in hand.record.forces if m.forces} == {2, 3}

    hand.client.until(both, 'answers for either grasp')
    hand.record.until_answers(100)
    counts = {m.header.stamp.sec * 10 ** 9 + m.header.stamp.nanosec: len(m.forces)
              for m, _ in hand.record.forces if m.forces}
    alphas[3] = next(m.alpha for m in hand.record.optimal()
                     if counts.get(stamp_ns(m.header.stamp)) == 3)
    assert abs(alphas[2] - alphas[3]) > 1.0
    for message, _ in hand.record.forces:
        assert not message.forces or positions(message.forces) in known
    for message in hand.record.optimal():
        count = counts.get(stamp_ns(message.header.stamp))
        assert count is None or abs(message.alpha - alphas[count]) <= 1e-5 * alphas[count]
    hand.record.check(MAX_AGE_S)


def test_a_publisher_behind_another_is_passed_over_until_it_is_alone(hand, feeds):
    """Stamps 0.2 s apart: those behind are dropped, and answered once the others have ended."""
    ahead = feeds('--grasp', 'EIGHT')
    hand.client.until(lambda: any(m.forces for m, _ in hand.record.forces), 'forces')
    hand.record.forget()
    feeds('--grasp', 'CIRCLE', '--stamps', '-0.2')
    hand.record.until_answers(50)
    assert all(positions(m.forces) == positions(EIGHT)
               for m, _ in hand.record.forces if m.forces)
    kill(ahead)
    hand.client.until(lambda: any(positions(m.forces) == positions(CIRCLE)
                                  for m, _ in hand.record.forces), 'the other publisher')
    hand.record.check(MAX_AGE_S)


def test_a_frozen_sensor_goes_stale_however_often_it_speaks(hand, feeds):
    """The same stamp at 100 Hz: STALE_CONTACTS as soon as the stamp is max_contact_age old."""
    frozen = feeds()
    hand.record.until_answers(5)
    frozen.popen.send_signal(signal.SIGUSR1)
    assert hand.record.until_failure(ResultCode.STALE_CONTACTS) < 2 * MAX_AGE_S
    quality = hand.outputs.failure(ResultCode.STALE_CONTACTS)
    assert 'max_contact_age' in quality.result.message
    hand.record.check(MAX_AGE_S)
    hand.record.forget()
    hand.client.until(lambda: len(hand.record.quality) >= 50, 'many reports')
    assert {m.result.code for m, _ in hand.record.quality} == {ResultCode.STALE_CONTACTS}
    assert not any(m.forces for m, _ in hand.record.forces)
    feeds()
    hand.outputs.answer(None)
    kill(frozen)

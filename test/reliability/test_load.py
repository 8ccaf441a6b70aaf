# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
More than the node can answer: 32 contacts at 1 kHz, and eight clients asking all the time.

Whatever the machine: answers are for the newest sample and never go back, nothing old is answered
and nothing queues, so that when contacts stop there are two more answers at most and then STALE;
all questions are answered. What it takes of time and memory ``benchmarks.load`` measures.
"""

from callers import start_callers
from grasp_quality_msgs.msg import ResultCode
from msg_adapters.stamps import stamp_ns
from rig import MAX_AGE_S

ANSWERS = 200


def test_the_newest_is_answered_and_nothing_queues(hand, feeds, tmp_path):
    callers = [start_callers(tmp_path / f'callers_{i}.txt', hand.namespace, '--clients', '4')
               for i in range(2)]
    feed = feeds('--ring', '32', '--rate', '1000')
    hand.record.until_answers(ANSWERS)
    assert feed.end() == 0
    ended_ns = stamp_ns(hand.client.now())
    hand.client.until(lambda: any(
        m.result.code == ResultCode.STALE_CONTACTS and sent_ns > ended_ns
        for m, sent_ns in hand.record.quality), 'STALE_CONTACTS')
    hand.record.check(MAX_AGE_S)
    for process in callers:
        counts = process.counts()
        assert counts['lost'] == 0 and counts['answered'] == counts['asked']
        assert counts['fewest'] > 0
        assert set(counts['codes']) <= {
            str(code) for code in (ResultCode.OPTIMAL, ResultCode.STALE_CONTACTS,
                                   ResultCode.NO_CONTACTS, ResultCode.TIMED_OUT)}
    late = {stamp_ns(m.header.stamp) for m, sent_ns in hand.record.quality
            if m.result.code == ResultCode.OPTIMAL and sent_ns > ended_ns}
    assert len(late) <= 2  # the one at work and the newest; what was between them is gone

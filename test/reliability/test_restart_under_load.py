# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The node killed with SIGKILL and started again while contacts and questions go on.

Nothing is heard in between, and nothing from before afterwards, by those who listened all along
and by those who join late. Publisher, subscribers, clients and auditor stay as they are; a
question asked while it was dead is lost, and its client has to give it up by itself.
"""

from callers import start_callers
from harness import Client, start_node
from msg_adapters.stamps import stamp_ns
import pytest
from rig import kill, MAX_AGE_S, Record, start_feed, TASK

pytestmark = pytest.mark.robot
PARAMETERS = {'max_contact_age': MAX_AGE_S, 'task_wrench': TASK}


def test_the_next_process_takes_over(start, tmp_path):
    node = start(**PARAMETERS)
    record = Record(node.client)
    feed = start_feed(tmp_path / 'feed.txt', node.namespace, '--grasp', 'EIGHT')
    callers = start_callers(
        tmp_path / 'callers.txt', node.namespace, '--clients', '4', '--patience', '2')
    record.until_answers(20)
    kill(node.process)
    record.check(MAX_AGE_S)
    record.forget()
    joiner = Client(node.namespace)
    born_ns = stamp_ns(joiner.now())  # before the node can answer: to discover it takes longer
    try:
        node.process = start_node(tmp_path / 'second.txt', node.namespace, **PARAMETERS)
        late = Record(joiner)
        node.process.until_it_says('active')
        late.until_answers(20)
        record.until_answers(20)
        for heard in (record, late):
            heard.check(MAX_AGE_S)
            oldest_ns = min(stamp_ns(m.header.stamp) for m in heard.optimal())
            assert oldest_ns > born_ns - 1e9 * MAX_AGE_S
    finally:
        joiner.close()
    callers.until_it_says('recovered')
    counts = callers.counts()
    assert counts['fewest'] > 0 and counts['answered'] + counts['lost'] == counts['asked']
    assert feed.end() == 0

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Clients of the services as a process of its own, so that it can be killed: see ``--help``.

Every client has one question under way, and asks the next when it is answered or given up. Says
'each answered' when every client has had an answer, 'lost' for the first one given up and
'recovered' when the next is answered; at the end a line of JSON with the questions asked, answered
and given up, the result codes and the round trips [ms].
"""

import argparse
from collections import Counter
import json
from pathlib import Path
import signal
import sys
import time

sys.path.insert(0, str(Path(__file__).parents[1] / 'node'))

from grasp_quality_msgs import srv  # noqa: E402
from grasps import contact_array, EIGHT, wrench  # noqa: E402
from msg_adapters import qos  # noqa: E402
import numpy as np  # noqa: E402
import rclpy  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.signals import SignalHandlerOptions  # noqa: E402

OWN = contact_array(EIGHT)
QUESTIONS = {  # every third client brings contacts of its own, the others ask about the latest
    'short': [
        (srv.EvaluateTaskWrench, 'evaluate_task_wrench', {'task_wrench': wrench(fz=1.0)}),
        (srv.MinimumForces, 'minimum_forces', {'external_wrench': wrench(fz=-1.0)}),
        (srv.EvaluateTaskWrench, 'evaluate_task_wrench',
         {'task_wrench': wrench(fx=1.0), 'contacts': OWN})],
    'map': [(srv.WrenchMap, 'wrench_map', {'resolution': 45})]}


class Caller:
    """One client; ``look`` asks and listens."""

    def __init__(self, node, target, question, patience_s, pause_s):
        kind, name, fields = question
        self._client = node.create_client(
            kind, f'{target}/{name}', qos_profile=qos.questions())
        self._request = kind.Request(**fields)
        self._patience_s = patience_s
        self._pause_s = pause_s
        self._under_way = None
        self._asked_at = 0.0
        self.asked = self.lost = 0
        self.last_lost = False
        self.codes = Counter()
        self.took_ms = []

    def look(self, ask_on):
        """Note an answer or give it up, and ask the next question; tell what happened."""
        now = time.monotonic()
        if self._under_way is not None and self._under_way.done():
            self.took_ms.append(1e3 * (now - self._asked_at))
            self.codes[self._under_way.result().result.code] += 1
            self._under_way = None
            said, self.last_lost = 'recovered' if self.last_lost else 'answered', False
            return said
        if self._under_way is not None and now > self._asked_at + self._patience_s:
            self._client.remove_pending_request(self._under_way)
            self._under_way, self.lost, self.last_lost = None, self.lost + 1, True
            return 'lost'
        if self._under_way is None and ask_on and now >= self._asked_at + self._pause_s \
                and self._client.service_is_ready():
            self._under_way, self._asked_at = self._client.call_async(self._request), now
            self.asked += 1
            return 'asked'
        return ''

    @property
    def is_waiting(self):
        """Whether a question is under way."""
        return self._under_way is not None


def main() -> int:
    """Ask until a signal comes; then wait for what is under way and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('target', help='name of the quality node, with its namespace')
    parser.add_argument('--clients', type=int, default=1)
    parser.add_argument('--number', type=int, default=0, help='of the first client')
    parser.add_argument('--questions', choices=QUESTIONS, default='short')
    parser.add_argument('--pause', type=float, default=0.0, help='from one to the next [s]')
    parser.add_argument('--patience', type=float, default=20.0, help='[s]')
    asked = parser.parse_args()
    stopping: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    executor = SingleThreadedExecutor()
    questions = QUESTIONS[asked.questions]
    callers = []
    for number in range(asked.number, asked.number + asked.clients):
        node = rclpy.create_node(f'caller_{number}', start_parameter_services=False)
        executor.add_node(node)
        callers.append(Caller(
            node, asked.target, questions[number % len(questions)], asked.patience, asked.pause))
    said: set[str] = set()
    while not stopping or any(caller.is_waiting for caller in callers):
        for caller in callers:
            event = caller.look(ask_on=not stopping)
            if event and event not in said:
                print(event, flush=True)
                said.add(event)
        if 'each answered' not in said and all(caller.took_ms for caller in callers):
            print('each answered', flush=True)
            said.add('each answered')
        executor.spin_once(timeout_sec=0.01)
    took_ms = np.concatenate([caller.took_ms for caller in callers])
    print(json.dumps({
        'asked': sum(c.asked for c in callers), 'answered': len(took_ms),
        'lost': sum(c.lost for c in callers), 'fewest': min(len(c.took_ms) for c in callers),
        'codes': sum((c.codes for c in callers), Counter()),
        'ms': np.percentile(took_ms, [50, 99, 99.9, 100]).tolist() if len(took_ms) else []}),
        flush=True)
    executor.shutdown()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

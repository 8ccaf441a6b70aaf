# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Who sees all that a node receives and says, and what its process takes: for load and soak.

Times are those at which messages were sent, which the middleware writes beside them. A sample that
got no answer was either lost on the way or replaced by a newer one at depth 1. On one machine the
only place to lose it is a full socket buffer, and Linux counts that for every socket.
"""

from pathlib import Path
import struct
import sys
import time

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / 'test' / 'node'), str(ROOT / 'test' / 'reliability')]

from geometry_msgs.msg import PoseArray  # noqa: E402
from grasp_quality_hand.by_hand import ByHand  # noqa: E402
from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode  # noqa: E402
from harness import Client  # noqa: E402
from msg_adapters.stamps import stamp_ns  # noqa: E402
import numpy as np  # noqa: E402
from rclpy.qos import QoSProfile, ReliabilityPolicy  # noqa: E402

DEEP = 10_000
SENSOR = QoSProfile(depth=DEEP, reliability=ReliabilityPolicy.BEST_EFFORT)


class Witness:
    """
    Samples and answers of one node.

    Attributes
    ----------
    samples : dict of stamp [ns]: when sent [ns]
    answers : list of (stamp [ns], when sent [ns]), OPTIMAL
    failures : list of (code, when sent [ns])
    broken : list of sentences, one for each promise that was not kept

    """

    def __init__(self, namespace, max_age_s, allowance_s):
        self.client = Client(namespace)
        self.samples = {}
        self.answers, self.failures, self.broken = [], [], []
        self._oldest_s = max_age_s + allowance_s
        target, node, by_hand = self.client.target, self.client.node, ByHand()
        self._subscriptions = [(node.create_subscription(
            kind, f'{target}/{topic}', lambda message: None, profile, raw=raw,
            callback_group=by_hand), receive) for kind, topic, receive, profile, raw in (
                (PoseArray, 'contact_poses', self._sample, SENSOR, True),
                (GraspQuality, 'quality', self._quality, DEEP, False),
                (ContactForceArray, 'contact_forces', self._forces, DEEP, False))]

    def take(self):
        """Take in what has come."""
        for subscription, receive in self._subscriptions:
            with subscription.handle:
                while taken := subscription.handle.take_message(
                        subscription.msg_type, subscription.raw):
                    receive(taken[0], taken[1]['source_timestamp'])

    def watch(self, seconds):
        """Take in what comes for a while."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            self.client.spin_once(min(left, 0.02))
            self.take()

    def until(self, condition, what):
        """Take in what comes until a condition holds."""
        def holds():
            self.take()
            return condition()
        self.client.until(holds, what)

    def _sample(self, data, sent_ns):
        sec, nanosec = struct.unpack_from('<iI', data, 4)  # behind the head of CDR: the stamp
        self.samples.setdefault(10 ** 9 * sec + nanosec, sent_ns)

    def _quality(self, message, sent_ns):
        stamp = stamp_ns(message.header.stamp)
        if message.result.code != ResultCode.OPTIMAL:
            self.failures.append((message.result.code, sent_ns))
            if message.alpha or message.alpha_upper or not message.result.message:
                self.broken.append(f'a failure with alpha {message.alpha}')
            return
        if self.answers and stamp < self.answers[-1][0]:
            self.broken.append(f'an answer went back by {self.answers[-1][0] - stamp} ns')
        self.answers.append((stamp, sent_ns))

    def _forces(self, message, sent_ns):
        age_s = (sent_ns - stamp_ns(message.header.stamp)) * 1e-9
        if message.forces and age_s > self._oldest_s:
            self.broken.append(f'forces were published {age_s:.3f} s after their contacts')

    def newest_is_answered(self):
        """Whether the newest sample seen has an answer."""
        return bool(self.samples and self.answers
                    and self.answers[-1][0] >= next(reversed(self.samples)))

    def delays_ms(self, windows):
        """Return from the sending of contacts to that of their first answer, in some windows."""
        first = {}
        for stamp, sent_ns in self.answers:
            first.setdefault(stamp, sent_ns)
        return 1e-6 * np.array([
            sent_ns - self.samples[stamp] for stamp, sent_ns in first.items()
            if stamp in self.samples and inside(self.samples[stamp], windows)])

    def counts(self, windows):
        """Return how many samples were sent in some windows, and how many of them answered."""
        sent = {s for s, sent_ns in self.samples.items() if inside(sent_ns, windows)}
        return len(sent), len(sent & {stamp for stamp, _ in self.answers})


def inside(time_ns, windows):
    """Tell whether a time lies in one of the windows."""
    return any(begin <= time_ns <= end for begin, end in windows)


def resident_mb(pid):
    """Return the resident memory of a process [MB], shape (3,): its own, of files, shared."""
    lines = Path(f'/proc/{pid}/status').read_text().splitlines()
    status = dict(line.split(':', 1) for line in lines)
    return 1.024e-3 * np.array([
        int(status[kind].split()[0]) for kind in ('RssAnon', 'RssFile', 'RssShmem')])

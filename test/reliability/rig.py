# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the fault tests share: publishers that are processes, and a record of what was said."""

from pathlib import Path
import sys
import time

from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
from harness import Process
from msg_adapters.stamps import stamp_ns
from rclpy.qos import QoSProfile

MAX_AGE_S = 1.0    # max_contact_age of the node that the tests share
ALLOWANCE_S = 0.05  # as of the audit: from the last look at the clock to the writing of a message
TASK = '[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]'
HERE = Path(__file__).parent
DEEP = QoSProfile(depth=10_000)


def start_feed(log, namespace, *options):
    """Start a process that publishes contacts, once it does."""
    feed = Process([sys.executable, HERE / 'contact_feed.py', f'{namespace}/grasp_quality',
                    *options], log)
    feed.until_it_says('publishing')
    return feed


def faulty(fault):
    """Return what starts ``faulty_node.py``, whose solver fails as the file ``fault`` says."""
    def start_faulty(log, namespace, **parameters):
        command = [sys.executable, HERE / 'faulty_node.py', '--ros-args', '-r',
                   f'__ns:={namespace}']
        for name, value in parameters.items():
            command += ['-p', f'{name}:={value}']
        return Process(command, log, environment={'SOLVER_FAULT': str(fault)})
    return start_faulty


def inject(node, fault):
    """Replace the file ``node.fault`` at once: half a word is no fault."""
    new = node.fault.with_suffix('.new')
    Path(new).write_text(fault)
    new.replace(node.fault)


def kill(process):
    """End a process as ``kill -9`` does."""
    process.popen.kill()
    process.popen.wait()


class Record:
    """All that a node says from now on: (message, when it was sent [ns]), in order."""

    def __init__(self, client):
        self._client = client
        self._begin_ns = time.time_ns()
        self.quality = self._listen(GraspQuality, 'quality')
        self.forces = self._listen(ContactForceArray, 'contact_forces')

    def _listen(self, kind, topic):
        heard = []
        subscription = self._client.node.create_subscription(
            kind, f'{self._client.target}/{topic}',
            lambda message, info: self._hear(heard, message, info['source_timestamp']), DEEP)
        self._client.until(subscription.get_publisher_count, f'a publisher of {topic}')
        return heard

    def _hear(self, heard, message, sent_ns):
        if sent_ns >= self._begin_ns:
            heard.append((message, sent_ns))

    def forget(self):
        """Drop what was sent until now."""
        self._begin_ns = time.time_ns()
        self.quality.clear()
        self.forces.clear()

    def optimal(self):
        """Return the OPTIMAL qualities."""
        return [m for m, _ in self.quality if _is_optimal(m)]

    def until_answers(self, count, feed=None):
        """Wait for as many more OPTIMAL qualities."""
        known = len(self.quality)
        self._client.until(
            lambda: sum(_is_optimal(m) for m, _ in self.quality[known:]) >= count,
            f'{count} answers', feed)

    def until_failure(self, code, feed=None):
        """Wait for a code behind the last answer; return how long after its contacts it came."""
        def found():
            behind_ns = None
            for message, sent_ns in reversed(self.quality):
                if _is_optimal(message):
                    sensed_ns = stamp_ns(message.header.stamp) or sent_ns
                    return None if behind_ns is None else (behind_ns - sensed_ns) * 1e-9
                if message.result.code == code:
                    behind_ns = sent_ns
            return None
        return self._client.until(found, f'result code {code} behind an answer', feed)

    def check(self, max_age_s):
        """Assert what holds whatever happens to contacts: nothing old, and no way back."""
        stamps = [stamp_ns(m.header.stamp) for m in self.optimal()]
        assert stamps == sorted(stamps)
        for message, sent_ns in self.forces:
            if message.forces and stamp_ns(message.header.stamp):
                age_s = (sent_ns - stamp_ns(message.header.stamp)) * 1e-9
                assert age_s <= max_age_s + ALLOWANCE_S
        for message, _ in self.quality:
            if message.result.code != ResultCode.OPTIMAL:
                assert message.alpha == message.alpha_upper == message.friction_margin == 0.0
                assert message.result.message


def _is_optimal(message):
    return message.result.code == ResultCode.OPTIMAL


def positions(poses):
    """Return the points of poses, or of forces, as a set."""
    return {(p.position.x, p.position.y, p.position.z) for p in poses}

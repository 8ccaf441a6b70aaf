# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Independent check of every contact force that a quality node publishes.

Listens to the inputs and outputs of one node (parameter ``target``), and judges them by
``force_records`` and ``force_rules``, which share no code with that node. Violations go to the log
and to /diagnostics; the process ends with code 1 when it has seen one, with 2 when it has judged
nothing. It sends nothing to hands.
"""

from collections.abc import Callable
import dataclasses
import functools
import math
import re
import signal
import sys
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_hand import audit_messages
from grasp_quality_hand.audit_parameters import ParameterQuestions, steady_times
from grasp_quality_hand.audit_parts import Forces
from grasp_quality_hand.audit_sequence import Sequence
from grasp_quality_hand.by_hand import ByHand
from grasp_quality_hand.force_records import ForceRecords
from grasp_quality_msgs.msg import ContactArray, ContactForceArray, GraspQuality
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent
import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Float64

INPUT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
OUTPUT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
JUDGE_PERIOD_S = 0.2
TAKING_S = 0.1  # of one topic in a row: a busy machine may fill it faster than it is read
REPORT_PERIOD_S = 1.0
PLAIN_NAME = re.compile('[A-Za-z_][A-Za-z0-9_]*')  # others make no topic
MOST_NAMES = 256  # of contacts whose wrenches are listened to
SHOWN = 10  # violations in a report


class ForceAuditNode(Node):
    """Listens and judges; ``records.count`` tells what it has seen."""

    def __init__(self) -> None:
        super().__init__('force_audit')
        self.target = '/' + self.declare_parameter(
            'target', 'grasp_quality', ParameterDescriptor(
                description='node whose forces are checked, with its namespace', read_only=True)
        ).value.strip('/')
        self.records = ForceRecords(self.declare_parameter(
            'age_allowance', 0.05, ParameterDescriptor(
                description='how much older than max_contact_age contacts may be when forces '
                            'are sent [s]', read_only=True)).value)
        self._recent: list[str] = []
        self._holding = False
        self._by_hand = ByHand()
        self._takes: list[Callable[[], bool]] = []
        self._wrench_topics: set[str] = set()
        self._too_many_names = False
        self._most_publishers = 0  # of contact_forces at one time
        self._questions = ParameterQuestions(self, self.target, self.records.store)
        self._diagnostics = self.create_publisher(DiagnosticArray, '/diagnostics', 10)
        self._take_from(ParameterEvent, '/parameter_events', OUTPUT, self._questions.change)
        for kind, topic, profile, read in (
                (PoseArray, 'contact_poses', INPUT, audit_messages.read_poses),
                (ContactArray, 'contacts', INPUT, audit_messages.read_contacts),
                (GraspQuality, 'quality', OUTPUT, audit_messages.read_quality),
                (ContactForceArray, 'contact_forces', OUTPUT, self._read_forces),
                (Float64, 'alpha', OUTPUT, audit_messages.read_alpha)):
            self._listen(kind, topic, profile, read)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(JUDGE_PERIOD_S, self._judge, clock=steady)
        self.create_timer(REPORT_PERIOD_S, self._report, clock=steady)

    def _listen(self, kind: Any, topic: str, profile: QoSProfile,
                read: Callable[[Any, int], object]) -> None:
        sequence = Sequence()

        def store(message: Any, sent_ns: int, number: int | None) -> None:
            now_s, sent_s = steady_times(sent_ns)
            lost_since_s = sequence.lost_since(number, sent_s)
            try:
                self.records.store(read(message, sent_ns), now_s, sent_s, lost_since_s)
            except Exception as exc:
                self.records.count.violations += 1  # what cannot be read cannot be trusted
                self._tell(f'{topic} could not be read: {type(exc).__name__}: {exc}')
        self._take_from(kind, f'{self.target}/{topic}', profile, store)

    def _take_from(self, kind: Any, topic: str, profile: QoSProfile,
                   receive: Callable[[Any, int, int | None], object]) -> None:
        subscription = self.create_subscription(
            kind, topic, lambda message: None, profile, callback_group=self._by_hand)

        def take() -> bool:
            with subscription.handle:
                taken = subscription.handle.take_message(kind, False)
            if taken is not None:
                receive(taken[0], taken[1]['source_timestamp'],
                        taken[1]['publication_sequence_number'])
            return taken is not None
        self._takes.append(take)

    def _read_forces(self, message: ContactForceArray, sent_ns: int) -> Forces:
        for item in message.forces:
            if item.name in self._wrench_topics or not PLAIN_NAME.fullmatch(item.name):
                continue
            if len(self._wrench_topics) < MOST_NAMES:
                self._wrench_topics.add(item.name)
                self._listen(WrenchStamped, f'optimal_wrenches/{item.name}', OUTPUT,
                             functools.partial(audit_messages.read_wrench, item.name))
            elif not self._too_many_names:
                self._too_many_names = True
                self.records.count.violations += 1
                self._tell(f'more than {MOST_NAMES} contact names')
        forces = audit_messages.read_forces(message, sent_ns)
        if self.get_parameter('use_sim_time').value:  # stamps and sending are of two clocks
            forces = dataclasses.replace(forces, age_s=None)
        return forces

    def _read_holding(self, message: ContactForceArray, sent_ns: int) -> Forces:
        return dataclasses.replace(self._read_forces(message, sent_ns), are_holding=True)

    def _judge(self) -> None:
        now_s = time.monotonic()  # reading takes time: what came meanwhile waits for the next
        self._questions.ask()
        changes, *others = self._takes  # all changes of parameters, before and after the others
        for take in (changes, *others, changes):
            end_s = math.inf if take is changes else time.monotonic() + TAKING_S
            while take() and time.monotonic() < end_s:
                pass
        # the node works them out for listeners only: listen where somebody else does
        if not self._holding and self.count_subscribers(f'{self.target}/holding_forces'):
            self._holding = True
            self._listen(ContactForceArray, 'holding_forces', OUTPUT, self._read_holding)
        self._most_publishers = max(
            self._most_publishers, self.count_publishers(f'{self.target}/contact_forces'))
        # a process takes longer than that to start: no other was there before the next question
        for text in self.records.judge(now_s, self._questions.sure_s + JUDGE_PERIOD_S):
            self._tell(text)

    def _tell(self, text: str) -> None:
        self.get_logger().error(f'VIOLATION: {text}')
        self._recent = [*self._recent, text][-SHOWN:]

    def summary(self) -> str:
        """Say in one line what was seen."""
        count = self.records.count
        missing = ', '.join(f'{n} without {what}' for what, n in count.unjudged.items())
        return (f'{count.judged or "no"} force sets judged, {count.violations} violations'
                + (f', not judged: {missing}' if missing else '')
                + (f', {self._most_publishers} publishers of contact_forces at one time'
                   if self._most_publishers > 1 else '')
                + ('' if count.judged else f': is {self.target} the node, active, with a task?'))

    def _report(self) -> None:
        violated = bool(self.records.count.violations)
        status = DiagnosticStatus(
            level=DiagnosticStatus.ERROR if violated else (
                DiagnosticStatus.WARN if self.records.count.unjudged or self._most_publishers > 1
                else DiagnosticStatus.OK),
            name=f'{self.get_name()}: {self.target}', message=self.summary(),
            hardware_id=self.target,
            values=[KeyValue(key=f'violation {i}', value=t) for i, t in enumerate(self._recent)])
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)


def main(args: list[str] | None = None) -> int:
    """Listen until SIGINT or SIGTERM; return 1 for a broken rule, 2 when nothing was judged."""
    stopping: list[int] = []
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    node = ForceAuditNode()
    node.get_logger().info(f'listening to {node.target}')
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stopping:
        executor.spin_once(timeout_sec=JUDGE_PERIOD_S)
    node._judge()
    print(node.summary(), flush=True)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown()
    return 1 if node.records.count.violations else 0 if node.records.count.judged else 2


if __name__ == '__main__':
    sys.exit(main())

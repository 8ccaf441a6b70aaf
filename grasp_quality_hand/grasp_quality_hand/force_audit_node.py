# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Independent check of every contact force that a quality node publishes.

Listens to the inputs and outputs of one node (parameter ``target``), and judges them by
``force_records`` and ``force_rules``, which share no code with that node. Violations go to the log
and to /diagnostics; the process ends with code 1 when it has seen one. It sends nothing to hands.
"""

from collections.abc import Callable
import dataclasses
import re
import signal
import sys
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_hand import audit_messages
from grasp_quality_hand.audit_parts import Forces, Settings
from grasp_quality_hand.force_records import ForceRecords
from grasp_quality_msgs.msg import ContactArray, ContactForceArray, GraspQuality
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent
from rcl_interfaces.srv import GetParameters
import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Float64

INPUT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
OUTPUT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
JUDGE_PERIOD_S = 0.2
REPORT_PERIOD_S = 1.0
PLAIN_NAME = re.compile('[A-Za-z_][A-Za-z0-9_]*')  # others make no topic
SHOWN = 10  # violations in a report
PARAMETERS = tuple(field.name for field in dataclasses.fields(Settings))


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
        self._asked: Any = None
        self._settings: Settings | None = None
        self._holding = False
        self._wrench_topics: set[str] = set()
        self._parameter_client = self.create_client(GetParameters, f'{self.target}/get_parameters')
        self._diagnostics = self.create_publisher(DiagnosticArray, '/diagnostics', 10)
        for kind, topic, profile, read in (
                (PoseArray, 'contact_poses', INPUT, audit_messages.read_poses),
                (ContactArray, 'contacts', INPUT, audit_messages.read_contacts),
                (GraspQuality, 'quality', OUTPUT, audit_messages.read_quality),
                (ContactForceArray, 'contact_forces', OUTPUT, self._read_forces),
                (Float64, 'alpha', OUTPUT, audit_messages.read_alpha)):
            self._listen(kind, topic, profile, read)
        self.create_subscription(ParameterEvent, '/parameter_events', self._change, OUTPUT)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(JUDGE_PERIOD_S, self._judge, clock=steady)
        self.create_timer(REPORT_PERIOD_S, self._report, clock=steady)

    def _listen(self, kind: Any, topic: str, profile: QoSProfile,
                read: Callable[[Any, int], object]) -> None:
        def receive(message: Any, info: Any) -> None:
            try:
                self.records.store(read(message, info['source_timestamp']), time.monotonic())
            except Exception as exc:
                self.records.count.violations += 1  # what cannot be read cannot be trusted
                self._tell(f'{topic} could not be read: {type(exc).__name__}: {exc}')
        self.create_subscription(kind, f'{self.target}/{topic}', receive, profile)

    def _read_forces(self, message: ContactForceArray, sent_ns: int) -> Forces:
        for item in message.forces:
            if item.name not in self._wrench_topics and PLAIN_NAME.fullmatch(item.name):
                self._wrench_topics.add(item.name)
                self._listen(WrenchStamped, f'optimal_wrenches/{item.name}', OUTPUT,
                             audit_messages.read_wrench)
        forces = audit_messages.read_forces(message, sent_ns)
        if self.get_parameter('use_sim_time').value:  # stamps and sending are of two clocks
            forces = dataclasses.replace(forces, age_s=None)
        return forces

    def _read_holding(self, message: ContactForceArray, sent_ns: int) -> Forces:
        return dataclasses.replace(self._read_forces(message, sent_ns), are_holding=True)

    def _judge(self) -> None:
        self._ask()
        # the node works them out for listeners only: listen where somebody else does
        if not self._holding and self.count_subscribers(f'{self.target}/holding_forces'):
            self._holding = True
            self._listen(ContactForceArray, 'holding_forces', OUTPUT, self._read_holding)
        for text in self.records.judge(time.monotonic()):
            self._tell(text)

    def _tell(self, text: str) -> None:
        self.get_logger().error(f'VIOLATION: {text}')
        self._recent = [*self._recent, text][-SHOWN:]

    def _ask(self) -> None:
        """Ask the node for its parameters, time and again: it may be started anew."""
        if self._asked is not None and self._asked.done():
            values = [parameter_value_to_python(v) for v in self._asked.result().values]
            if len(values) == len(PARAMETERS):
                values = [tuple(v or ()) if name in ('contact_names', 'contact_fingers') else v
                          for name, v in zip(PARAMETERS, values)]
                self._hold(Settings(*values))
            self._asked = None
        if not self._parameter_client.service_is_ready():
            self._asked = None  # an answer of a node that is gone never comes
        elif self._asked is None:
            request = GetParameters.Request(names=PARAMETERS)
            self._asked = self._parameter_client.call_async(request)

    def _change(self, event: ParameterEvent) -> None:
        """Note each change of parameters as it is made: many may lie between two questions."""
        if event.node == self.target and self._settings is not None:
            changes = {p.name: parameter_value_to_python(p.value)
                       for p in event.changed_parameters if p.name in PARAMETERS}
            self._hold(dataclasses.replace(self._settings, **changes))

    def _hold(self, settings: Settings) -> None:
        self._settings = settings
        self.records.store(settings, time.monotonic())

    def summary(self) -> str:
        """Say in one line what was seen."""
        count = self.records.count
        missing = ', '.join(f'{n} without {what}' for what, n in count.unjudged.items())
        return (f'{count.judged} force sets judged, {count.violations} violations'
                + (f', not judged: {missing}' if missing else ''))

    def _report(self) -> None:
        violated = bool(self.records.count.violations)
        status = DiagnosticStatus(
            level=DiagnosticStatus.ERROR if violated else (
                DiagnosticStatus.WARN if self.records.count.unjudged else DiagnosticStatus.OK),
            name=f'{self.get_name()}: {self.target}', message=self.summary(),
            hardware_id=self.target,
            values=[KeyValue(key=f'violation {i}', value=t) for i, t in enumerate(self._recent)])
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)


def main(args: list[str] | None = None) -> int:
    """Listen until SIGINT or SIGTERM; return 1 when a rule was broken."""
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
    return int(node.records.count.violations > 0)


if __name__ == '__main__':
    sys.exit(main())

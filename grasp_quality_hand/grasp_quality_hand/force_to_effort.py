# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Node force_to_effort: contact forces and joint states in, joint efforts out.

A ros2_control JointGroupEffortController holds its last command for ever; so this node commands
at its own rate and never stops once it has begun: without good forces it goes to holding efforts,
and on SIGINT or SIGTERM it gets there before it ends.
"""

from collections.abc import Callable
import signal
import sys
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped
from grasp_quality_hand.contact_pushes import Pushes
from grasp_quality_hand.effort_bridge import FramedPushes, Joints, ObjectPose, Report
from grasp_quality_hand.effort_command import Phase
from grasp_quality_hand.effort_inputs import Now
from grasp_quality_hand.force_to_effort_parameters import declare, make_bridge
from grasp_quality_hand.hand_kinematics import BadHand
from grasp_quality_msgs.msg import ContactForceArray
from msg_adapters.errors import InvalidMessageError
from msg_adapters.poses import pose_arrays
from msg_adapters.qos import newest_command, newest_sample
from msg_adapters.received import read_forces, read_joint_state
from msg_adapters.stamps import stamp_ns
import numpy as np
from numpy.typing import NDArray
import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

NONE = Pushes((), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3)))
REPORT_PERIOD_S = 1.0
FLUSH_S = 0.5
ENDING_EXTRA_S = 0.5  # beyond the ramp, after which the node ends anyhow
LARGEST_MESSAGE = 65536  # [bytes]; unpacking a larger one would delay the commands


class ForceToEffort(Node):
    """The thin ROS side of an EffortBridge."""

    def __init__(self) -> None:
        super().__init__('force_to_effort')
        values = declare(self)
        self._bridge, self._hand = make_bridge(values)
        self.ramp_time = float(values['ramp_time'])
        self.report: Report | None = None
        self._told = ('', 0.0)
        self._commands = 0
        self._largest_share = 0.0
        self._bad = ''
        self._publisher = self.create_publisher(
            Float64MultiArray, 'effort_controller/commands', newest_command())
        self._diagnostics = self.create_publisher(DiagnosticArray, '/diagnostics', 10)
        self._listen(ContactForceArray, 'grasp_quality/contact_forces', self._on_forces,
                     newest_command(), self._refuse_forces)
        self._listen(JointState, 'joint_states', self._on_joints, newest_sample(),
                     self._bridge.joints.refuse)
        self._listen(PoseStamped, 'object_pose', self._on_pose, newest_sample(),
                     self._bridge.poses.refuse)
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # a clock set back must not stop it
        self.create_timer(1.0 / values['rate'], self._guarded(self._on_tick), clock=steady)
        self.create_timer(REPORT_PERIOD_S, self._guarded(self._tell), clock=steady)

    def _listen(self, kind: Any, topic: str, callback: Callable[[Any, Now, float], None],
                qos: Any, refuse: Callable[[str], None]) -> None:
        """Call back with a message, now, and how long ago it was sent [s]."""
        def receive(packed: bytes, sent_ns: int) -> None:
            try:
                if len(packed) > LARGEST_MESSAGE:
                    raise InvalidMessageError(
                        f'{topic}: {len(packed)} bytes, more than {LARGEST_MESSAGE}')
                callback(deserialize_message(packed, kind), *self._when(sent_ns))
            except InvalidMessageError as error:
                refuse(str(error))
                raise
        guarded = self._guarded(receive)
        self.create_subscription(
            kind, topic, lambda packed, info: guarded(packed, info['source_timestamp']), qos,
            raw=True)

    def _guarded(self, callback: Callable[..., None]) -> Callable[..., None]:
        """Let no exception out of a callback; a message that cannot be used is not there."""
        def run(*arguments: Any) -> None:
            try:
                callback(*arguments)
            except Exception as error:
                self._bad = f'{type(error).__name__}: {error}'
                self.get_logger().error(self._bad, throttle_duration_sec=1.0)
        return run

    def _now(self) -> Now:
        return Now(self.get_clock().now().nanoseconds, time.monotonic())

    def _when(self, sent_ns: int) -> tuple[Now, float]:
        """Return now, and for how long a message has been under way [s], by its sender's clock."""
        now = self._now()  # first: a stop in between makes it older, not younger
        return now, max(0.0, (time.time_ns() - sent_ns) * 1e-9) if sent_ns > 0 else 0.0

    def _refuse_forces(self, why: str) -> None:
        """Hold: whoever sends such forces has no good ones."""
        self._bridge.forces.put(FramedPushes('', NONE, f'bad contact forces: {why}'), 0,
                                self._now())
        self._bridge.forces.refuse(why)

    def _on_forces(self, message: ContactForceArray, now: Now, waited_s: float) -> None:
        self._bridge.check_count(len(message.forces))
        names, points, wrenches = read_forces(message)
        pushes = Pushes(names, points, wrenches[:, :3], wrenches[:, 3:])
        # a failure may bear the sender's clock instead of a sensor's: it is never late
        stamp = stamp_ns(message.header.stamp) if names else 0
        self._bridge.forces.put(
            FramedPushes(message.header.frame_id, pushes), stamp, now, waited_s)

    def _on_joints(self, message: JointState, now: Now, waited_s: float) -> None:
        if set(message.name).isdisjoint(self._hand.movable):
            return  # of an arm on the same topic
        joints = Joints(*read_joint_state(message, self._hand.movable, self._hand.joints))
        self._bridge.joints.put(joints, stamp_ns(message.header.stamp), now, waited_s)

    def _on_pose(self, message: PoseStamped, now: Now, waited_s: float) -> None:
        p, R = pose_arrays(message.pose, 'pose')
        self._bridge.poses.put(ObjectPose(message.header.frame_id, R, np.asarray(p)),
                               stamp_ns(message.header.stamp), now, waited_s)

    def _on_tick(self) -> None:
        efforts, self.report = self._bridge.tick(self._now())
        if efforts is not None:
            self._publisher.publish(Float64MultiArray(data=efforts.tolist()))
            self._count(efforts)
        if self.report.phase.value != self._told[0]:
            self._tell()

    def _count(self, efforts: NDArray[np.float64]) -> None:
        self._commands += 1
        share = float(np.abs(efforts / self._hand.effort_limits).max())
        self._largest_share = max(self._largest_share, share)

    def _tell(self) -> None:
        """Publish the state; log a change of it."""
        if self.report is None:
            return
        report, (last, since) = self.report, self._told
        elapsed = max(time.monotonic() - since, 1e-9) if since else REPORT_PERIOD_S
        status = DiagnosticStatus(
            name=f'{self.get_name()}: joint efforts', hardware_id=self._hand.base_frame,
            message=': '.join(filter(None, [report.phase.value, report.reason])),
            level=_level(report))
        if 0.0 < report.scale < 1.0:
            status.message += (f'; forces scaled to {100.0 * report.scale:.3g} % to stay within '
                               'the effort limits')
        now, bridge = self._now(), self._bridge
        values = {
            'phase': report.phase.name, 'scale of the forces': f'{report.scale:.4g}',
            'largest share of an effort limit': f'{self._largest_share:.4g}',
            'commands per second': f'{self._commands / elapsed:.1f}',
            **{f'age of {name} [s]': f'{age:.3g}' for name, age in bridge.ages(now).items()},
            'late messages dropped': str(
                bridge.forces.dropped + bridge.joints.dropped + bridge.poses.dropped),
            'last bad message': self._bad}
        status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
        message = DiagnosticArray(status=[status])
        message.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(message)
        if report.phase.value != last:  # a line of code may log with one severity only
            if report.phase is Phase.FOLLOWING:
                self.get_logger().info(status.message)
            else:
                self.get_logger().warning(status.message)
        self._told = (report.phase.value, time.monotonic())
        self._commands, self._largest_share = 0, 0.0

    def end(self) -> None:
        """Follow nothing any more: go to the holding efforts."""
        self._bridge.ending = 'the node is ending'

    def spin_once(self, executor: SingleThreadedExecutor) -> None:
        """Run what is ready; what rclpy itself raises must not end the commands."""
        try:
            executor.spin_once(timeout_sec=0.1)
        except Exception as error:
            self.get_logger().error(
                f'the executor raised {type(error).__name__}: {error}', throttle_duration_sec=1.0)

    def flush(self) -> None:
        """See the last command delivered: destroying a publisher drops what is under way."""
        self._publisher.wait_for_all_acked(Duration(seconds=FLUSH_S))


def _level(report: Report) -> bytes:
    if report.phase is Phase.FOLLOWING and report.scale == 1.0:
        return bytes(DiagnosticStatus.OK)
    if report.blind and report.phase in (Phase.RAMPING, Phase.HOLDING):
        return bytes(DiagnosticStatus.ERROR)
    return bytes(DiagnosticStatus.WARN)


def main(args: list[str] | None = None) -> int:
    """Run the node until a signal comes and the hand holds; return the exit code."""
    stopping: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
        node = ForceToEffort()
    except (BadHand, rclpy.exceptions.ParameterException) as error:
        print(f'force_to_effort: {error}', file=sys.stderr)
        rclpy.try_shutdown()
        return 1
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stopping:
        node.spin_once(executor)
    node.end()
    deadline = time.monotonic() + node.ramp_time + ENDING_EXTRA_S
    while time.monotonic() < deadline and (
            node.report is None or node.report.phase in (Phase.FOLLOWING, Phase.RAMPING)):
        node.spin_once(executor)
    node.flush()
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Node holding_load: where the object is in, what the fingers have to balance out.

Publishes the external wrench of grasp_quality: the object's weight, less what a spring between the
object and its place asks the fingers for. Its place is where it was when the node heard of it
first, or when ~/hold_here was called last. A pose in another frame than `pose_frame`, one that is
older than `max_pose_age` or stamped ahead of the clock by more, and one older than the last are
told in the log and answered with nothing: the load of a wrong pose would move the fingers.
"""

import signal
import sys
import time
from typing import Any

from geometry_msgs.msg import PoseStamped, WrenchStamped
from grasp_quality_hand.hand_kinematics import EARTH
from grasp_quality_hand.object_spring import ObjectSpring, weight
from msg_adapters.errors import InvalidMessageError
from msg_adapters.poses import pose_arrays
from msg_adapters.qos import newest_command, newest_sample
from msg_adapters.stamps import stamp_ns
from msg_adapters.wrenches import to_wrench
import numpy as np
from numpy.typing import NDArray
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import Trigger

Array = NDArray[np.float64]
NUMBERS = {'mass': (0.2, 'Of the object [kg]', 1e3),
           'stiffness': (300.0, 'Of the spring [N/m]', 1e6),
           'rotational_stiffness': (0.5, 'Of the spring [N m/rad]', 1e6),
           'max_force': (2.0, 'That the spring asks for at most [N]', 1e6),
           'max_torque': (0.02, 'That the spring asks for at most [N m]', 1e6),
           'max_pose_age': (0.1, 'Of a pose, by its stamp, or by its sending if it has none [s]',
                            10.0)}
MOST_GRAVITY = 100.0  # [m/s^2]


class ParameterError(ValueError):
    """A parameter that no load can be worked out with; the message says which and why."""


class PoseError(ValueError):
    """A pose that must not be answered; the message says why."""


class PoseGate:
    """Lets poses of one frame pass that are fresh and in order."""

    def __init__(self, frame: str, max_age: float) -> None:
        self._frame, self._max_age_ns = frame, round(1e9 * max_age)
        self._last_ns = {True: 0, False: 0}  # of stamps, and of sending where there are none

    def check(self, frame: str, stamp: int, sent: int, now: int, wall: int) -> None:
        """
        Raise PoseError for a pose of another frame, too old, ahead of the clock, or late.

        ``stamp`` (0: none) and ``now`` are of the ROS clock, ``sent`` and ``wall`` of the system's
        [ns].

        """
        if frame != self._frame:
            raise PoseError(f'pose: its frame is {frame!r}, not the pose_frame {self._frame!r}')
        taken, now = (stamp, now) if stamp else (sent, wall)
        if abs(now - taken) > self._max_age_ns:
            raise PoseError(f'pose: {1e-9 * (now - taken):.3f} s old, max_pose_age is '
                            f'{1e-9 * self._max_age_ns:g} s')
        last = self._last_ns[bool(stamp)]  # one that is not fresh now came before a clock's jump
        if taken < last and abs(now - last) <= self._max_age_ns:
            raise PoseError(f'pose: {1e-9 * (last - taken):.3f} s older than the last')
        self._last_ns[bool(stamp)] = taken


class HoldingLoad(Node):
    """Answers every pose of the object with the load."""

    def __init__(self) -> None:
        super().__init__('holding_load')
        values = {name: self.declare_parameter(name, default, ParameterDescriptor(
            description=text, read_only=True, floating_point_range=[
                FloatingPointRange(from_value=0.0, to_value=largest)])).value
            for name, (default, text, largest) in NUMBERS.items()}
        for name, value in values.items():
            if not np.isfinite(value):  # what ranges let pass
                raise ParameterError(f'{name} must be finite, not {value}')
        self._mass = float(values.pop('mass'))
        max_age = float(values.pop('max_pose_age'))
        self._spring = ObjectSpring(**values)
        self._gate = PoseGate(self.declare_parameter('pose_frame', 'base', ParameterDescriptor(
            description='that the poses must stand in, as gravity does',
            read_only=True)).value, max_age)
        self._gravity = np.array(self.declare_parameter(
            'gravity', list(EARTH), ParameterDescriptor(
                description='in the frame that the poses stand in [m/s^2]',
                read_only=True)).value)
        if self._gravity.shape != (3,) or not np.abs(self._gravity).max() <= MOST_GRAVITY:
            raise ParameterError(f'gravity must be 3 numbers of at most {MOST_GRAVITY:g} m/s^2, '
                                 f'not {self._gravity.tolist()}')
        self._place: tuple[Array, Array] | None = None
        self._publisher = self.create_publisher(
            WrenchStamped, 'grasp_quality/external_wrench', newest_command())
        self.create_subscription(PoseStamped, 'object_pose', self._on_pose, newest_sample())
        self.create_service(Trigger, '~/hold_here', self._on_hold_here)

    def _on_pose(self, message: PoseStamped, info: dict[str, Any]) -> None:
        try:
            p, R = pose_arrays(message.pose, 'pose')
            self._gate.check(
                message.header.frame_id, stamp_ns(message.header.stamp), info['source_timestamp'],
                self.get_clock().now().nanoseconds, time.time_ns())
            R0, p0 = self._place or (R, p)
            load = weight(self._mass, self._gravity, R) - self._spring.wrench(R0, p0, R, p)
            if not np.isfinite(load).all():
                raise PoseError(f'pose: no load is known at {p.tolist()}')
        except (InvalidMessageError, PoseError) as error:
            self.get_logger().warning(str(error), throttle_duration_sec=1.0)
            return
        self._place = R0, p0
        answer = WrenchStamped()
        answer.header.stamp = message.header.stamp  # an empty frame is the object's
        to_wrench(load, answer.wrench)
        self._publisher.publish(answer)

    def _on_hold_here(self, request: Any, response: Any) -> Any:
        self._place = None
        response.success, response.message = True, 'the next pose of the object is its place'
        return response


def main(args: list[str] | None = None) -> int:
    """Run the node until SIGINT or SIGTERM; return the exit code."""
    stopping: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
        node = HoldingLoad()
    except (rclpy.exceptions.ParameterException, ParameterError) as error:
        print(f'holding_load: {error}', file=sys.stderr)
        rclpy.try_shutdown()
        return 1
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stopping:
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

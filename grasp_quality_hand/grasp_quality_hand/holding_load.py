# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Node holding_load: where the object is in, what the fingers have to balance out.

Publishes the external wrench of grasp_quality: the object's weight, less what a spring between the
object and its place asks the fingers for. Its place is where it was when the node heard of it
first, or when ~/hold_here was called last.
"""

import signal
import sys
from typing import Any

from geometry_msgs.msg import PoseStamped, WrenchStamped
from grasp_quality_hand.hand_kinematics import EARTH
from grasp_quality_hand.object_spring import ObjectSpring, weight
from msg_adapters.errors import InvalidMessageError
from msg_adapters.poses import pose_arrays
from msg_adapters.qos import newest_command, newest_sample
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
           'max_torque': (0.02, 'That the spring asks for at most [N m]', 1e6)}


class HoldingLoad(Node):
    """Answers every pose of the object with the load."""

    def __init__(self) -> None:
        super().__init__('holding_load')
        values = {name: self.declare_parameter(name, default, ParameterDescriptor(
            description=text, read_only=True, floating_point_range=[
                FloatingPointRange(from_value=0.0, to_value=largest)])).value
            for name, (default, text, largest) in NUMBERS.items()}
        self._mass = float(values.pop('mass'))
        self._spring = ObjectSpring(**values)
        self._gravity = np.array(self.declare_parameter(
            'gravity', list(EARTH), ParameterDescriptor(
                description='in the frame that the poses stand in [m/s^2]',
                read_only=True)).value)
        self._place: tuple[Array, Array] | None = None
        self._publisher = self.create_publisher(
            WrenchStamped, 'grasp_quality/external_wrench', newest_command())
        self.create_subscription(PoseStamped, 'object_pose', self._on_pose, newest_sample())
        self.create_service(Trigger, '~/hold_here', self._on_hold_here)

    def _on_pose(self, message: PoseStamped) -> None:
        try:
            p, R = pose_arrays(message.pose, 'pose')
        except InvalidMessageError as error:
            self.get_logger().warning(str(error), throttle_duration_sec=1.0)
            return
        if self._place is None:
            self._place = R, p
        load = weight(self._mass, self._gravity, R) - self._spring.wrench(*self._place, R, p)
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
    except rclpy.exceptions.ParameterException as error:
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

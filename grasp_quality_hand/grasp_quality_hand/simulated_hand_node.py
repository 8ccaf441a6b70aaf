# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand on the topics of a real one."""

import signal
import sys
import time

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand import hand_messages
from grasp_quality_hand.effort_input import BadCommand, COMMAND_TIMEOUT
from grasp_quality_hand.fetch_dclaw import DClawUnavailable
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_hand.simulation import HandSimulation, SQUEEZE_FORCE
from grasp_quality_msgs.msg import ContactArray
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import Trigger

RATE_HZ = 100.0
CONTROLLER = 'effort_controller'
COMMAND_WARNING_PERIOD_S = 1.0
LONGEST_STRIDE_S = 0.05      # a machine that falls behind loses simulated time, not its rate
SENSOR_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class SimulatedHandNode(Node):
    """Runs a HandSimulation paced to real time and publishes it."""

    def __init__(self):
        super().__init__('simulated_hand')
        target = self.declare_parameter('target_node', 'grasp_quality', ParameterDescriptor(
            description='node whose input topics get the contacts', read_only=True)).value
        self.declare_parameter('object', 'cube', ParameterDescriptor(
            description=f'what ~/load_object loads: {", ".join(OBJECTS)}'))
        self.declare_parameter('squeeze_force', SQUEEZE_FORCE, ParameterDescriptor(
            description='largest normal force of the squeeze [N], from the next load_object on',
            floating_point_range=[FloatingPointRange(from_value=0.1, to_value=30.0)]))
        rate = self.declare_parameter('rate', RATE_HZ, ParameterDescriptor(
            description='rate of all topics [Hz]', read_only=True,
            floating_point_range=[FloatingPointRange(from_value=10.0, to_value=500.0)])).value
        efforts = self.declare_parameter('effort_controller', CONTROLLER, ParameterDescriptor(
            description='efforts are taken from <this>/commands, one for each joint in the order '
                        'of /joint_states', read_only=True)).value
        self.declare_parameter('command_timeout', COMMAND_TIMEOUT, ParameterDescriptor(
            description="age of an effort command [s] beyond which the hand's own controller "
                        'takes over, from the next load_object on',
            floating_point_range=[FloatingPointRange(from_value=0.01, to_value=10.0)]))
        self.add_on_set_parameters_callback(self._check_parameters)
        self._create_publishers('/' + target.strip('/'))
        self._load()
        self.create_service(Trigger, '~/close', self._on_close)
        self.create_service(Trigger, '~/open', self._on_open)
        self.create_service(Trigger, '~/load_object', self._on_load_object)
        self.create_subscription(Float64MultiArray, f'/{efforts.strip("/")}/commands',
                                 self._on_efforts, 1)
        self.create_timer(1.0 / rate, self._on_timer)

    def _create_publishers(self, target):
        """Create the topics of the contacts below the node they are for, and the hand's own."""
        def publisher(message_type, topic):
            return self.create_publisher(message_type, topic, SENSOR_QOS)

        self._contact_poses = publisher(PoseArray, f'{target}/contact_poses')
        self._contact_wrenches = [
            publisher(WrenchStamped, f'{target}/contact_wrenches/{finger}') for finger in FINGERS]
        self._contacts = publisher(ContactArray, f'{target}/contacts')
        self._joint_states = publisher(JointState, '/joint_states')
        self._object_pose = publisher(PoseStamped, '~/object_pose')
        self._up = publisher(Vector3Stamped, '~/up_in_object_frame')
        self._mass = publisher(Float64, '~/object_mass')

    def _check_parameters(self, parameters):
        """Refuse an object that the hand does not know."""
        for parameter in parameters:
            if parameter.name == 'object' and parameter.value not in OBJECTS:
                return SetParametersResult(
                    successful=False, reason=f'object {parameter.value!r} is not known: it must '
                                             f'be one of {", ".join(OBJECTS)}')
        return SetParametersResult(successful=True)

    def _load(self):
        """Begin anew with the object and the squeeze force of the parameters, hand open."""
        self._simulation = HandSimulation(
            self.get_parameter('object').value, self.get_parameter('squeeze_force').value,
            command_timeout=self.get_parameter('command_timeout').value)
        self._simulated_until = time.monotonic()

    def _on_close(self, request, response):
        """Begin to close the hand."""
        self._simulation.close_hand()
        return self._answer(response, f'closing on the {self._simulation.object.name}')

    def _on_open(self, request, response):
        """Open the hand and put the object back where it was handed over."""
        self._simulation.open_hand()
        return self._answer(response, 'opening')

    def _on_load_object(self, request, response):
        """Load the object of the parameter `object` into the open hand."""
        self._load()
        return self._answer(response, f'loaded the {self._simulation.object.name}')

    def _on_efforts(self, message):
        """Take an effort command; say so when it cannot be used."""
        try:
            self._simulation.command_efforts(message.data)
        except BadCommand as error:
            self.get_logger().warning(f'effort command ignored: {error}',
                                      throttle_duration_sec=COMMAND_WARNING_PERIOD_S)

    @staticmethod
    def _answer(response, message):
        """Fill the response of a Trigger that worked."""
        response.success, response.message = True, message
        return response

    def _on_timer(self):
        """Simulate up to now and publish."""
        behind = min(time.monotonic() - self._simulated_until, LONGEST_STRIDE_S)
        simulated = self._simulation.advance(behind)
        self._simulated_until = max(self._simulated_until + simulated,
                                    time.monotonic() - LONGEST_STRIDE_S)
        self._publish()

    def _publish(self):
        """Publish contacts and state with one stamp."""
        stamp, simulation = self.get_clock().now().to_msg(), self._simulation
        contacts = simulation.finger_contacts()
        for publisher, contact in zip(self._contact_wrenches, contacts):
            publisher.publish(hand_messages.contact_wrench(contact, stamp))
        self._contact_poses.publish(hand_messages.pose_array(contacts, stamp))
        self._contacts.publish(hand_messages.contact_array(simulation.contact_points(), stamp))
        self._joint_states.publish(hand_messages.joint_state(simulation, stamp))
        self._object_pose.publish(hand_messages.object_pose(simulation, stamp))
        self._up.publish(hand_messages.up_vector(simulation, stamp))
        self._mass.publish(Float64(data=simulation.object.mass))


def main(args=None):
    """Run the simulated hand until SIGINT or SIGTERM; return the exit code."""
    stopping = []
    # rclpy's own handlers would take the context away in the middle of a callback
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    try:
        node = SimulatedHandNode()
    except (DClawUnavailable, ValueError) as error:
        print(f'simulated_hand: {error}', file=sys.stderr)
        rclpy.shutdown()
        return 1
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not stopping:
        executor.spin_once(timeout_sec=0.1)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

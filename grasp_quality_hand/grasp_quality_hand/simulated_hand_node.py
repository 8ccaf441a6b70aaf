# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand on the topics of a real one."""

import signal
import sys
import time

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand import hand_messages
from grasp_quality_hand.channel import Channel
from grasp_quality_hand.contact_noise import ContactNoise
from grasp_quality_hand.effort_input import BadCommand
from grasp_quality_hand.fetch_dclaw import DClawUnavailable
from grasp_quality_hand.grasp_objects import load
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_hand.hand_parameters import declare_parameters
from grasp_quality_hand.pull_service import PullService
from grasp_quality_hand.simulation import HandSimulation
from grasp_quality_msgs.msg import ContactArray
import numpy as np
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import Trigger

WARNING_PERIOD_S = 1.0
DELIVERY_PERIOD_S = 0.001
LONGEST_STRIDE_S = 0.05      # a machine that falls behind loses simulated time, not its rate
SENSOR_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class SimulatedHandNode(Node):
    """Runs a HandSimulation paced to real time and publishes it."""

    def __init__(self):
        super().__init__('simulated_hand')
        declare_parameters(self)
        self._noise = ContactNoise(*map(self._get, ('position_noise', 'normal_noise',
                                                    'force_noise')))
        self._rng = np.random.default_rng(self._get('seed'))
        self._channel = Channel(self._get('drop_rate'), self._get('delay'), self._get('seed'))
        self._create_publishers('/' + self._get('target_node').strip('/'))
        self._load()
        self.create_service(Trigger, '~/close', self._on_close)
        self.create_service(Trigger, '~/open', self._on_open)
        self.create_service(Trigger, '~/load_object', self._on_load_object)
        self._pulls = PullService(self, lambda: self._simulation)
        self.create_subscription(
            Float64MultiArray, f'/{self._get("effort_controller").strip("/")}/commands',
            self._on_efforts, 1)
        self.create_timer(1.0 / self._get('rate'), self._on_timer)
        if self._channel.delay > 0.0:
            self.create_timer(DELIVERY_PERIOD_S,
                              lambda: self._channel.deliver(time.monotonic()))

    def _get(self, name):
        """Return the value of a parameter."""
        return self.get_parameter(name).value

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
        self._load_wrench = publisher(WrenchStamped, '~/load')

    def _load(self):
        """Begin anew with the object and the squeeze force of the parameters, hand open."""
        grasp_object = load(*map(self._get, ('object', 'object_mass', 'object_friction')))
        self._simulation = HandSimulation(
            grasp_object, self._get('squeeze_force'), hand=self._get('hand'),
            command_timeout=self._get('command_timeout'),
            joint_damping=self._get('joint_damping'))
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
        """Take an effort command, when the channel does not lose it."""
        self._channel.send(lambda: self._take_efforts(message.data), time.monotonic())

    def _take_efforts(self, efforts):
        """Take an effort command; say so when it cannot be used."""
        try:
            self._simulation.command_efforts(efforts)
        except BadCommand as error:
            self.get_logger().warning(f'effort command ignored: {error}',
                                      throttle_duration_sec=WARNING_PERIOD_S)

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
        self._pulls.look()
        self._publish()

    def _publish(self):
        """Publish contacts and state with one stamp."""
        stamp, simulation = self.get_clock().now().to_msg(), self._simulation
        contacts = self._noise.measure(simulation.finger_contacts(), self._rng)
        points = self._noise.measure(simulation.contact_points(), self._rng)
        for publisher, contact in zip(self._contact_wrenches, contacts):
            self._send(publisher, hand_messages.contact_wrench(contact, stamp))
        self._send(self._contact_poses, hand_messages.pose_array(contacts, stamp))
        self._send(self._contacts, hand_messages.contact_array(points, simulation.object, stamp))
        self._send(self._joint_states, hand_messages.joint_state(simulation, stamp))
        self._send(self._object_pose, hand_messages.object_pose(simulation, stamp))
        self._send(self._up, hand_messages.up_vector(simulation, stamp))
        self._send(self._mass, Float64(data=simulation.object.mass))
        self._send(self._load_wrench, hand_messages.load_wrench(simulation.load, stamp))

    def _send(self, publisher, message):
        """Publish a message, when the channel does not lose it."""
        self._channel.send(lambda: publisher.publish(message), time.monotonic())


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

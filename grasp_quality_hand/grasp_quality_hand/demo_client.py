# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo hears and asks, as any client would."""

from dataclasses import dataclass, field
import time

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand.demo_processes import DemoFailure, DemoTimeout
from grasp_quality_msgs.msg import ResultCode
import numpy as np
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import Trigger

START_DEADLINE = 60.0        # for a service to appear: the node compiles before it answers [s]
ANSWER_DEADLINE = 20.0       # for one answer [s]
NOT_YET = (ResultCode.NO_CONTACTS, ResultCode.STALE_CONTACTS)
KEPT = 100                   # samples that are kept


@dataclass
class Heard:
    """The newest message of every topic, and the contact samples of one stamp kept together."""

    poses: dict = field(default_factory=dict)       # stamp -> (k, 7) positions and quaternions
    wrenches: dict = field(default_factory=dict)    # stamp -> {finger: (4,) [t1, t2, n, m_n]}
    joints: JointState = None
    object_pose: PoseStamped = None
    up: np.ndarray = None        # (3,) object frame
    mass: float = None           # [kg]
    load: np.ndarray = None      # (6,) of a pull, object frame
    load_rate: np.ndarray = None    # (6,) its growth a second
    load_stamp: float = 0.0      # [s]
    commands: int = 0            # of efforts to the hand's joints
    commanded: float = 0.0       # when the newest of them came, steady clock [s]
    silence: float = 0.0         # longest time between two of them [s]


class DemoClient:
    """
    Listens to the hand and calls the services of hand and grasp_quality.

    The calls go out from a node of their own, so that no topic delays an answer.

    """

    def __init__(self, fingers, target, hand, children):
        self.fingers, self.heard = fingers, Heard()
        self._children = children
        self._hand = hand
        self._target = target
        self._listener = _SpinningNode('grasp_quality_demo_listener')
        self._caller = _SpinningNode('grasp_quality_demo')
        self._clients = {}
        self._listen(PoseArray, f'{target}/contact_poses', self._on_poses)
        for finger in fingers:
            self._listen(WrenchStamped, f'{target}/contact_wrenches/{finger}', self._on_wrench)
        self._listen(JointState, '/joint_states', self._keep('joints'))
        self._listen(PoseStamped, f'{hand}/object_pose', self._keep('object_pose'))
        self._listen(Vector3Stamped, f'{hand}/up_in_object_frame', self._on_up)
        self._listen(Float64, f'{hand}/object_mass', self._on_mass)
        self._listen(WrenchStamped, f'{hand}/load', self._on_load)
        self._listener.node.create_subscription(
            Float64MultiArray, '/effort_controller/commands', self._on_command, 1)
        self.on_contacts = []        # each is called with every PoseArray of the contacts

    def _listen(self, message_type, topic, callback):
        """Subscribe as to any sensor."""
        self._listener.node.create_subscription(message_type, topic, callback,
                                                qos_profile_sensor_data)

    def _keep(self, name):
        """Return a callback that keeps the newest message under a name of Heard."""
        return lambda message: setattr(self.heard, name, message)

    def _on_poses(self, message):
        """Keep the contact frames of one stamp."""
        _forget_oldest(self.heard.poses)
        self.heard.poses[_stamp(message)] = np.array([
            [p.position.x, p.position.y, p.position.z,
             p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w]
            for p in message.poses])
        for callback in self.on_contacts:
            callback(message)

    def _on_wrench(self, message):
        """Keep the measured force of one finger; its frame bears the finger's name."""
        force, torque = message.wrench.force, message.wrench.torque
        _forget_oldest(self.heard.wrenches)
        sample = self.heard.wrenches.setdefault(_stamp(message), {})
        sample[message.header.frame_id] = np.array([force.x, force.y, force.z, torque.z])

    def _on_up(self, message):
        """Keep the direction away from gravity."""
        vector = message.vector
        self.heard.up = np.array([vector.x, vector.y, vector.z])

    def _on_mass(self, message):
        """Keep the mass of the object."""
        self.heard.mass = message.data

    def _on_load(self, message):
        """Keep what a pull does to the object."""
        force, torque = message.wrench.force, message.wrench.torque
        load = np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])
        heard, stamp = self.heard, 1e-9 * _stamp(message)
        if heard.load is not None and stamp > heard.load_stamp:
            heard.load_rate = (load - heard.load) / (stamp - heard.load_stamp)
        heard.load, heard.load_stamp = load, stamp

    def _on_command(self, message):
        """Count what is commanded to the joints, and keep how far apart commands come."""
        heard, now = self.heard, time.monotonic()
        if heard.commands:
            heard.silence = max(heard.silence, now - heard.commanded)
        heard.commands, heard.commanded = heard.commands + 1, now

    def forget(self):
        """Forget everything heard."""
        self.heard = Heard()

    def listen_until(self, condition, deadline, complaint):
        """Listen until condition() holds; raise DemoTimeout(complaint) after deadline seconds."""
        self._spin_until(self._listener, condition, deadline, complaint)

    def _spin_until(self, spinning_node, condition, deadline, complaint):
        """Serve one of the two nodes until condition() holds."""
        end = time.monotonic() + deadline
        while not condition():
            if time.monotonic() > end:
                raise DemoTimeout(f'{complaint} within {deadline:.0f} s')
            for child in self._children:
                child.check()
            spinning_node.executor.spin_once(timeout_sec=0.05)

    def call(self, service_type, name, request):
        """
        Call a service and wait for its answer.

        Returns
        -------
        response, float
            The answer and the round-trip time in seconds.

        """
        client = self._client(service_type, name)
        begin = time.perf_counter()
        future = client.call_async(request)
        self._spin_until(self._caller, future.done, ANSWER_DEADLINE, f'{name} did not answer')
        return future.result(), time.perf_counter() - begin

    def call_while_listening(self, service_type, name, request, deadline):
        """Call a service that takes time, and listen until it answers; return the answer."""
        future = self._client(service_type, name).call_async(request)

        def answered():
            self._caller.executor.spin_once(timeout_sec=0.0)
            return future.done()

        self.listen_until(answered, deadline, f'{name} did not answer')
        return future.result()

    def create_publisher(self, message_type, topic):
        """Return a publisher of the listening node, reliable, depth 1."""
        return self._listener.node.create_publisher(message_type, topic, 1)

    def ask(self, service_type, name, request):
        """
        Call a service of the grasp_quality node; anything but OPTIMAL is a DemoFailure.

        A node that has just started may not have heard any contacts, and on a busy machine they
        may be late for once: then ask again.

        """
        name, end = f'{self._target}/{name}', time.monotonic() + ANSWER_DEADLINE
        response, round_trip = self.call(service_type, name, request)
        while response.result.code in NOT_YET and time.monotonic() < end:
            response, round_trip = self.call(service_type, name, request)
        if response.result.code != ResultCode.OPTIMAL:
            raise DemoFailure(f'{name} answered with code {response.result.code} instead of '
                              f'OPTIMAL: {response.result.message}')
        return response, round_trip

    def trigger(self, name):
        """Call a Trigger of the simulated hand."""
        response, _ = self.call(Trigger, f'{self._hand}/{name}', Trigger.Request())
        if not response.success:
            raise DemoFailure(f'the hand refused {name}: {response.message}')

    def choose_object(self, name):
        """Set the hand's parameter `object`."""
        value = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=name)
        request = SetParameters.Request(parameters=[Parameter(name='object', value=value)])
        response, _ = self.call(SetParameters, f'{self._hand}/set_parameters', request)
        if not response.results[0].successful:
            raise DemoFailure(f'the hand refused the object: {response.results[0].reason}')

    def close(self):
        """Leave ROS."""
        for spinning_node in (self._listener, self._caller):
            spinning_node.executor.shutdown()
            spinning_node.node.destroy_node()

    def _client(self, service_type, name):
        """Return the client of a service that is there."""
        if name not in self._clients:
            client = self._caller.node.create_client(service_type, name)
            self._spin_until(self._caller, client.service_is_ready, START_DEADLINE,
                             f'{name} did not appear')
            self._clients[name] = client
        return self._clients[name]


class _SpinningNode:
    """A node with an executor of its own."""

    def __init__(self, name):
        self.node = rclpy.create_node(name)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)


def _stamp(message):
    """Return the stamp of a message in nanoseconds."""
    return message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec


def _forget_oldest(samples):
    """Make room in a dictionary of samples, which are in the order of their arrival."""
    while len(samples) >= KEPT:
        del samples[next(iter(samples))]

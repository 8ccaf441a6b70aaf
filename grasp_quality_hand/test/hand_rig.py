# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand in a process of its own, and a client that hears and asks it."""

import subprocess
import time

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand.demo_processes import executable
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_msgs.msg import ContactArray
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

DEADLINE = 60.0              # for anything that is waited for [s]
TARGET = '/a_hand/grasp_quality'
WRENCHES = [f'{TARGET}/contact_wrenches/{finger}' for finger in FINGERS]
CONTACT_TOPICS = {f'{TARGET}/contact_poses': PoseArray, f'{TARGET}/contacts': ContactArray,
                  **dict.fromkeys(WRENCHES, WrenchStamped)}
TOPICS = {**CONTACT_TOPICS, '/joint_states': JointState,
          '/simulated_hand/object_pose': PoseStamped,
          '/simulated_hand/up_in_object_frame': Vector3Stamped,
          '/simulated_hand/object_mass': Float64, '/simulated_hand/load': WrenchStamped}


class Client:
    """Hears all topics and calls the services of the hand."""

    def __init__(self, domain):
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node('test_client', context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.heard = {topic: [] for topic in TOPICS}
        for topic, message_type in TOPICS.items():
            self.node.create_subscription(message_type, topic, self.heard[topic].append,
                                          qos_profile_sensor_data)

    def spin_until(self, condition):
        """Listen until condition() holds."""
        end = time.monotonic() + DEADLINE
        while not condition():
            assert time.monotonic() < end, 'waited in vain'
            self.executor.spin_once(timeout_sec=0.05)

    def call(self, service_type, name, request):
        """Return the answer of a service."""
        client = self.node.create_client(service_type, f'/simulated_hand/{name}')
        self.spin_until(client.service_is_ready)
        future = client.call_async(request)
        self.spin_until(future.done)
        return future.result()

    def trigger(self, name):
        """Call a Trigger and forget what was heard before."""
        assert self.call(Trigger, name, Trigger.Request()).success
        for messages in self.heard.values():
            messages.clear()

    def choose(self, name):
        """Set the parameter `object`; return whether the hand took it."""
        value = ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=name)
        request = SetParameters.Request(parameters=[Parameter(name='object', value=value)])
        return self.call(SetParameters, 'set_parameters', request).results[0]

    def close(self):
        """Leave ROS."""
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)


def start(*parameters):
    """Start the hand in a process of its own."""
    command = [str(executable('grasp_quality_hand', 'simulated_hand')), '--ros-args']
    return subprocess.Popen([*command, *parameters], start_new_session=True)

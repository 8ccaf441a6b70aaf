# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand as a black box: its own process, its topics and services over DDS."""

import os
import signal
import subprocess
import time

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand.demo_processes import claim_domain, discovery_environment, executable
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_msgs.msg import Contact, ContactArray
import numpy as np
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import Trigger

DEADLINE = 20.0              # for anything that is waited for [s]
RATE_HZ = 100.0
TARGET = '/a_hand/grasp_quality'
WRENCHES = [f'{TARGET}/contact_wrenches/{finger}' for finger in FINGERS]
CONTACT_TOPICS = {f'{TARGET}/contact_poses': PoseArray, f'{TARGET}/contacts': ContactArray,
                  **dict.fromkeys(WRENCHES, WrenchStamped)}
TOPICS = {**CONTACT_TOPICS, '/joint_states': JointState,
          '/simulated_hand/object_pose': PoseStamped,
          '/simulated_hand/up_in_object_frame': Vector3Stamped,
          '/simulated_hand/object_mass': Float64}


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


@pytest.fixture(scope='module')
def domain():
    """Take a ROS domain; put the environment back afterwards."""
    before = {name: os.environ.get(name) for name in discovery_environment(0)}
    claim = claim_domain()
    yield int(os.environ['ROS_DOMAIN_ID'])
    claim.close()
    for name, value in before.items():
        os.environ.pop(name)
        if value is not None:
            os.environ[name] = value


def start(*parameters):
    """Start the hand in a process of its own."""
    command = [str(executable('grasp_quality_hand', 'simulated_hand')), '--ros-args']
    return subprocess.Popen([*command, *parameters], start_new_session=True)


@pytest.fixture(scope='module')
def client(domain):
    """Return a client of a running hand, which must end with 0 on SIGINT."""
    process = start('-p', 'target_node:=a_hand/grasp_quality')
    client = Client(domain)
    try:
        client.spin_until(lambda: all(client.heard.values()))
        yield client
    finally:
        client.close()
        process.send_signal(signal.SIGINT)
        code = process.wait(DEADLINE)
    assert code == 0


def test_topics_come_at_100_hz_and_in_order(client):
    client.trigger('load_object')
    begin = time.monotonic()
    client.spin_until(lambda: time.monotonic() > begin + 2.0)
    for topic in [*CONTACT_TOPICS, '/joint_states']:
        stamps = [message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
                  for message in client.heard[topic]]
        periods = np.diff(stamps)
        assert np.all(periods > 0.0), topic
        assert 1.0 / np.median(periods) == pytest.approx(RATE_HZ, rel=0.1), topic


def test_open_hand_shows_a_zero_wrench_for_every_finger(client):
    client.trigger('open')
    poses = client.heard[f'{TARGET}/contact_poses']
    client.spin_until(lambda: poses and all(client.heard[topic] for topic in WRENCHES))
    assert len(poses[-1].poses) == len(FINGERS)
    for topic, finger in zip(WRENCHES, FINGERS):
        message = client.heard[topic][-1]
        assert message.header.frame_id == finger
        assert message.wrench.force.z == 0.0 and message.wrench.torque.z == 0.0


@pytest.mark.parametrize('name', ['cube', 'ball'])
def test_closed_hand_holds_the_object_it_was_given(client, name):
    assert client.choose(name).successful
    client.trigger('load_object')
    client.trigger('close')
    begin = time.monotonic()
    client.spin_until(lambda: time.monotonic() > begin + 1.5)
    for messages in client.heard.values():
        messages.clear()
    client.spin_until(lambda: all(client.heard.values()))
    newest = {topic: messages[-1] for topic, messages in client.heard.items()}
    contacts, poses = newest[f'{TARGET}/contacts'], newest[f'{TARGET}/contact_poses']
    assert contacts.header.frame_id == poses.header.frame_id == 'object'
    assert {contact.finger for contact in contacts.contacts} == set(FINGERS)
    assert all(contact.model == Contact.MODEL_SFCE and contact.friction_coefficient > 0.0
               for contact in contacts.contacts)
    assert len(poses.poses) == len(FINGERS)
    assert all(newest[topic].wrench.force.z > 1.0 for topic in WRENCHES)
    up, mass = newest['/simulated_hand/up_in_object_frame'].vector, newest[
        '/simulated_hand/object_mass'].data
    assert (up.x, up.y, up.z) == pytest.approx((0.0, 0.0, 1.0), abs=0.01)
    assert mass == {'cube': 0.2, 'ball': 0.15}[name]
    assert newest['/simulated_hand/object_pose'].pose.position.z > 0.15
    assert len(newest['/joint_states'].name) == len(newest['/joint_states'].position) == 9


def test_effort_commands_reach_the_joints_and_bad_ones_do_not(client):
    client.trigger('load_object')
    client.trigger('close')
    poses = client.heard[f'{TARGET}/contact_wrenches/{FINGERS[0]}']
    client.spin_until(lambda: poses and poses[-1].wrench.force.z > 4.0)
    publisher = client.node.create_publisher(Float64MultiArray, '/effort_controller/commands', 1)
    joints = client.heard['/joint_states']
    command = [effort + 0.01 for effort in joints[-1].effort]

    def commanded():
        publisher.publish(Float64MultiArray(data=command))
        publisher.publish(Float64MultiArray(data=command[:-1]))
        publisher.publish(Float64MultiArray(data=[float('nan')] * len(command)))
        return list(joints[-1].effort) == command

    client.spin_until(commanded)
    client.spin_until(lambda: list(joints[-1].effort) != command)    # silence gives back


def test_unknown_object_is_refused(client):
    result = client.choose('teapot')
    assert not result.successful and 'cube, ball' in result.reason


def test_sigterm_ends_it_with_code_0(client):
    process = start('-r', '__ns:=/another')
    service = client.node.create_client(Trigger, '/another/simulated_hand/close')
    client.spin_until(service.service_is_ready)
    process.send_signal(signal.SIGTERM)
    assert process.wait(DEADLINE) == 0


def test_missing_hand_model_is_explained(domain, tmp_path):
    environment = dict(os.environ, GRASP_QUALITY_DCLAW_DIR=str(tmp_path))
    done = subprocess.run([executable('grasp_quality_hand', 'simulated_hand')], timeout=DEADLINE,
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 1
    assert 'run fetch_dclaw' in done.stderr and 'Traceback' not in done.stderr

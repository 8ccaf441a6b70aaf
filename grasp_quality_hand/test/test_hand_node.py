# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand as a black box: its own process, its topics and services over DDS."""

import os
import signal
import subprocess
import time

from geometry_msgs.msg import PoseArray, PoseStamped
from grasp_quality_hand.demo_processes import executable
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_msgs.msg import Contact
from hand_rig import CONTACT_TOPICS, DEADLINE, start, TARGET, WRENCHES
import numpy as np
import pytest
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import Trigger

RATE_HZ = 100.0


def test_topics_come_in_order_and_no_faster_than_time_goes_by(client):
    """How fast they come is measured by benchmarks/closed_loop."""
    client.trigger('load_object')
    topics = [client.heard[topic] for topic in [*CONTACT_TOPICS, '/joint_states']]
    client.spin_until(lambda: all(len(heard) > RATE_HZ for heard in topics))
    for topic in [*CONTACT_TOPICS, '/joint_states']:
        stamps = [message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
                  for message in client.heard[topic]]
        assert np.all(np.diff(stamps) > 0.0), topic
        assert (len(stamps) - 1) / (stamps[-1] - stamps[0]) < 1.1 * RATE_HZ, topic


def test_open_hand_shows_a_zero_wrench_for_every_finger(client):
    client.trigger('open')
    poses = client.heard[f'{TARGET}/contact_poses']
    client.spin_until(lambda: poses and all(client.heard[topic] for topic in WRENCHES))
    assert len(poses[-1].poses) == len(FINGERS)
    for topic, finger in zip(WRENCHES, FINGERS):
        message = client.heard[topic][-1]
        assert message.header.frame_id == finger
        assert message.wrench.force.z == 0.0 and message.wrench.torque.z == 0.0


@pytest.mark.parametrize('name', ['cube', 'ball', 'cylinder'])
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
    assert mass == {'cube': 0.2, 'ball': 0.15, 'cylinder': 0.2}[name]
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


def test_contact_points_stand_behind_the_same_topics_with_late_and_lost_messages(client):
    process = start('-r', '__ns:=/points', '-p', 'hand:=points', '-p', 'target_node:=points/node',
                    '-p', 'drop_rate:=0.2', '-p', 'delay:=0.02', '-p', 'object_mass:=0.3', '-p',
                    'effort_controller:=points/effort_controller')
    heard = []
    client.node.create_subscription(PoseArray, '/points/node/contact_poses', heard.append,
                                    qos_profile_sensor_data)
    ages = []
    client.node.create_subscription(
        PoseStamped, '/points/simulated_hand/object_pose', lambda message: ages.append(
            client.node.get_clock().now().nanoseconds - message.header.stamp.sec * 10**9
            - message.header.stamp.nanosec), qos_profile_sensor_data)
    client.spin_until(lambda: len(heard) > 20 and len(ages) > 20)
    assert len(heard[-1].poses) == len(FINGERS)
    assert min(ages) > 0.02e9
    process.send_signal(signal.SIGINT)
    assert process.wait(DEADLINE) == 0


def test_sigterm_ends_it_with_code_0(client):
    process = start('-r', '__ns:=/another')
    service = client.node.create_client(Trigger, '/another/simulated_hand/close')
    client.spin_until(service.service_is_ready)
    process.send_signal(signal.SIGTERM)
    assert process.wait(DEADLINE) == 0


def test_missing_hand_model_is_explained(domain, tmp_path):
    environment = dict(os.environ, GRASP_QUALITY_DCLAW_DIR=str(tmp_path))
    done = subprocess.run([executable('grasp_quality_hand', 'simulated_hand')], timeout=DEADLINE,
                          env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert 'run fetch_dclaw' in done.stderr and 'Traceback' not in done.stderr

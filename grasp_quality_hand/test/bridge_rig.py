# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A client that plays hand and object for force_to_effort, and the processes beside it."""

from contextlib import contextmanager
import math
import re
import signal
import subprocess
import time

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Point, Pose, PoseArray, PoseStamped, Quaternion
from grasp_quality_hand.demo_processes import executable
import numpy as np
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, Header
from two_fingers import LENGTH, urdf

DEADLINE = 30.0     # for anything that is waited for [s]
START = 120.0       # a first start may compile
FEED_PERIOD = 0.01
CAP = 3.0           # [N]
PRESS = 2.0 / 3.0 * CAP   # of a pair of fingers that holds nothing: 2 / (2 + cap weight)
FOLLOWED = [-PRESS * LENGTH, PRESS * LENGTH]    # right, left [N m]
EXACT = 1e-6
HALF = math.sqrt(0.5)


class Rig:
    """A client that plays hand and object, and the processes beside it."""

    def __init__(self, folder, domain):
        self.folder = folder
        (folder / 'hand.urdf').write_text(urdf())
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node('test_client', context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.commands, self.status = [], []
        self.node.create_subscription(
            Float64MultiArray, '/effort_controller/commands', self.commands.append, 10)
        self.node.create_subscription(DiagnosticArray, '/diagnostics', self._on_diagnostics, 10)
        self.contacts = self.node.create_publisher(
            PoseArray, '/grasp_quality/contact_poses', qos_profile_sensor_data)
        self.joints = self.node.create_publisher(JointState, '/joint_states', 10)
        self.pose = self.node.create_publisher(
            PoseStamped, '/object_pose', qos_profile_sensor_data)
        self.processes = {}
        self.fed = 0.0
        self.positions = [0.0, 0.0]

    def _on_diagnostics(self, message):
        self.status += [s for s in message.status if 'joint efforts' in s.name]

    def start(self, name, package, *arguments):
        with open(self.folder / f'{name}.txt', 'ab') as log:
            self.processes[name] = subprocess.Popen(
                [str(executable(package, name)), '--ros-args', *arguments], stdout=log,
                stderr=subprocess.STDOUT, start_new_session=True)

    def start_quality(self):
        self.start('grasp_quality_node', 'grasp_quality', '-p', 'contact_names:=[left, right]',
                   '-p', f'max_normal_force:={CAP}',
                   '-p', 'task_wrench:=[0.0,0.0,1.0,0.0,0.0,0.0]')

    def start_bridge(self, *arguments):
        self.start('force_to_effort', 'grasp_quality_hand',
                   '-p', f'robot_description_file:={self.folder / "hand.urdf"}',
                   '-p', 'joints:=[right_hinge, left_hinge]',
                   '-p', 'contact_names:=[left, right]',
                   '-p', 'contact_links:=[left_finger, right_finger]',
                   '-p', 'max_joint_age:=1.0', '-p', 'max_pose_age:=1.0',
                   '-r', 'grasp_quality/contact_forces:=grasp_quality/holding_forces', *arguments)

    @contextmanager
    def bridging(self, *arguments):
        """Run the bridge, and end everything after it."""
        self.start_bridge(*arguments)
        try:
            self.until(lambda: self.commands, deadline=START)
            yield self
        finally:
            self.close()

    def feed(self):
        """Publish contacts, joint states and the pose of the object, with one stamp."""
        stamp = self.node.get_clock().now().to_msg()
        self.contacts.publish(PoseArray(header=Header(stamp=stamp, frame_id='object'), poses=[
            Pose(position=Point(x=-0.05), orientation=Quaternion(y=HALF, w=HALF)),
            Pose(position=Point(x=0.05), orientation=Quaternion(y=-HALF, w=HALF))]))
        self.joints.publish(JointState(
            header=Header(stamp=stamp), name=['left_hinge', 'right_hinge', 'elsewhere'],
            position=[*self.positions, 0.0], effort=[0.0, 0.0, 0.0]))
        self.pose.publish(PoseStamped(
            header=Header(stamp=stamp, frame_id='palm'), pose=Pose(position=Point(z=LENGTH))))

    def until(self, condition, feeding=True, deadline=DEADLINE):
        """Listen, and feed meanwhile, until condition() gives something true; return it."""
        end = time.monotonic() + deadline
        while not (result := condition()):
            assert time.monotonic() < end, (
                f'waited in vain; last {[list(c.data) for c in self.commands[-1:]]}, '
                f'{self.status[-1:]}')
            if feeding and time.monotonic() - self.fed >= FEED_PERIOD:
                self.fed = time.monotonic()
                self.feed()
            self.executor.spin_once(timeout_sec=0.002)
        return result

    def until_commanded(self, efforts, **options):
        """Wait until the newest command is this one, from now on."""
        self.commands.clear()
        self.until(lambda: self.commands and list(self.commands[-1].data) == pytest.approx(
            efforts, abs=EXACT), **options)
        self.check()

    def until_told(self, words, **options):
        """Wait for a diagnosis with these words, from now on; return it."""
        self.status.clear()
        return self.until(
            lambda: next((s for s in self.status if words in s.message), None), **options)

    def check(self):
        """Every command has the right length, and numbers within the limits."""
        for command in self.commands:
            efforts = np.array(command.data)
            assert efforts.shape == (2,) and (np.abs(efforts) <= 2.0).all()

    def close(self):
        for process in self.processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                assert process.wait(DEADLINE) == 0
        for log in self.folder.glob('*.txt'):  # bad messages were sent, nothing else went wrong
            assert set(re.findall(r'\w+Error', log.read_text())) <= {'InvalidMessageError'}, log
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

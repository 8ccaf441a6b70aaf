# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The node holding_load: weight and spring as the load to hold, bad poses, its end."""

import signal
import subprocess
import time

from geometry_msgs.msg import PoseStamped, WrenchStamped
from grasp_quality_hand.demo_processes import executable
from hand_rig import DEADLINE
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from std_srvs.srv import Trigger

STARTED = 3.0 * DEADLINE  # a process of its own, on a busy machine [s]
WEIGHT, STIFFNESS, MOST = 0.2 * 9.81, 100.0, 0.5   # [N], [N/m], [N]
COMMAND = [str(executable('grasp_quality_hand', 'holding_load')), '--ros-args', '-p']


class Rig:
    """Publishes poses and hears loads."""

    def __init__(self, domain):
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node('test_load', context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.poses = self.node.create_publisher(PoseStamped, 'object_pose', 1)
        self.loads = []
        self.node.create_subscription(WrenchStamped, 'grasp_quality/external_wrench',
                                      self.loads.append, qos_profile_sensor_data)
        self.count = 0

    def until(self, condition, publish=None):
        """Publish and listen until condition() gives something true; return it."""
        end = time.monotonic() + STARTED
        while not (found := condition()):
            assert time.monotonic() < end, 'waited in vain'
            if publish is not None:
                self.poses.publish(publish)
            self.executor.spin_once(timeout_sec=0.02)
        return found

    def load(self, x, w=1.0):
        """Return the force that answers a pose at x [m]; each pose has a stamp of its own."""
        self.count += 1
        message = PoseStamped()
        message.header.stamp.sec = self.count
        message.pose.position.x, message.pose.orientation.w = x, w
        answers = self.until(lambda: [heard for heard in self.loads
                                      if heard.header.stamp.sec == self.count], message)
        assert answers[0].header.frame_id == ''  # the object's
        force = answers[0].wrench.force
        return [force.x, force.y, force.z]

    def close(self):
        """Leave ROS."""
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)


@pytest.fixture
def rig(domain):
    """Return a rig beside a running node, which must end with 0 on SIGINT."""
    process = subprocess.Popen(
        [*COMMAND, f'stiffness:={STIFFNESS}', '-p', f'max_force:={MOST}'], start_new_session=True)
    made = Rig(domain)
    try:
        yield made
    finally:
        made.close()
        process.send_signal(signal.SIGINT)
        code = process.wait(DEADLINE)
    assert code == 0


def test_the_load_is_the_weight_and_leads_back_to_the_place(rig):
    assert rig.load(0.1) == pytest.approx([0.0, 0.0, -WEIGHT], abs=1e-9)
    # 1 mm too far along x: fingers that balance this push back with 0.1 N
    assert rig.load(0.101) == pytest.approx([0.001 * STIFFNESS, 0.0, -WEIGHT])
    assert rig.load(0.05) == pytest.approx([-MOST, 0.0, -WEIGHT])
    client = rig.node.create_client(Trigger, '/holding_load/hold_here')
    rig.until(client.service_is_ready)
    future = client.call_async(Trigger.Request())
    rig.until(future.done)
    assert future.result().success
    assert rig.load(0.05) == pytest.approx([0.0, 0.0, -WEIGHT], abs=1e-9)


def test_a_pose_that_cannot_be_used_is_not_answered_and_ends_nothing(rig):
    assert rig.load(0.1)[2] == pytest.approx(-WEIGHT)
    message = PoseStamped()
    message.header.stamp.sec = 999
    message.pose.orientation.w = 0.0  # no rotation
    for _ in range(5):
        rig.poses.publish(message)
    assert rig.load(0.1)[2] == pytest.approx(-WEIGHT)
    assert all(heard.header.stamp.sec != 999 for heard in rig.loads)


def test_a_parameter_out_of_range_ends_it_with_one_line(domain):
    done = subprocess.run([*COMMAND, 'mass:=-1.0'], timeout=STARTED, capture_output=True,
                          text=True, check=False)
    line, = done.stderr.strip().splitlines()
    assert done.returncode == 1 and line.startswith('holding_load: ') and 'mass' in line

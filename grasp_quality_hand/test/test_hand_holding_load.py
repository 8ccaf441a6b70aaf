# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The node holding_load: weight and spring as the load to hold, bad poses, its end."""

import math
import signal
import subprocess
import time

from geometry_msgs.msg import PoseStamped, WrenchStamped
from grasp_quality_hand.demo_processes import executable
from grasp_quality_hand.holding_load import PoseError, PoseGate
from hand_rig import DEADLINE
from msg_adapters.stamps import stamp_ns
import pytest
import rclpy
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_sensor_data
from std_srvs.srv import Trigger

STARTED = 3.0 * DEADLINE  # a process of its own, on a busy machine [s]
FRAME, SPAN = 'base', 0.1  # of the poses, and how old they may be [s]
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

    def until(self, condition, publish=None):
        """Publish and listen until condition() gives something true; return it."""
        end = time.monotonic() + STARTED
        while not (found := condition()):
            assert time.monotonic() < end, 'waited in vain'
            if publish is not None:
                publish()
            self.executor.spin_once(timeout_sec=0.02)
        return found

    def send(self, x=0.1, w=1.0, age=0.0, frame=FRAME, stamped=True):
        """Publish a pose at x [m] of an age [s]; return its stamp [ns]."""
        message = PoseStamped()
        message.header.frame_id = frame
        taken = self.node.get_clock().now() - Duration(seconds=age)
        if stamped:
            message.header.stamp = taken.to_msg()
        message.pose.position.x, message.pose.orientation.w = x, w
        self.poses.publish(message)
        return taken.nanoseconds if stamped else 0

    def load(self, x, **options):
        """Return the force that answers a pose at x [m], sent anew until one is answered."""
        sent = set()
        answer, = self.until(
            lambda: [heard for heard in self.loads if stamp_ns(heard.header.stamp) in sent][:1],
            lambda: sent.add(self.send(x, **options)))
        assert answer.header.frame_id == ''  # the object's
        force = answer.wrench.force
        return [force.x, force.y, force.z]

    def refuses(self, **options):
        """Tell whether none of some poses is answered, and good ones before and after are."""
        assert self.load(0.1)[2] == pytest.approx(-WEIGHT)
        self.spin(0.2)  # answers on their way
        heard = len(self.loads)
        for _ in range(5):
            self.send(x=0.05, **options)
            self.spin(0.02)
        self.spin(0.3)
        silent = len(self.loads) == heard
        assert self.load(0.1)[2] == pytest.approx(-WEIGHT)
        return silent

    def spin(self, seconds):
        """Listen for a while."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.02)

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
    for options in ({'w': 0.0}, {'w': math.nan}, {'frame': 'camera'}, {'frame': ''},
                    {'age': 3600.0}, {'age': 1.5 * SPAN}, {'age': -1.0},
                    {'frame': 'camera', 'stamped': False}):
        assert rig.refuses(**options), options
    assert rig.load(0.1, stamped=False)[2] == pytest.approx(-WEIGHT)


def admitted(gate, stamp_s, now_s=100.0, sent_s=100.0, wall_s=100.0, frame=FRAME):
    """Tell why a pose is refused, '' when it is not."""
    try:
        gate.check(frame, *(round(1e9 * t) for t in (stamp_s, sent_s, now_s, wall_s)))
    except PoseError as error:
        return str(error)
    return ''


def test_a_pose_passes_in_order_while_it_is_fresh():
    gate = PoseGate(FRAME, SPAN)
    assert admitted(gate, 99.95) == admitted(gate, 99.95) == admitted(gate, 99.99) == ''
    assert 'older than the last' in admitted(gate, 99.98)
    assert "'camera', not the pose_frame 'base'" in admitted(gate, 99.99, frame='camera')
    assert 's old' in admitted(gate, 99.8) and 's old' in admitted(gate, 100.2)


def test_a_clock_set_back_stops_nothing_for_longer_than_the_limit():
    gate = PoseGate(FRAME, SPAN)
    assert admitted(gate, 100.0) == admitted(gate, 50.0, 50.0) == ''
    assert 'older than the last' in admitted(gate, 49.95, 49.96)


def test_a_pose_without_a_stamp_is_as_old_as_its_sending():
    """It may have waited in a queue; the clock of stamps may be another one."""
    gate = PoseGate(FRAME, SPAN)
    assert admitted(gate, 0.0, now_s=7.0) == ''
    for sent_s in (99.8, 100.2):
        assert 's old' in admitted(gate, 0.0, now_s=7.0, sent_s=sent_s)
    assert 'older than the last' in admitted(gate, 0.0, sent_s=99.95)


@pytest.mark.parametrize('setting', [
    'gravity:=[0.0,0.0]', 'gravity:=[0.0,0.0,.nan]', 'gravity:=[0.0,0.0,1.0e300]', 'mass:=.nan',
    'stiffness:=.nan', 'max_pose_age:=.nan', 'mass:=-1.0'])
def test_a_parameter_out_of_range_ends_it_with_one_line(domain, setting):
    done = subprocess.run([*COMMAND, setting], timeout=STARTED, capture_output=True,
                          text=True, check=False)
    line, = done.stderr.strip().splitlines()
    assert done.returncode == 1
    assert line.startswith('holding_load: ') and setting.split(':')[0] in line

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""force_to_effort as a black box: what waited in a queue, what is too large, joints of others."""

import math
import os
import signal
import time

from bridge_rig import Rig
from geometry_msgs.msg import Point, Vector3, Wrench
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from two_fingers import LENGTH

pytestmark = pytest.mark.alone  # it lets go of what is older than 0.1 s
HELD = [-0.05, 0.05]    # right, left [N m]
LONGEST_GAP_S = 1.0     # between commands, on a loaded machine; unpacking LARGE takes longer
LARGE = 40_000          # forces


class ForcesRig(Rig):
    """A rig that plays the quality node too, with forces that have no stamp."""

    def __init__(self, folder, domain):
        super().__init__(folder, domain)
        self.publisher = self.node.create_publisher(
            ContactForceArray, '/grasp_quality/holding_forces', 1)
        self.newton = 2.0
        self.arm_effort = 0.0

    @property
    def followed(self):
        return [-self.newton * LENGTH, self.newton * LENGTH]

    def forces(self, newton):
        return ContactForceArray(header=Header(frame_id='object'), forces=[
            ContactForce(name=name, position=Point(x=-0.05 * side),
                         wrench=Wrench(force=Vector3(x=side * newton)))
            for name, side in (('left', 1.0), ('right', -1.0))])

    def feed(self):
        super().feed()
        self.joints.publish(JointState(
            header=Header(stamp=self.node.get_clock().now().to_msg()),
            name=['arm', 'left_hinge', 'right_hinge'], position=[math.nan, *self.positions],
            effort=[self.arm_effort, 0.0, 0.0]))
        if self.newton:
            self.publisher.publish(self.forces(self.newton))


@pytest.fixture(scope='module')
def rig(domain, tmp_path_factory):
    with ForcesRig(tmp_path_factory.mktemp('faults'), domain).bridging(
            '-p', f'holding_efforts:={HELD}', '-p', 'max_joint_age:=0.2') as rig:
        yield rig


def test_forces_that_waited_in_a_queue_are_not_followed(rig):
    """The bridge is stopped, the source sends once more and dies, the bridge goes on."""
    rig.until_commanded(rig.followed)
    newton, rig.newton = rig.newton, 0.0
    rig.until_commanded(HELD)
    process = rig.processes['force_to_effort']
    os.kill(process.pid, signal.SIGSTOP)
    try:
        rig.publisher.publish(rig.forces(15.0))
        until = time.monotonic() + 1.0
        rig.until(lambda: time.monotonic() > until)
    finally:
        os.kill(process.pid, signal.SIGCONT)
    rig.commands.clear()
    rig.until(lambda: len(rig.commands) > 100)
    assert np.array([c.data for c in rig.commands]) == pytest.approx(
        np.tile(HELD, (len(rig.commands), 1)), abs=1e-6)
    rig.newton = newton
    rig.until_commanded(rig.followed)


def test_efforts_of_others_that_are_no_numbers_are_not_read(rig):
    rig.arm_effort = math.nan
    rig.until_commanded(rig.followed)
    until = time.monotonic() + 0.5  # longer than joint states may be old
    rig.until(lambda: time.monotonic() > until)
    rig.until_told('following the contact forces')
    rig.arm_effort = 0.0


def test_what_was_refused_of_the_joint_states_is_told(rig):
    rig.until_commanded(rig.followed)
    rig.positions = [math.nan, 0.0]
    told = rig.until_told('refused: position must be finite')
    assert 'joint states are older' in told.message
    rig.positions = [0.0, 0.0]
    rig.until_commanded(rig.followed)


def test_large_messages_do_not_stop_the_commands(rig):
    rig.until_commanded(rig.followed)
    packed = serialize_message(ContactForceArray(
        header=Header(frame_id='object'), forces=[ContactForce(name='left')] * LARGE))
    rig.until_commanded(rig.followed)
    newton, rig.newton = rig.newton, 0.0
    rig.publisher.publish(packed)
    times = []

    def commanded():
        times.extend([time.monotonic()] * len(rig.commands))
        rig.commands.clear()
        return next((s for s in rig.status if f'{len(packed)} bytes' in s.message), None)

    rig.status.clear()
    rig.until(commanded)
    assert np.diff(times).max() < LONGEST_GAP_S
    rig.until_commanded(HELD)
    rig.newton = newton
    rig.until_commanded(rig.followed)


def test_more_forces_than_contacts_are_told(rig):
    rig.until_commanded(rig.followed)
    newton, rig.newton = rig.newton, 0.0
    rig.publisher.publish(ContactForceArray(
        header=Header(frame_id='object'), forces=[ContactForce(name='left')] * 3))
    rig.until_told('3 came for 2 contact_names')
    rig.newton = newton
    rig.until_commanded(rig.followed)

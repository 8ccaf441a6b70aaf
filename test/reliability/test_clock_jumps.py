# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Clocks that jump, stand still and begin anew, as ``use_sim_time`` makes possible.

Contacts from the other side of a jump are STALE_CONTACTS within twice ``max_contact_age``, whether
ahead of the clock or behind it; the first sample stamped by the new time is answered. A jump back
by less than ``max_contact_age`` withholds answers no longer than that.
"""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT, FEED_PERIOD_S
from outputs import Outputs
import pytest
from rclpy.qos import QoSProfile
from rclpy.time import Time as RosTime
from rig import MAX_AGE_S, TASK
from rosgraph_msgs.msg import Clock


class Simulation:
    """A clock that can be set, and contacts stamped by it."""

    def __init__(self, node):
        self.now_s = 0.0
        self.runs = True
        self._ticks = 0
        self._client = node.client
        self.outputs = Outputs(node.client)
        self._clock = node.client.node.create_publisher(Clock, '/clock', QoSProfile(depth=1))
        self._contacts = node.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
        node.client.until(self._clock.get_subscription_count, 'the node to listen to /clock')

    def tick(self):
        """
        Go on by a feed period and publish the clock only.

        A clock that does not run stands still for a second at a time: of each such second only the
        first max_contact_age may be answered, and a busy machine can miss that.
        """
        self._ticks += 1
        if self.runs or self._ticks % round(1.0 / FEED_PERIOD_S) == 0:
            self.now_s += FEED_PERIOD_S
        self._clock.publish(Clock(clock=self.stamp()))

    def sample(self):
        """Go on and publish contacts of now."""
        self.tick()
        self._contacts.publish(pose_array(ANTIPODAL, self.stamp()))

    def stamp(self):
        """Return the simulated time."""
        return RosTime(seconds=self.now_s).to_msg()

    def until_answered(self):
        """Feed until a sample from now on has an answer."""
        begin_s = self.now_s
        self.outputs.forget()
        self._client.until(lambda: any(
            m.result.code == ResultCode.OPTIMAL
            and begin_s <= RosTime.from_msg(m.header.stamp).nanoseconds * 1e-9 <= self.now_s + 1e-6
            for m in self.outputs.quality), 'an answer', self.sample)


@pytest.fixture(scope='module')
def simulation(start):
    return Simulation(start(use_sim_time='true', max_contact_age=MAX_AGE_S, task_wrench=TASK))


@pytest.mark.parametrize('jump_s', [3600.0, -3000.0, 5.0, -5.0])
def test_after_a_jump_old_contacts_are_stale_and_new_ones_answered(simulation, jump_s):
    simulation.now_s = 1e4
    simulation.until_answered()
    simulation.now_s += jump_s
    quality = simulation.outputs.failure(ResultCode.STALE_CONTACTS, simulation.tick)
    assert ('ahead of this clock' in quality.result.message) == (jump_s < 0.0)
    simulation.until_answered()


@pytest.mark.parametrize('jump_s', [0.5 * MAX_AGE_S, -0.5 * MAX_AGE_S])
def test_a_jump_within_the_age_withholds_nothing_for_longer(simulation, jump_s):
    simulation.now_s = 1e4
    simulation.until_answered()
    for _ in range(3):
        simulation.now_s += jump_s
        simulation.until_answered()


def test_a_clock_that_stands_still_leaves_contacts_to_their_arrival(simulation):
    simulation.now_s = 2e4
    simulation.until_answered()
    simulation.runs = False
    simulation.until_answered()
    quality = simulation.outputs.failure(ResultCode.STALE_CONTACTS)
    assert 's old' in quality.result.message
    simulation.runs = True
    simulation.until_answered()


def test_a_clock_at_zero_stamps_nothing(simulation):
    """Samples of a simulation that begins anew count as unstamped."""
    simulation.now_s = 3e4
    simulation.until_answered()
    simulation.now_s = -FEED_PERIOD_S
    simulation.outputs.forget()

    def sample():
        simulation.now_s = -FEED_PERIOD_S  # zero after the tick
        simulation.sample()

    simulation._client.until(lambda: any(
        m.result.code == ResultCode.OPTIMAL and m.header.stamp == Time()
        for m in simulation.outputs.quality), 'an answer', sample)
    simulation.until_answered()

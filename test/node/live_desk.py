# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The node's live loop in this process, with clocks that go on only when they are told to."""

from benchmarks.fuzz.asking import Desk, Silent
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality.node_holding import HoldingForces
from grasp_quality.node_inputs import Inputs
from grasp_quality.node_live import LiveLoop
from grasp_quality.node_margin import MarginTopic
from grasp_quality.node_outputs import Outputs
from grasp_quality.node_settings import Settings
from grasps import ANTIPODAL, pose_array, wrench
from rclpy.time import Time
from std_msgs.msg import Header

MAX_AGE_S = 20.0  # what is left of it limits a solve in true time, on busy machines too
NAMES = ('left', 'right')
START_S = 1e4


class Clocks:
    """ROS time, the steady clock and the system clock [ns]."""

    def __init__(self):
        self.ros = self.steady = self.system = int(START_S * 1e9)

    def wait(self, seconds):
        """Let time pass for all three."""
        passed = round(seconds * 1e9)
        self.ros, self.steady, self.system = (
            now + passed for now in (self.ros, self.steady, self.system))


class LiveDesk:
    """A loop with the task +y, and what it published, by topic."""

    def __init__(self, **parameters):
        self.clocks = clocks = Clocks()
        self.settings = Settings(contact_names=NAMES, max_contact_age=MAX_AGE_S,
                                 solver_time_limit=MAX_AGE_S, **parameters)
        current = lambda: self.settings  # noqa: E731
        self.inputs = Inputs(
            current, lambda: clocks.ros, lambda: clocks.steady, lambda: clocks.system)
        self.inputs.set_task_wrench((0.0, 1.0, 0.0, 0.0, 0.0, 0.0))
        self._desk = Desk()
        outputs = Outputs(self._desk)
        self.loop = LiveLoop(
            self.inputs, outputs, current, Silent(), Silent(),
            MarginTopic(outputs.margin, current), HoldingForces(Silent()), self.stamp)

    def stamp(self, ago_s=0.0):
        """Return the ROS time, or one before."""
        return Time(nanoseconds=self.clocks.ros - round(ago_s * 1e9)).to_msg()

    def contacts(self, ago_s=0.0):
        """Make contacts of now, or of before."""
        return pose_array(ANTIPODAL, self.stamp(ago_s))

    def wrench(self, ago_s=0.0, frame='', **forces):
        """Make a WrenchStamped of now, or of before."""
        return WrenchStamped(
            header=Header(stamp=self.stamp(ago_s), frame_id=frame), wrench=wrench(**forces))

    def store(self, message, sent_ahead_s=0.0):
        """Take contacts or a load that were sent now, by a sender whose clock is ahead."""
        sent_ns = self.clocks.system + round(sent_ahead_s * 1e9)
        keep = self.inputs.store_contacts if isinstance(message, PoseArray) \
            else self.inputs.store_load
        keep(message, sent_ns)

    def evaluate(self):
        """Answer what there is; return the newest message of every topic."""
        self.loop.evaluate()
        return {topic: kept[-1] for topic, kept in self._desk.published.items() if kept}

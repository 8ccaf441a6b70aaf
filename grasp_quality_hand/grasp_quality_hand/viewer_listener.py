# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The viewer's ears: the newest message of every topic, taken when the page is drawn.

The subscriptions are polled and stand in no executor: topics at hundreds of hertz then cost Python
no more than the page's own rate, because the middleware drops all but the newest.
"""

import time
from typing import Any

from geometry_msgs.msg import PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand.viewer_heard import Heard
from grasp_quality_msgs.msg import ContactArray, ContactForceArray, ForceMap, GraspQuality
from msg_adapters.topic_names import names_a_topic
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_msgs.msg import String

NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
WHOLE = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)  # maps come in many packets
LATCHED = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE,
                     durability=DurabilityPolicy.TRANSIENT_LOCAL)
MOST_NAMES = 64                  # of contacts whose measured forces are listened to


class Listener:
    """Fills ``heard`` from the topics of one grasp_quality node and of one hand."""

    def __init__(self, node: Any, target: str, hand: str) -> None:
        self._node, self._target = node, target
        self.heard = Heard()
        self.robot_description: str | None = None
        self._contacts: dict[str, Any] = {}
        self._wrenches: dict[str, Any] = {}
        subscribe = self._subscribe
        self._topics = {
            'quality': subscribe(GraspQuality, f'{target}/quality'),
            'forces': subscribe(ContactForceArray, f'{target}/contact_forces'),
            'force_map': subscribe(ForceMap, f'{target}/force_map', WHOLE),
            'joints': subscribe(JointState, '/joint_states'),
            'object_pose': subscribe(PoseStamped, f'{hand}/object_pose'),
            'up': subscribe(Vector3Stamped, f'{hand}/up_in_object_frame')}
        self._sources = {
            'pose_array': subscribe(PoseArray, f'{target}/contact_poses'),
            'contact_array': subscribe(ContactArray, f'{target}/contacts')}
        self._description = subscribe(String, '/robot_description', LATCHED)

    def poll(self, contact_source: str) -> Heard:
        """
        Take what is new.

        Parameters
        ----------
        contact_source : str
            Parameter of the node: pose_array or contact_array.

        """
        now, heard = time.monotonic(), self.heard
        for name, subscription in self._topics.items():
            message = _newest(subscription)
            if message is not None:
                setattr(heard, name, message)
                if name == 'quality':
                    heard.freshness.note(now)
        for source, subscription in self._sources.items():
            message = _newest(subscription)
            if message is not None and source == contact_source:
                heard.contacts = message
        for name, subscription in self._wrenches.items():
            message = _newest(subscription)
            if message is not None:
                heard.measured[name] = message, now
        description = _newest(self._description)
        if description is not None:
            self.robot_description = description.data
        return heard

    def listen_to(self, names: tuple[str, ...]) -> None:
        """Listen to the measured forces of the contacts of these names too."""
        for name in names:
            if name not in self._wrenches and names_a_topic(name) \
                    and len(self._wrenches) < MOST_NAMES:
                self._wrenches[name] = self._subscribe(
                    WrenchStamped, f'{self._target}/contact_wrenches/{name}')

    def _subscribe(self, message_type: Any, topic: str, profile: QoSProfile = NEWEST) -> Any:
        return self._node.create_subscription(message_type, topic, _never, profile)


def _never(message: Any) -> None:
    """Stand where rclpy wants a callback; no executor runs it."""


def _newest(subscription: Any) -> Any:
    """Take the message that waits, or None."""
    with subscription.handle:
        taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    return None if taken is None else taken[0]

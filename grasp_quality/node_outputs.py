# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the node publishes: one proved answer, or one failure, to all output topics alike.

On anything but OPTIMAL alpha is 0 and the force array empty, and the wrench topics of contacts get
a zero wrench: nothing that was published before stays in force by silence.
"""

import time

from geometry_msgs.msg import WrenchStamped
from grasp_quality_msgs.msg import ContactForceArray, GraspMargin, GraspQuality, ResultCode
from msg_adapters import qos
from msg_adapters.forces import contact_frame_wrench, force_array
from msg_adapters.topic_names import names_a_topic, TOPIC_RULE
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks
from std_msgs.msg import Float64, Header

MAX_WRENCH_TOPICS = 256


class Outputs:
    """Lifecycle publishers of a node; they are silent until it is active."""

    def __init__(self, node):
        self._node = node
        self._alpha = self._publisher(Float64, '~/alpha')
        self._quality = self._publisher(GraspQuality, '~/quality')
        self._forces = self._publisher(ContactForceArray, '~/contact_forces')
        self._holding = self._publisher(ContactForceArray, '~/holding_forces')
        self.margin = self._publisher(GraspMargin, '~/margin')
        self._wrenches = {}  # contact name: publisher, or None where the name makes no topic

    def publish(self, quality, grasp=None, forces=(), cone_usage=(), check=lambda: None):
        """
        Publish an answer.

        Parameters
        ----------
        quality : GraspQuality
            Forces are published only with result OPTIMAL.
        grasp : Grasp
            What the forces belong to; not needed with another result.
        forces : (k, 4) array [N, N, N, N m]
            [t1, t2, n, m_n] in the contact frames, finger on object.
        cone_usage : (k,) array
            Share of each friction cone in use.
        check : callable
            Raises when the answer must not be published any more; asked when the forces are a
            message already, so that nothing is left between it and the writing.

        """
        optimal = quality.result.code == ResultCode.OPTIMAL
        if not optimal:
            grasp, forces, cone_usage = None, (), ()
        # nothing is latched, so that building a message for nobody would only cost time
        message = force_array(quality.header, grasp, forces, cone_usage) \
            if self._forces.get_subscription_count() else None
        check()
        if message is not None:
            self._forces.publish(message)
        if self._quality.get_subscription_count():
            self._quality.publish(quality)
        if self._alpha.get_subscription_count():
            self._alpha.publish(Float64(data=quality.alpha if optimal else 0.0))
        self._publish_wrenches(
            quality.header.stamp, dict(zip(grasp.names, forces)) if optimal else {})
        if not optimal and self.holding_wanted:
            self.publish_holding(quality.header, None)

    def rivals(self):
        """Say which topics of forces somebody else publishes on too."""
        topics = (publisher.topic_name for publisher in (self._forces, self._holding))
        return [f'another node publishes on {topic}: two nodes of one name?'
                for topic in topics if self._node.count_publishers(topic) > 1]

    @property
    def holding_wanted(self):
        """Whether somebody listens to the holding forces."""
        return self._holding.get_subscription_count() > 0

    def publish_holding(self, header, held, check=lambda: None):
        """Publish HoldForces unless ``check`` raises at the last; for None that there are none."""
        message = force_array(header) if held is None else force_array(
            header, held.grasp, held.forces, held.cone_usage)
        if held is not None:
            check()
        self._holding.publish(message)

    def publish_failure(self, result, stamp, frame=''):
        """Publish a ResultCode other than OPTIMAL, stamped with its contacts' time or now."""
        self.publish(GraspQuality(header=Header(stamp=stamp, frame_id=frame), result=result))

    def flush(self, timeout_s, others=()):
        """Wait until all subscribers have what was published: destroying a publisher drops it."""
        deadline = time.monotonic() + timeout_s
        own = (self._forces, self._holding, self._quality, self._alpha, self.margin,
               *self._wrenches.values())
        for publisher in (*own, *others):
            left = deadline - time.monotonic()
            if publisher is not None and left > 0.0:
                publisher.wait_for_all_acked(Duration(seconds=left))

    def _publish_wrenches(self, stamp, forces):
        for name in forces:
            if name not in self._wrenches and len(self._wrenches) < MAX_WRENCH_TOPICS:
                self._wrenches[name] = self._wrench_publisher(name)
        for name, publisher in self._wrenches.items():
            if publisher is not None and publisher.get_subscription_count():
                message = contact_frame_wrench(stamp, name, *(
                    [forces[name]] if name in forces else []))
                publisher.publish(message)

    def _wrench_publisher(self, name):
        if len(self._wrenches) + 1 == MAX_WRENCH_TOPICS:
            self._node.get_logger().warning(
                f'{MAX_WRENCH_TOPICS} contact names seen: further ones get no topic '
                '~/optimal_wrenches/<name>, their forces are on ~/contact_forces')
        if not names_a_topic(name):
            self._node.get_logger().warning(
                f'no topic ~/optimal_wrenches/{name}: {TOPIC_RULE}; its forces are on '
                '~/contact_forces')
            return None
        publisher = self._publisher(WrenchStamped, f'~/optimal_wrenches/{name}')
        if self._node.active:
            publisher.on_activate(None)
        return publisher

    def declare_wrenches(self, names):
        """Create the wrench topics of names known beforehand, so that they can be discovered."""
        for name in names:
            self._wrenches.setdefault(name, self._wrench_publisher(name))

    def _publisher(self, message_type, topic):
        # an event handler a publisher would double what the executor waits for; whoever asks for
        # more than these topics offer is told by their own subscription
        return self._node.create_lifecycle_publisher(
            message_type, topic, qos.newest_command(),
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False))

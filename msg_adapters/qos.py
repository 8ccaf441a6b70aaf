# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
QoS profiles by what they are for.

Nothing is ever latched: effort controllers hold their last command for ever, so an old force must
not be replayed to a late joiner.
"""

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy


def newest_sample() -> QoSProfile:
    """Sensor streams: the newest sample or none, never a queue, never a retry."""
    return _depth_one(ReliabilityPolicy.BEST_EFFORT)


def newest_command() -> QoSProfile:
    """Tasks, loads and all outputs: reliable, but only the newest, and never to late joiners."""
    return _depth_one(ReliabilityPolicy.RELIABLE)


def questions() -> QoSProfile:
    """
    Services: reliable, with room for a thousand questions or answers, as for parameters of ROS.

    Every client of a service receives the answers to all of them and keeps as many as its depth
    says, its own or not: at ROS 2's usual 10 a client that looks too seldom loses its own answer.

    """
    return QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=1000,
                      reliability=ReliabilityPolicy.RELIABLE,
                      durability=DurabilityPolicy.VOLATILE)


def display() -> QoSProfile:
    """Markers: reliable, and none overwritten by the next, because one may take others away."""
    return QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=10,
                      reliability=ReliabilityPolicy.RELIABLE,
                      durability=DurabilityPolicy.VOLATILE)


def _depth_one(reliability: ReliabilityPolicy) -> QoSProfile:
    return QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=1, reliability=reliability,
                      durability=DurabilityPolicy.VOLATILE)

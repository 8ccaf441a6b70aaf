# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""QoS: nothing is latched, nothing queues."""

from msg_adapters import qos
import pytest
from rclpy.qos import (
    DurabilityPolicy, HistoryPolicy, qos_profile_parameters, ReliabilityPolicy)


@pytest.mark.parametrize('make', [qos.newest_sample, qos.newest_command])
def test_only_the_newest_and_never_to_late_joiners(make):
    profile = make()
    assert profile.durability == DurabilityPolicy.VOLATILE
    assert profile.history == HistoryPolicy.KEEP_LAST
    assert profile.depth == 1


def test_samples_may_be_lost_and_commands_may_not():
    assert qos.newest_sample().reliability == ReliabilityPolicy.BEST_EFFORT
    assert qos.newest_command().reliability == ReliabilityPolicy.RELIABLE


def test_questions_and_answers_wait_for_a_client_that_looks_seldom():
    """As those of parameters do, of which ROS 2 keeps a thousand."""
    profile = qos.questions()
    parameters = qos_profile_parameters
    assert (profile.history, profile.depth) == (parameters.history, parameters.depth)
    assert profile.reliability == ReliabilityPolicy.RELIABLE
    assert profile.durability == DurabilityPolicy.VOLATILE


def test_markers_wait_in_a_queue_and_are_not_latched_either():
    """A DELETEALL must not be overwritten by the picture that follows it."""
    profile = qos.display()
    assert profile.history == HistoryPolicy.KEEP_LAST and profile.depth > 1
    assert profile.reliability == ReliabilityPolicy.RELIABLE
    assert profile.durability == DurabilityPolicy.VOLATILE

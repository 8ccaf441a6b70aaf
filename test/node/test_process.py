# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The process: how it starts, how it ends, and what it says when it cannot start."""

import signal

from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
from harness import start_node
import pytest


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_code_zero_and_a_last_word(start, number):
    node = start()
    quality = node.client.listen(GraspQuality, 'quality')
    forces = node.client.listen(ContactForceArray, 'contact_forces')
    node.client.until(lambda: quality, 'the watchdog')
    assert node.process.end(number) == 0
    node.client.until(
        lambda: quality[-1].result.code == ResultCode.NOT_ACTIVE, 'NOT_ACTIVE at the end')
    assert 'ending' in quality[-1].result.message
    assert not any(message.forces for message in forces)


@pytest.mark.parametrize('parameter, words', [
    ({'friction_coefficient': '-0.5'}, 'friction_coefficient out of range'),
    ({'contact_model': 'RUBBER'}, "contact_model must be one of ['FPC', 'PCWF', 'SFCE']"),
    ({'contact_fingers': '[a, b]', 'contact_names': '[x]'}, 'contact_fingers must name one'),
    ({'friction_coefficient': 'high'}, "'friction_coefficient' to 'high'")])
def test_a_bad_override_ends_it_with_one_clear_line(tmp_path, parameter, words):
    process = start_node(tmp_path / 'log.txt', '/refused', **parameter)
    assert process.wait() == 1
    line, = process.log().splitlines()
    assert line.startswith('grasp_quality_node: ') and words in line


@pytest.mark.parametrize('arguments, words', [
    (('--params-file', 'none.yaml'), 'none.yaml'), (('--nonsense',), '--nonsense')])
def test_arguments_that_ros_cannot_read_are_named(tmp_path, arguments, words):
    process = start_node(tmp_path / 'log.txt', '/refused', '--ros-args', *arguments, '--')
    assert process.wait() == 1
    line = process.log().splitlines()[-1]  # below what ROS itself has to say
    assert line.startswith('grasp_quality_node: ') and words in line

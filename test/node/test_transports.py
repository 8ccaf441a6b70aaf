# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Tests talk as ``transports`` says: by UDP on loopback and without shared memory, or by default.

That is looked up in the processes, because the middleware takes settings that do not go together
without a word.
"""

import os
from pathlib import Path
import signal

from geometry_msgs.msg import PoseArray
from grasps import EIGHT, pose_array
from harness import BEST_EFFORT
import pytest
from rcl_interfaces.srv import GetParameters
import transports

LOOPBACK = '0100007F'  # as in /proc/net/udp
pytestmark = [pytest.mark.alone, pytest.mark.robot]  # losses under load are of the sender too
MANY = 10              # times as many as are sent at once: more than a socket keeps
SAMPLES = 500


@pytest.mark.parametrize('whose', ['node', 'audit', 'client'])
def test_processes_talk_as_they_were_told(start, whose):
    node = start()
    node.client.call(GetParameters, 'get_parameters')
    pid = {'node': node.process.popen.pid, 'audit': node.audit.popen.pid,
           'client': os.getpid()}[whose]
    addresses = {row[1].partition(':')[0] for row in transports.udp_sockets(pid)}
    segments = [line for line in Path(f'/proc/{pid}/maps').read_text().splitlines()
                if '/shm/fastrtps_' in line]
    if transports.are_default():
        assert segments and addresses - {LOOPBACK}
    else:
        assert not segments and addresses == {LOOPBACK}


def test_every_sample_that_a_stopped_node_has_no_room_for_is_counted(start):
    """That is so where all go by UDP; what shared memory has no room for nobody counts."""
    node = start()
    pid = node.process.popen.pid
    publisher = node.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    node.client.until(
        lambda: publisher.get_subscription_count() == 2, 'the node and its auditor to listen')

    def send():
        for _ in range(SAMPLES):
            publisher.publish(pose_array(EIGHT))

    none = transports.dropped(pid)
    node.process.popen.send_signal(signal.SIGSTOP)
    try:
        for _ in range(MANY):  # no longer than it takes: who is silent for 20 s is let go
            send()
            full = transports.dropped(pid)
            if full > none:
                break
        send()
        more = transports.dropped(pid)
    finally:
        node.process.popen.send_signal(signal.SIGCONT)
    if transports.are_default():
        assert more - full < SAMPLES
    else:
        assert full > none and more - full >= SAMPLES


def test_nobody_runs_without_the_profile(monkeypatch, tmp_path):
    """Fast DDS would pass over a file that is not there, and talk to the whole subnet."""
    monkeypatch.delenv(transports.CHOICE, raising=False)
    monkeypatch.setattr(transports, 'PROFILE', tmp_path / 'loopback.xml')
    with pytest.raises(FileNotFoundError, match='this machine'):
        transports.keep_to_this_machine()


def test_a_misspelt_choice_is_refused(monkeypatch):
    monkeypatch.setenv(transports.CHOICE, 'Default')
    with pytest.raises(ValueError, match='loopback or default'):
        transports.keep_to_this_machine()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The recorder: it ends when it has what was asked for, and says what it hears and does not."""

import signal

from geometry_msgs.msg import PoseArray
from grasp_quality_hand import bag_recorder
from grasp_quality_hand.demo_processes import executable
from harness import BEST_EFFORT, Client, Process
import pytest
from rosbags.rosbag2 import Reader

TOPIC = '/a_hand/grasp_quality/contact_poses'


@pytest.fixture
def record(tmp_path):
    """Return a function that starts the recorder on tmp_path / 'bag'; it is ended behind."""
    begun = []

    def begin(*arguments):
        begun.append(Process([executable('grasp_quality_hand', 'bag_recorder'), tmp_path / 'bag',
                              '--node', '/a_hand/grasp_quality', *arguments],
                             tmp_path / f'{len(begun)}.txt'))
        return begun[-1]

    yield begin
    for process in begun:
        if process.popen.poll() is None:
            process.end()


@pytest.fixture
def client():
    client = Client('/a_hand')
    yield client
    client.close()


def test_it_ends_with_as_many_as_were_asked_for(client, record, tmp_path):
    process = record('--messages', '20')
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    client.until(lambda: process.popen.poll() is not None, 'the recorder to end',
                 lambda: publisher.publish(PoseArray()))
    assert process.wait() == 0, process.log()
    assert process.log().splitlines()[1:] == [
        f'hears {TOPIC}', f'recorded 20 messages to {tmp_path / "bag"}']
    with Reader(tmp_path / 'bag') as bag:
        assert [bag.message_count, len(list(bag.messages()))] == [20, 20]


def test_it_says_that_it_hears_nothing_and_ends_with_a_whole_bag(record, tmp_path):
    process = record()
    process.until_it_says(f'nothing heard yet on {TOPIC}')
    assert process.end(signal.SIGTERM) == 0
    assert process.log().endswith(f'recorded 0 messages to {tmp_path / "bag"}\n')
    with Reader(tmp_path / 'bag') as bag:
        assert bag.message_count == 0


def test_less_than_one_message_is_no_bag(tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        bag_recorder.main([str(tmp_path / 'bag'), '--messages', '0'])
    assert ended.value.code == 2 and 'at least 1' in capsys.readouterr().err
    assert not (tmp_path / 'bag').exists()

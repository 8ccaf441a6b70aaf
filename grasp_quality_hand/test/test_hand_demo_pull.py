# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo says and draws of pulls on a hand that is not commanded in time."""

import time
from types import SimpleNamespace

from geometry_msgs.msg import PoseStamped
from grasp_quality_hand import demo_client, demo_pull
from grasp_quality_hand.demo_processes import DemoFailure, DemoTimeout
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_model import build_hand_model
from grasp_quality_hand.measured_grasp import MeasuredGrasp
from grasp_quality_hand.pull_animation import draw_pull, FRAMES, LAST_FRAMES
import numpy as np
from PIL import Image
import pytest


@pytest.fixture
def clock(monkeypatch):
    """Give a steady clock that stands until it is set."""
    clock = SimpleNamespace(now=100.0)
    monkeypatch.setattr(demo_client.time, 'monotonic', lambda: clock.now)
    return clock


def test_silence_is_the_longest_time_between_two_commands(clock):
    client = SimpleNamespace(heard=demo_client.Heard())
    for clock.now in (100.0, 100.01, 100.21, 100.22):
        demo_client.DemoClient._on_command(client, None)
    assert client.heard.commands == 4 and client.heard.silence == pytest.approx(0.2)


@pytest.mark.parametrize('silence, busy', [(0.049, False), (0.42, True)])
def test_a_pull_with_rare_commands_is_said_to_tell_nothing_of_the_grasp(silence, busy):
    record = demo_pull.PullRecord('down', None, alpha=20.0, held=0.4, silence=silence)
    text = '\n'.join(demo_pull._table('cube', [record]))
    assert '0.020' in text
    assert ('up to 420 ms apart' in text and 'nothing of the grasp' in text) == busy


@pytest.mark.parametrize('silence, busy, failure', [
    (0.01, False, DemoTimeout), (0.42, True, DemoTimeout), (0.42, False, DemoFailure)])
def test_an_object_that_is_not_held_still_is_a_fault_unless_the_machine_was_busy(
        monkeypatch, silence, busy, failure):
    """Nor is it the machine's when a process of the demo has ended, which is no DemoTimeout."""
    def listen_until(condition, deadline, complaint):
        if 'still' in complaint:
            client.heard.silence, client.heard.commanded = silence, time.monotonic()
            raise failure(complaint)

    client = SimpleNamespace(
        heard=demo_client.Heard(silence=3.0), listen_until=listen_until,
        ask=lambda *request: (SimpleNamespace(alpha=20.0), 0.001))
    measured = SimpleNamespace(weight=np.zeros(3))
    monkeypatch.setattr(demo_pull, 'newest_sample', lambda client: measured)
    follower = SimpleNamespace(take=lambda *what: None, blend=lambda: None)
    pull = (client, follower, OBJECTS['cube'], 10.0, '/hand', 'down')
    if not busy:
        with pytest.raises(DemoFailure, match='hold the object still'):
            demo_pull._pull(*pull)
        return
    text = '\n'.join(demo_pull._table('cube', [demo_pull._pull(*pull)]))
    assert 'not pulled' in text and 'up to 420 ms apart' in text and '20.000 N' in text


@pytest.mark.parametrize('samples', [1, LAST_FRAMES, LAST_FRAMES + 2])
def test_a_pull_that_is_over_soon_is_drawn_too(tmp_path, samples):
    cube = OBJECTS['cube']
    names = build_hand_model(cube).joint_names
    measured = MeasuredGrasp(('a', 'b', 'c'), cube.contact_points, np.tile(np.eye(3), (3, 1, 1)),
                             np.zeros((3, 4)), np.zeros(3))
    joints = SimpleNamespace(name=names, position=[0.0] * len(names))
    frames = [demo_pull.Frame(0.1 * i, 0.0, joints, PoseStamped(), measured)
              for i in range(samples)]
    record = demo_pull.PullRecord('down', np.array([0.0, 0.0, -1.0]), 20.0, frames=frames)
    draw_pull(tmp_path / 'pull.gif', cube, record)
    with Image.open(tmp_path / 'pull.gif') as picture:
        assert 1 <= picture.n_frames <= FRAMES + LAST_FRAMES

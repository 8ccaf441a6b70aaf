# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo says and draws of pulls on a hand that is not commanded in time."""

from types import SimpleNamespace

from geometry_msgs.msg import PoseStamped
from grasp_quality_hand import demo_client, demo_pull
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

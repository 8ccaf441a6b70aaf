# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the demo says of its pulls: a hand that was not commanded in time tells nothing."""

from types import SimpleNamespace

from grasp_quality_hand import demo_client, demo_pull
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

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Silence of a stream is told within a second, and slow streams are not called silent."""

from types import SimpleNamespace

from grasp_quality_hand.viewer_heard import Freshness, Heard, MEASURED_S, STALE_S
from hypothesis import given, strategies
import pytest


def stream(interval, count=20):
    freshness = Freshness()
    for i in range(count):
        freshness.note(i * interval)
    return freshness, (count - 1) * interval


def test_nothing_heard_is_stale_and_has_no_age():
    assert Freshness().stale(10.0)
    assert Freshness().age(10.0) is None


@given(strategies.floats(0.001, 0.2))
def test_a_live_stream_that_ends_is_stale_within_a_second(interval):
    freshness, last = stream(interval)
    assert not freshness.stale(last + 0.4)
    assert freshness.stale(last + 1.0)
    assert freshness.age(last + 1.0) == pytest.approx(1.0)


def test_a_slow_stream_is_not_stale_between_its_messages():
    freshness, last = stream(0.45)
    assert not freshness.stale(last + 1.2)
    assert freshness.stale(last + 2.0)


def test_a_gap_does_not_count_as_an_interval():
    freshness, last = stream(0.01)
    freshness.note(last + 100.0)
    assert not freshness.stale(last + 100.0 + 0.9 * STALE_S)
    assert freshness.stale(last + 100.0 + 1.1 * STALE_S)


def test_measured_forces_are_forgotten():
    heard = Heard(measured={'old': (SimpleNamespace(), 0.0), 'new': (SimpleNamespace(), 1.0)})
    assert list(heard.measured_now(0.9 + MEASURED_S)) == ['new']

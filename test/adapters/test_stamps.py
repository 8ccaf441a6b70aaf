# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Times: seconds, nanoseconds and their messages."""

from builtin_interfaces.msg import Duration, Time
from hypothesis import given, strategies
from msg_adapters.stamps import seconds, stamp_ns, to_duration
import pytest


def test_a_stamp_is_counted_in_nanoseconds():
    assert stamp_ns(Time(sec=3, nanosec=5)) == 3_000_000_005


def test_the_zero_stamp_is_zero():
    assert stamp_ns(Time()) == 0


@given(strategies.floats(-1e6, 1e6))
def test_durations_round_trip_to_the_nanosecond(value):
    message = to_duration(value)
    assert 0 <= message.nanosec < 1_000_000_000
    assert seconds(message) == pytest.approx(value, abs=1e-9)


@pytest.mark.parametrize('value, sec, nanosec', [
    (0.0, 0, 0), (0.25, 0, 250_000_000), (1.9999999999, 2, 0), (-0.25, -1, 750_000_000)])
def test_durations_carry_into_whole_seconds(value, sec, nanosec):
    assert to_duration(value) == Duration(sec=sec, nanosec=nanosec)

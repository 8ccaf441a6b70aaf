# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Times: builtin_interfaces messages to and from seconds and nanoseconds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msg_adapters.message_types import Stamp

if TYPE_CHECKING:
    from builtin_interfaces.msg import Duration

NANOSECONDS = 1_000_000_000


def stamp_ns(stamp: Stamp) -> int:
    """Return a Time message in nanoseconds since the epoch; 0 stands for 'not stamped'."""
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def to_duration(seconds: float) -> Duration:
    """Return a Duration message of a finite number of seconds, to the nanosecond."""
    from builtin_interfaces.msg import Duration
    whole, nanoseconds = divmod(round(seconds * NANOSECONDS), NANOSECONDS)
    return Duration(sec=int(whole), nanosec=int(nanoseconds))


def seconds(duration: Stamp) -> float:
    """Return a Duration message in seconds."""
    return duration.sec + duration.nanosec / NANOSECONDS

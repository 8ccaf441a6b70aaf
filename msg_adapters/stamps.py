# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Times: builtin_interfaces messages to and from seconds and nanoseconds."""

NANOSECONDS = 1_000_000_000


def stamp_ns(stamp):
    """Return a Time message in nanoseconds since the epoch; 0 stands for 'not stamped'."""
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


def to_duration(seconds):
    """Return a Duration message of a finite number of seconds, to the nanosecond."""
    from builtin_interfaces.msg import Duration
    whole, nanoseconds = divmod(round(seconds * NANOSECONDS), NANOSECONDS)
    return Duration(sec=int(whole), nanosec=int(nanoseconds))


def seconds(duration):
    """Return a Duration message in seconds."""
    return duration.sec + duration.nanosec / NANOSECONDS

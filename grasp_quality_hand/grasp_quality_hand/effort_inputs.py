# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The newest message of a kind, and whether it may still be used.

A message is as old as the older of its stamp (ROS clock) and its arrival (steady clock) says. One
that comes late, behind a newer one that is still fresh, is dropped; so that a clock that was set
back stops nothing for longer than the age limit.
"""

from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar('T')


class Unusable(Exception):
    """There is nothing to follow now; the message says why."""


@dataclass(frozen=True)
class Now:
    """An instant, by the ROS clock [ns] and by the steady clock [s]."""

    ros_ns: int
    steady_s: float


class Newest(Generic[T]):
    """
    The newest message of a topic.

    Parameters
    ----------
    what : str
        The plural that it is called by in reasons.
    max_age : float
        [s]

    """

    def __init__(self, what: str, max_age: float) -> None:
        self._what, self._max_age = what, max_age
        self._value: T | None = None
        self._stamp_ns, self._arrival_s = 0, 0.0
        self.dropped = 0

    def put(self, value: T, stamp_ns: int, now: Now) -> None:
        """Keep a message with a stamp in ns, 0 for none, unless it comes late."""
        if stamp_ns and stamp_ns < self._stamp_ns and abs(self.age(now)) <= self._max_age:
            self.dropped += 1
            return
        self._value, self._stamp_ns, self._arrival_s = value, stamp_ns, now.steady_s

    def age(self, now: Now) -> float:
        """Age [s], negative when it is stamped ahead of this clock; inf for no message."""
        if self._value is None:
            return float('inf')
        since_arrival = now.steady_s - self._arrival_s
        if not self._stamp_ns:
            return since_arrival
        by_stamp = (now.ros_ns - self._stamp_ns) * 1e-9
        return by_stamp if by_stamp < -self._max_age else max(since_arrival, by_stamp)

    def fresh(self, now: Now) -> T:
        """
        Return the newest message.

        Raises
        ------
        Unusable
            There is none, or it is too old, or from the future.

        """
        if self._value is None:
            raise Unusable(f'no {self._what} have come yet')
        age = self.age(now)
        if age > self._max_age:
            raise Unusable(f'the newest {self._what} are older than {self._max_age:g} s')
        if age < -self._max_age:
            raise Unusable(f'the {self._what} are stamped more than {self._max_age:g} s ahead of '
                           'this clock: synchronise the clocks')
        return self._value

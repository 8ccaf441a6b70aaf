# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The newest message of a kind, and whether it may still be used.

A message is as old as its stamp (ROS clock), its sending (system clock) or its arrival (steady
clock) says, whichever is oldest: one without a stamp may have waited in a queue. One that comes
late, behind a newer stamp that is still fresh, is dropped; so that a clock that was set back stops
nothing for longer than the age limit.
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
        self._times = (0, 0.0)   # stamp [ns], 0 for none, and sending [s] by the steady clock
        self._latest = (0, 0.0)  # of the newest stamp: what has none must not let older ones in
        self._refused = ''
        self.dropped = 0

    def put(self, value: T, stamp_ns: int, now: Now, waited_s: float = 0.0) -> None:
        """
        Keep a message, unless it comes late.

        Parameters
        ----------
        value : T
            What is kept.
        stamp_ns : int
            0 for none.
        now : Now
            When it was read.
        waited_s : float
            From its sending until then [s].

        """
        times = (stamp_ns, now.steady_s - max(0.0, waited_s))
        if stamp_ns:
            if stamp_ns < self._latest[0] and abs(self._age(self._latest, now)) <= self._max_age:
                self.dropped += 1
                return
            self._latest = times
        self._value, self._times, self._refused = value, times, ''

    def refuse(self, why: str) -> None:
        """Leave a message out, and say so where the one before it is no use any more."""
        self._refused = f'; the last one was refused: {why}'

    def age(self, now: Now) -> float:
        """Age [s], negative when it is stamped ahead of this clock; inf for no message."""
        return float('inf') if self._value is None else self._age(self._times, now)

    def _age(self, times: tuple[int, float], now: Now) -> float:
        stamp_ns, sent_s = times
        since_sent = now.steady_s - sent_s
        if not stamp_ns:
            return since_sent
        by_stamp = (now.ros_ns - stamp_ns) * 1e-9
        return by_stamp if by_stamp < -self._max_age else max(since_sent, by_stamp)

    def fresh(self, now: Now) -> T:
        """
        Return the newest message.

        Raises
        ------
        Unusable
            There is none, or it is too old, or from the future.

        """
        if self._value is None:
            raise Unusable(f'no {self._what} have come yet{self._refused}')
        age = self.age(now)
        if age > self._max_age:
            raise Unusable(f'the newest {self._what} are older than {self._max_age:g} s'
                           f'{self._refused}')
        if age < -self._max_age:
            raise Unusable(f'the {self._what} are stamped more than {self._max_age:g} s ahead of '
                           'this clock: synchronise the clocks')
        return self._value

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
How old messages are.

Arrival is told by the steady clock, stamps by the ROS clock: a message is as old as the older of
the two says. Without a stamp its sending counts, by the clock of the sender: it may have waited in
a queue. Neither may lie further ahead than a message may be old: behind a sender whose clock is
ahead, waiting would not show.
"""

from collections.abc import Callable
import math
import time
from typing import Any, NamedTuple

from grasp_quality.node_settings import Settings
from grasp_quality.time_limit import TimeLimit
from msg_adapters.errors import StaleContactsError
from msg_adapters.message_types import Stamped
from msg_adapters.stamps import stamp_ns

ASK_FOR_LESS = 'raise solver_time_limit or ask for less'
STALE_SOON = ('contacts, or what else ages, are too old by then: send fresh ones more often, give '
              'the node more of the processor, or raise max_contact_age (max_load_age)')


class Received(NamedTuple):
    """
    A message that was received.

    Attributes
    ----------
    message : Stamped
    arrival_ns : int
        By the steady clock.
    waited_ns : int
        From its sending, by the clock of the sender, to its arrival; below 0 where that clock is
        ahead by more than it waited. 0 where its sending is not known.

    """

    message: Any
    arrival_ns: int
    waited_ns: int


class Subject(NamedTuple):
    """
    What must not be older than a parameter says.

    Attributes
    ----------
    words : str
        Beginning of the sentence, with its verb.
    parameter : str
        That names the largest age [s].
    cure : str
        What to do where it is too old.

    """

    words: str
    parameter: str
    cure: str


class Ages:
    """
    Ages by three clocks.

    ``now_ns()`` is the ROS time, ``steady_ns()`` that of the steady clock, and ``system_ns()``
    that of the system clock, by which the middleware says when a message was sent.

    """

    def __init__(self, settings: Callable[[], Settings], now_ns: Callable[[], int],
                 steady_ns: Callable[[], int],
                 system_ns: Callable[[], int] = time.time_ns) -> None:
        self._settings = settings
        self._now_ns = now_ns
        self._steady_ns = steady_ns
        self._system_ns = system_ns

    def received(self, message: Stamped, sent_ns: int | None) -> Received:
        """Note when a message arrives that was sent then, by the system clock of its sender."""
        return Received(message, self._steady_ns(),
                        0 if sent_ns is None else self._system_ns() - sent_ns)

    def of(self, received: Received) -> tuple[float, float]:
        """Ages by arrival, and by stamp or else by sending [s]; below 0: from the future."""
        since_arrival_ns = self._steady_ns() - received.arrival_ns
        stamp = stamp_ns(received.message.header.stamp)
        claimed_ns = self._now_ns() - stamp if stamp else since_arrival_ns + received.waited_ns
        return since_arrival_ns * 1e-9, claimed_ns * 1e-9

    def checked_s(self, received: Received, subject: Subject) -> float:
        """
        Age of a message [s], at least 0.

        Raises
        ------
        StaleContactsError
            When it is more than the parameter of the subject, or as far in the future.

        """
        limit = getattr(self._settings(), subject.parameter)
        ages = self.of(received)
        is_stamped = stamp_ns(received.message.header.stamp) != 0
        if min(ages) < -limit:
            said = 'stamped' if is_stamped else 'not stamped, and by the clock of the sender sent'
            raise StaleContactsError(
                f'{subject.words} {said} {-min(ages):.3f} s ahead of this clock: synchronise the '
                f'clocks ({subject.parameter} is the tolerance)')
        if max(ages) > limit:
            how = '' if is_stamped else (
                ' (not stamped: since it was sent by the clock of the sender, which must agree '
                'with this one)')
            raise StaleContactsError(
                f'{subject.words} {max(ages):.3f} s old{how}, {subject.parameter} is {limit:g} s: '
                f'{subject.cure}')
        return max(*ages, 0.0)

    def is_late(self, message: Stamped, held: Received | None, subject: Subject) -> bool:
        """Whether a message is stamped before the one that is held, while that is not stale."""
        stamp = stamp_ns(message.header.stamp)
        if held is None or not stamp:
            return False
        try:
            self.checked_s(held, subject)
        except StaleContactsError:
            return False
        return stamp < stamp_ns(held.message.header.stamp)


def until_stale(left_s: float, most_s: float = math.inf) -> TimeLimit:
    """Limit a solve to ``most_s``, or to what is left until what it rests on is too old [s]."""
    return TimeLimit(most_s, ASK_FOR_LESS) if most_s <= left_s else TimeLimit(left_s, STALE_SOON)

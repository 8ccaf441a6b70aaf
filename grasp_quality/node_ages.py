# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
How old messages are.

Arrival is told by the steady clock, stamps by the ROS clock: a message is as old as the older of
the two says. Without a stamp it is as old as its sending, by the clock of the sender: it may have
waited in a queue.
"""

from collections.abc import Callable
import time
from typing import NamedTuple

from grasp_quality.node_settings import Settings
from msg_adapters.errors import StaleContactsError
from msg_adapters.message_types import Stamped
from msg_adapters.stamps import stamp_ns


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
        End of the sentence where it is too old.

    """

    words: str
    parameter: str
    cure: str = ''


class Ages:
    """Ages by ``now_ns()``, the ROS time, and ``steady_ns()``, that of the steady clock."""

    def __init__(self, settings: Callable[[], Settings], now_ns: Callable[[], int],
                 steady_ns: Callable[[], int]) -> None:
        self._settings = settings
        self._now_ns = now_ns
        self._steady_ns = steady_ns

    def arrival_ns(self, message: Stamped, sent_ns: int | None) -> int:
        """Steady time of arrival; without a stamp, of sending: it may have waited in a queue."""
        waited = 0 if sent_ns is None or stamp_ns(message.header.stamp) \
            else max(0, time.time_ns() - sent_ns)
        return self._steady_ns() - waited

    def of(self, message: Stamped, arrival: int) -> tuple[float, float]:
        """Return the ages of a message by arrival and by stamp [s]; below 0: from the future."""
        since_arrival = (self._steady_ns() - arrival) * 1e-9
        stamp = stamp_ns(message.header.stamp)
        return since_arrival, (self._now_ns() - stamp) * 1e-9 if stamp else since_arrival

    def checked_s(self, message: Stamped, arrival: int, subject: Subject) -> float:
        """
        Age of a message [s], at least 0.

        Raises
        ------
        StaleContactsError
            When it is more than the parameter of the subject, or as far in the future.

        """
        limit = getattr(self._settings(), subject.parameter)
        ages = self.of(message, arrival)
        if min(ages) < -limit:
            raise StaleContactsError(
                f'{subject.words} stamped {-min(ages):.3f} s ahead of this clock: synchronise the '
                f'clocks ({subject.parameter} is the tolerance)')
        if max(ages) > limit:
            raise StaleContactsError(
                f'{subject.words} {max(ages):.3f} s old, {subject.parameter} is {limit:g} s'
                + ' (not stamped: as sent)' * (stamp_ns(message.header.stamp) == 0)
                + subject.cure)
        return max(max(ages), 0.0)

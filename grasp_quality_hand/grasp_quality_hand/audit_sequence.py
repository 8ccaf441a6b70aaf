# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Which messages of a topic did not come, by the numbers that every publisher gives to its own.

A topic may have several publishers, and the number does not say whose it is. So every message may
follow any that has a lower number, and where that leaves a choice, the one is taken by which more
is missing. Of a publisher that is started anew there is no choice once the one before it has been
silent for ``GONE_S``. That something is missing is known only when a later one has come.
"""

from collections import deque

MOST = 8  # publishers of one topic that are told apart; the one heard last is kept longest
CLOCKS_S = 0.1  # error of times of sending: two clocks are read, at worst with a pause between
GONE_S = 5.0  # a publisher that says nothing for so long while others speak is gone


class Sequence:
    """Follows the messages of one topic."""

    def __init__(self) -> None:
        # Last of each publisher: number, when sent. For every publisher there is one that is not
        # above its true last in either: see the removal in lost_since.
        self._newest: list[tuple[int, float]] = []
        self._heard_s = -float('inf')

    def lost_since(self, number: int | None, sent_s: float) -> float | None:
        """
        Take the number of a message, and return since when messages before it may be missing.

        Returns
        -------
        float or None
            Time when the last one before the missing was sent [s], by the clock of ``sent_s``.
            None when this one follows another. Where the middleware counts nothing (number is
            None) any may be missing.

        """
        heard_s, self._heard_s = self._heard_s, max(self._heard_s, sent_s)
        if number is None:
            return heard_s
        newest = [last for last in self._newest if last[1] >= heard_s - GONE_S]
        below = [last for last in newest if last[0] < number]
        if not below:  # what a publisher not heard before comes after, nobody knows
            since_s = None if number == 1 and not newest else heard_s if number == 1 \
                else -float('inf')
        else:
            since_s = min((last_s for last, last_s in below if last < number - 1), default=None)
            # the highest goes, so that the lowest numbers stay; each of these may be what stays of
            # the publisher of the highest, and so takes its time where that is the earlier one
            highest = max(below)
            newest.remove(highest)
            newest = [(last, min(last_s, highest[1]) if last < number else last_s)
                      for last, last_s in newest]
        self._newest = [*newest, (number, sent_s)][-MOST:]
        return since_s


class Gaps:
    """Times about which messages of one topic did not come, or may come still."""

    def __init__(self) -> None:
        self._lost: deque[tuple[float, float]] = deque()  # from, to
        self._newest_s = -float('inf')

    def note(self, sent_s: float, lost_since_s: float | None) -> None:
        """Take when a message was sent, and what ``Sequence`` said of it."""
        self._newest_s = max(self._newest_s, sent_s)
        if lost_since_s is None:
            return
        if self._lost and lost_since_s <= self._lost[-1][1] <= sent_s:  # without end otherwise
            lost_since_s = min(lost_since_s, self._lost.pop()[0])
        self._lost.append((lost_since_s, sent_s))

    def heard_after(self, sent_s: float) -> bool:
        """Tell whether a message has come that was sent later than that."""
        return self._newest_s > sent_s + CLOCKS_S

    def may_come(self, sent_s: float, within_s: float) -> bool:
        """Tell whether one sent within some time of that was lost, or may come still."""
        return not self.heard_after(sent_s) or any(
            since_s <= sent_s + within_s and sent_s - within_s <= until_s
            for since_s, until_s in self._lost)

    def forget(self, before_s: float) -> None:
        """Forget what was lost before then."""
        while self._lost and self._lost[0][1] < before_s:
            self._lost.popleft()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Which messages of a topic did not come, by the numbers that every publisher gives to its own.

A topic may have several publishers, and the number does not say whose it is: a message follows the
one numbered one less, whoever sent that. That something is missing is known only when a later one
has come.
"""

from collections import deque

MOST = 8  # publishers of one topic that are told apart; the one heard last is kept longest
CLOCKS_S = 0.1  # error of times of sending: two clocks are read, at worst with a pause between


class Sequence:
    """Follows the messages of one topic."""

    def __init__(self) -> None:
        self._newest: list[tuple[int, float]] = []  # last of each publisher: number, when sent
        self._heard_s = -float('inf')

    def lost_since(self, number: int | None, sent_s: float) -> float | None:
        """
        Take the number of a message, and return since when messages before it are missing.

        Returns
        -------
        float or None
            Time when the last one before the missing was sent [s], by the clock of ``sent_s``.
            None when this one follows another, and where the middleware counts nothing.

        """
        if number is None:
            return None
        before = max((last for last in self._newest if last[0] < number), default=None)
        if before is not None:
            self._newest.remove(before)
            follows, since_s = before[0] == number - 1, before[1]
        else:  # what a publisher not heard before comes after, nobody knows
            follows, since_s = number == 1 and not self._newest, self._heard_s
        self._newest = [*self._newest, (number, sent_s)][-MOST:]
        self._heard_s = sent_s
        return None if follows else since_s


class Gaps:
    """Times about which messages of one topic did not come, or may come still."""

    def __init__(self) -> None:
        self._lost: deque[tuple[float, float]] = deque()  # from, to
        self._newest_s = -float('inf')

    def note(self, sent_s: float, lost_since_s: float | None) -> None:
        """Take when a message was sent, and what ``Sequence`` said of it."""
        self._newest_s = max(self._newest_s, sent_s)
        if lost_since_s is not None:
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

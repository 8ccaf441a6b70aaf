# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Which messages of a topic did not come, by the numbers that every publisher gives to its own.

A topic may have several publishers, and the number does not say whose it is: a message follows the
one numbered one less, whoever sent that.
"""

MOST = 8  # publishers of one topic that are told apart; the one heard last is kept longest


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

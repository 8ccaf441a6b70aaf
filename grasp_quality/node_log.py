# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the log says of refusals and of changes: all that is new once a second, and no flood.

rclpy throttles by the line of code that logs, where one refusal hides all others for a second.
Whoever was refused has the reason in the answer, so that the log may leave some out.
"""

from collections.abc import Callable
import time

PERIOD_S = 1.0
MOST = 10  # reasons a period


class Refusals:
    """Says each text once a period; ``say`` is a function of a logger, ``now_s`` a clock."""

    def __init__(self, say: Callable[[str], object],
                 now_s: Callable[[], float] = time.monotonic) -> None:
        self._say = say
        self._now_s = now_s
        self._since_s = -PERIOD_S
        self._said: set[str] = set()

    def tell(self, text: str) -> None:
        """Say it, unless it or too many others were said in this period."""
        now_s = self._now_s()
        if now_s - self._since_s >= PERIOD_S:
            self._since_s, self._said = now_s, set()
        if text not in self._said and len(self._said) < MOST:
            self._said.add(text)
            self._say(text)


class Changes:
    """
    Says a code and its words when it is not the one said last, and each code once a period.

    Contacts that are too old now and then would fill the log. What stands when the period ends is
    said then, so that the log is right about what lasts.

    """

    def __init__(self, say: Callable[[int, str], object]) -> None:
        self._say = say
        self._newest: tuple[int, str] | None = None
        self._told: int | None = None
        self._said: set[int] = set()

    def note(self, code: int, words: str) -> None:
        """Take what is so now."""
        self._newest = code, words
        if code not in self._said:
            self._tell()

    def end_period(self) -> None:
        """Begin a new period."""
        self._said.clear()
        self._tell()

    def forget(self) -> None:
        """Forget what was so: nothing is, until the next note."""
        self._newest = self._told = None
        self._said.clear()

    def _tell(self) -> None:
        if self._newest is not None and self._newest[0] != self._told:
            self._told = self._newest[0]
            self._said.add(self._told)
            self._say(*self._newest)

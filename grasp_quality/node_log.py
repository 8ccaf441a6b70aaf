# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Refusals in the log: each reason once a second, so that none hides another, and no flood.

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

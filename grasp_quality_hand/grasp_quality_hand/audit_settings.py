# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Which parameters of a node may have been in force when it sent something.

A node sends the event of a change before it goes by it: what it sent earlier has nothing to do
with the new value. An answer tells less: what it says may hold since the answer before it was
asked for, and what held before may have held until it came.
"""

from collections import deque

from grasp_quality_hand.audit_parts import Settings
from grasp_quality_hand.audit_sequence import CLOCKS_S

SOON_S = 2.0 * CLOCKS_S  # two times of sending are compared
REPLACED_S = 2.0  # for which parameters still count after they were replaced
MEMORY_S = 60.0   # after which those that were replaced are forgotten


class SettingsInForce:
    """Keeps parameters; ``known_s`` is since when any are known [s]."""

    def __init__(self) -> None:
        self.known_s = float('inf')
        # in force from, those before at the latest until, what
        self._kept: deque[tuple[float, float, Settings]] = deque()

    def note(self, settings: Settings, since_s: float, until_s: float) -> None:
        """Take parameters, since when they may be in force, and until when those before."""
        self.known_s = min(self.known_s, since_s)
        if not self._kept or self._kept[-1][2] != settings:
            self._kept.append((since_s, until_s, settings))

    def at(self, sent_s: float) -> list[Settings]:
        """Return those in force at a time, newest first; before all of them the first."""
        ends_s = [until_s for _, until_s, _ in self._kept][1:] + [float('inf')]
        sent_s = max(sent_s, self.known_s)
        return list({settings: None for (since_s, _, settings), end_s in zip(
            reversed(self._kept), reversed(ends_s))
            if since_s <= sent_s + SOON_S and sent_s - REPLACED_S <= end_s})

    def forget(self, now_s: float) -> None:
        """Forget what was replaced long ago."""
        while len(self._kept) > 1 and self._kept[1][1] < now_s - MEMORY_S:
            self._kept.popleft()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A curve over time in a fixed amount of memory: the least and the largest value of every bin.

When the bins are full, neighbours are joined and each holds twice as long a time, so that a bag of
any length ends with 1,000 to 2,000 bins, and no peak is lost.
"""

from __future__ import annotations

from dataclasses import dataclass, field

BINS = 2_000


@dataclass
class Trace:
    """
    Samples in the order of time.

    Attributes
    ----------
    bins : list of [first time, last time, least, largest, count]
        Times in ns since the epoch.

    """

    bins: list[list[float]] = field(default_factory=list)
    _share: int = 1  # samples a bin

    def add(self, time_ns: int, value: float) -> None:
        """Take one sample."""
        if self.bins and self.bins[-1][4] < self._share:
            last = self.bins[-1]
            last[1], last[4] = time_ns, last[4] + 1
            last[2], last[3] = min(last[2], value), max(last[3], value)
            return
        if len(self.bins) >= BINS:
            self._join()
        self.bins.append([time_ns, time_ns, value, value, 1])

    def _join(self) -> None:
        self.bins = [[a[0], b[1], min(a[2], b[2]), max(a[3], b[3]), a[4] + b[4]]
                     for a, b in zip(self.bins[::2], self.bins[1::2])]
        self._share *= 2

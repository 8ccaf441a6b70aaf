# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A channel that loses and delays what goes through it, as a busy network does."""

from collections import deque
from collections.abc import Callable

import numpy as np


class Channel:
    """Runs what is handed to it after a delay, or never."""

    def __init__(self, drop_rate: float, delay: float, seed: int) -> None:
        """
        Open the channel.

        Parameters
        ----------
        drop_rate : float
            Share of what is lost, in [0, 1].
        delay : float
            [s]
        seed : int
            Of the losses.

        """
        self._drop_rate, self.delay = drop_rate, delay
        self._rng = np.random.default_rng(seed)
        self._waiting: deque[tuple[float, Callable[[], None]]] = deque()

    def send(self, action: Callable[[], None], now: float) -> None:
        """Take an action at the time now [s]; it is run at once when there is no delay."""
        if self._drop_rate > 0.0 and self._rng.random() < self._drop_rate:
            return
        if self.delay <= 0.0:
            action()
        else:
            self._waiting.append((now + self.delay, action))

    def deliver(self, now: float) -> None:
        """Run everything whose delay is over at the time now [s]."""
        while self._waiting and self._waiting[0][0] <= now:
            self._waiting.popleft()[1]()

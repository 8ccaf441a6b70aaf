# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What is commanded from one instant to the next: slew limit, and the ramp to the holding efforts.

Nothing is commanded before there were good forces: a controller holds its last command, and a
node that starts again while a hand holds something must not let go. From then on there is always
a command, finite and within the limits, whatever comes in.
"""

from dataclasses import dataclass
import enum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
AVERAGING_S = 0.25  # over which the efforts of good forces are averaged, to hold with


class Phase(enum.Enum):
    """What the efforts come from."""

    WAITING = 'waiting for good forces; nothing is commanded'
    FOLLOWING = 'following the contact forces'
    RAMPING = 'ramping to the holding efforts'
    HOLDING = 'at the holding efforts'


@dataclass(frozen=True)
class Holding:
    """
    How to hold when there are no good forces.

    Attributes
    ----------
    ramp_time : float
        From the last efforts to the holding ones [s].
    efforts : (n,) array or None
        [N m, N]; None: those of the good forces before, averaged over ``AVERAGING_S``.
    stiffness, damping : float
        Of the posture at which the hold began [N m/rad, N m s/rad]. What both add changes by
        the slew limit at most, and so goes to nothing when joint states become stale.

    """

    ramp_time: float
    efforts: Array | None = None
    stiffness: float = 0.0
    damping: float = 0.0


class EffortCommand:
    """
    The efforts of a hand over time.

    Parameters
    ----------
    limits : (n,) array
        Effort limits > 0 [N m, N].
    max_rate : float
        Slew limit of every joint while following, and of what keeps the posture in a hold
        [N m/s, N/s].
    holding : Holding

    """

    def __init__(self, limits: Array, max_rate: float, holding: Holding) -> None:
        self._limits, self._max_rate, self._holding = limits, max_rate, holding
        self._efforts: Array | None = None
        self._average: Array | None = None
        self._ramp_from = np.zeros(len(limits))
        self._posture: Array | None = None
        self._feedback = np.zeros(len(limits))
        self._share = 0.0
        self.phase = Phase.WAITING

    def begin(self, measured: Array) -> None:
        """Begin at measured efforts (n,), so that the first command is no jump."""
        if self._efforts is None:
            self._efforts = self._within(measured, np.zeros(len(self._limits)))

    @property
    def begun(self) -> bool:
        """Whether something has been commanded."""
        return self.phase is not Phase.WAITING

    def follow(self, wanted: Array, period: float) -> Array:
        """
        Go towards the efforts of good forces.

        All joints go the same share of their way: between efforts in balance every one in a
        straight line is in balance.

        Parameters
        ----------
        wanted : (n,) array
            [N m, N]
        period : float
            Since the last call [s].

        Returns
        -------
        (n,) array, to be commanded

        """
        if self._efforts is None:
            self._efforts = np.zeros(len(self._limits))
        wanted = self._within(wanted, self._efforts)
        way = wanted - self._efforts
        longest = float(np.abs(way).max(initial=0.0))
        allowed = self._max_rate * max(period, 0.0)
        share = 1.0 if longest <= allowed else allowed / longest
        self._efforts = self._within(self._efforts + share * way, self._efforts)
        if self._average is None or not self.begun:
            self._average = self._efforts
        else:
            weight = 1.0 - float(np.exp(-max(period, 0.0) / AVERAGING_S))
            self._average = self._average + weight * (self._efforts - self._average)
        self.phase, self._posture = Phase.FOLLOWING, None
        self._feedback = np.zeros(len(self._limits))
        return self._efforts.copy()

    def hold(self, period: float, positions: Array | None = None,
             rates: Array | None = None) -> Array | None:
        """
        Go to the holding efforts, within the ramp time, and stay there.

        Parameters
        ----------
        period : float
            Since the last call [s].
        positions, rates : (n,) arrays, optional
            Of the joints [rad, rad/s], when they are fresh.

        Returns
        -------
        (n,) array to be commanded, or None when nothing ever was

        """
        if not self.begun or self._efforts is None or self._average is None:
            return None
        if self.phase is Phase.FOLLOWING:
            self.phase, self._ramp_from, self._share = Phase.RAMPING, self._efforts, 0.0
        if self._posture is None and positions is not None and np.isfinite(positions).all():
            self._posture = positions.copy()
        ramp = self._holding.ramp_time
        self._share = min(1.0, self._share + max(period, 0.0) / ramp) if ramp > 0.0 else 1.0
        if self._share == 1.0:
            self.phase = Phase.HOLDING
        goal = self._average if self._holding.efforts is None else self._holding.efforts
        keeping = goal
        with np.errstate(over='ignore', invalid='ignore'):  # _within judges what comes out
            if positions is not None and self._posture is not None:
                keeping = goal + self._holding.stiffness * (self._posture - positions)
                if rates is not None:
                    keeping = keeping - self._holding.damping * rates
        allowed = self._max_rate * max(period, 0.0)
        way = self._within(keeping, goal) - goal - self._feedback
        self._feedback = self._feedback + np.clip(way, -allowed, allowed)
        goal = self._within(goal + self._feedback, self._efforts)
        self._efforts = self._ramp_from + self._share * (goal - self._ramp_from)
        return self._efforts.copy()

    def _within(self, efforts: Array, otherwise: Array) -> Array:
        """Return efforts within the limits; where one is no number, the others are no use."""
        if not np.isfinite(efforts).all():
            return otherwise
        return np.clip(efforts, -self._limits, self._limits)

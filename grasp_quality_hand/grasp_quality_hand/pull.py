# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A pull on a held object: a wrench that grows from nothing until the object slips.

Then it goes back to nothing in RELEASE_TIME: a load that was gone at once would leave the object
to forces that nothing balances, until the hand has seen it.

"""

from dataclasses import dataclass

from grasp_quality_hand.slip import Pose, slip_distance
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RELEASE_TIME = 0.5           # [s]


@dataclass(frozen=True)
class PullResult:
    """
    How a pull ended.

    Attributes
    ----------
    held : float
        The largest factor on the wrench before the object slipped.
    slipped : bool
        False when the pull ended at its limit.
    slip : float
        Slip distance at the end [m].

    """

    held: float
    slipped: bool
    slip: float


class Pull:
    """The state of one pull."""

    def __init__(self, wrench: Array, growth: float, limit: float, slip_limit: float,
                 pose: Pose) -> None:
        """
        Begin without load.

        Parameters
        ----------
        wrench : ndarray, shape (6,)
            Acts on the object, times a growing factor; moves with it, object frame [N, N m].
        growth : float
            Of the factor [1/s].
        limit : float
            Factor at which the pull ends without slip.
        slip_limit : float
            |dp| + 20 mm |dtheta| that counts as slip [m].
        pose : Pose
            Of the object now.

        """
        self._wrench, self._growth, self._limit = wrench, growth, limit
        self._slip_limit, self._begin = slip_limit, pose
        self.factor = 0.0
        self.result: PullResult | None = None

    @property
    def load(self) -> Array:
        """Return what acts on the object now, shape (6,), object frame [N, N m]."""
        return self.factor * self._wrench

    def advance(self, duration: float, pose: Pose) -> None:
        """Let the load grow for a duration [s], or end the pull, by the object's pose now."""
        if self.result is not None:
            self.factor = max(0.0, self.factor - duration / RELEASE_TIME * self.result.held)
            return
        slip = slip_distance(self._begin.displacement_to(pose))
        if slip > self._slip_limit or self.factor >= self._limit:
            self.result = PullResult(self.factor, slip > self._slip_limit, slip)
        else:
            self.factor = min(self.factor + self._growth * duration, self._limit)

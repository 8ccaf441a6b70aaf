# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A load that grows so slowly that inertia hides nothing, until the object slips."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

from grasp_quality import Grasp
from grasp_quality_hand.slip import Pose, slip_distance
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
START = 0.8                  # share of alpha from which the load grows
LAST = 1.3                   # share of alpha at which a pull ends without slip
SAMPLES_APART = 5            # periods between two samples of the bound law


@dataclass(frozen=True)
class Pulled:
    """
    What a pull has shown.

    Attributes
    ----------
    alpha : float
        Predicted, from the contacts as they were felt under load.
    ratio : float
        Load at slip over predicted alpha.
    creep : float
        Slip distance when the load was 97 % of that at slip [m].
    bound : float
        The largest ratio of the bound law among all samples.
    samples : int
        Of the bound law.
    grasp : Grasp
        The contacts that the prediction is about.

    """

    alpha: float
    ratio: float
    creep: float
    bound: float
    samples: int
    grasp: Grasp

    @property
    def load(self) -> float:
        """Return the load at slip, as a factor on the task."""
        return self.ratio * self.alpha


class Rig(ABC):
    """A simulated hand that is commanded contact forces (k, 4) under a load (6,)."""

    grasp: Grasp             # the contacts as they were felt last
    period: float            # of the commands [s]
    ramp: float              # time to go to other forces; they settle as long [s]

    def __init__(self, grasp: Grasp) -> None:
        self.grasp = grasp
        self._forces, self._load = np.zeros((len(grasp), 4)), np.zeros(6)

    def go(self, forces: Array, load: Array) -> None:
        """Bring contact forces and load there in a straight line, and let them settle."""
        before, periods = (self._forces, self._load), round(self.ramp / self.period)
        for share in np.minimum(np.arange(1, 2 * periods + 1) / periods, 1.0):
            self.step(before[0] + share * (forces - before[0]),
                      before[1] + share * (load - before[1]))

    def step(self, forces: Array, load: Array) -> None:
        """Simulate one period; the load acts on the object, along its axes [N, N m]."""
        self._forces, self._load = forces, load
        self._simulate(forces, load)

    @abstractmethod
    def _simulate(self, forces: Array, load: Array) -> None:
        """Simulate one period."""

    @abstractmethod
    def pose(self) -> Pose:
        """Return the pose of the object."""

    @abstractmethod
    def feel(self) -> None:
        """Take the contacts to be where they are felt."""

    @abstractmethod
    def bound_ratio(self) -> float:
        """Return the ratio of the bound law now."""


def slow_pull(rig: Rig, forces_at: Callable[[float], Array], alpha: float, task: Array,
              growth: float, slip_limit: float) -> Pulled:
    """
    Let the load grow from START until the object slips.

    Parameters
    ----------
    rig : Rig
        Its grasp is what alpha was predicted for.
    forces_at : callable
        Contact forces (k, 4) for a load, as a share of alpha.
    alpha : float
        Predicted factor on the task.
    task : ndarray, shape (6,)
        What the fingers apply; the load is its opposite, object frame [N, N m].
    growth : float
        Of the load, in shares of alpha a second.
    slip_limit : float
        |dp| + 20 mm |dtheta| that counts as slip [m].

    """
    rig.go(forces_at(START), -START * alpha * task)
    before, share, way, bounds = rig.pose(), START, [(START, 0.0)], []
    while share < LAST:
        share += growth * rig.period
        rig.step(forces_at(share), -share * alpha * task)
        slip = slip_distance(before.displacement_to(rig.pose()))
        way.append((share, slip))
        if len(way) % SAMPLES_APART == 0 or slip > slip_limit:
            bounds.append(rig.bound_ratio())
        if slip > slip_limit:
            break
    shares, slips = np.array(way).T
    creep = float(np.interp(0.97 * share, shares, slips))
    return Pulled(alpha, share, creep, max(bounds), len(bounds), rig.grasp)

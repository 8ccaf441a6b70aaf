# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contact forces for every load up to the largest one.

The forces of the largest alpha lie on the edge of the friction cones, and a share of them is no
safer. Below alpha there is room for margin: between forces that hold no load, well inside the
cones, and those of the largest one, everything in a straight line is in the cones and under the
caps too, and balances its share of the load (cones and bounds are convex).

"""

from dataclasses import dataclass

from grasp_quality import evaluate, Grasp, TaskWrench
import numpy as np
from numpy.typing import ArrayLike, NDArray

MARGIN = 0.1                 # barrier weight of the forces inside the cones, as a share of alpha


class CannotHold(ValueError):
    """The grasp does not hold the object without the task; the message says how it is off."""


@dataclass(frozen=True)
class HoldingForces:
    """
    Contact forces from no task at all to the largest one.

    Attributes
    ----------
    alpha : float
        The largest factor on the task wrench.
    idle, largest : ndarray, shape (k, 4)
        [t1, t2, n, m_n] that apply none of the task, and alpha times it, contact frames [N, N m].

    """

    alpha: float
    idle: NDArray[np.float64]
    largest: NDArray[np.float64]

    def at(self, share: float) -> NDArray[np.float64]:
        """Return the forces for a share of alpha, shape (k, 4); no more than alpha is applied."""
        share = min(max(share, 0.0), 1.0)
        return (1.0 - share) * self.idle + share * self.largest


def holding_forces(grasp: Grasp, task_wrench: ArrayLike,
                   external_wrench: ArrayLike | None = None) -> HoldingForces:
    """
    Return the forces for a task in every size that the grasp can apply.

    Parameters
    ----------
    grasp : Grasp
        The contacts.
    task_wrench : array, shape (6,)
        Object frame [N, N m]: what the fingers are to apply, times up to alpha.
    external_wrench : array, shape (6,), optional
        What the world does to the object besides, object frame [N, N m].

    """
    wrench = np.asarray(task_wrench, dtype=np.float64)
    largest = evaluate(grasp, TaskWrench(wrench), external_wrench)
    if not largest.holdable:
        raise CannotHold(f'the grasp does not hold the object without the task '
                         f'({largest.status.name}): press harder or choose other contacts')
    reverse = evaluate(grasp, TaskWrench(-wrench), external_wrench)
    inner = [evaluate(grasp, TaskWrench(sign * wrench), external_wrench,
                      barrier_weight=MARGIN * bound.alpha)
             for sign, bound in ((1.0, largest), (-1.0, reverse))]
    both = inner[0].alpha + inner[1].alpha
    if both <= 0.0:
        raise CannotHold('the grasp can apply the task in neither direction')
    idle = (inner[1].alpha * inner[0].forces + inner[0].alpha * inner[1].forces) / both
    return HoldingForces(float(largest.alpha), idle, np.array(largest.forces))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the live loop remembers of its last forces: for a warm start, and for ``force_rate_limit``.

The limit holds between the forces published last and the next, in object axes, by the time between
them on the steady clock, failures in between included: what a hand did meanwhile is not known, and
the last forces are the best guess. Other contacts (other names) and a deactivation begin anew.
What is remembered is never published again: it is only where the way to forces that are proved for
the present contacts begins.
"""

import time

from grasp_quality.follow import follow
from grasp_quality.problem import build_problem
import numpy as np


class Follower:
    """Last forces and answer of the live loop."""

    def __init__(self):
        self.forget()

    def forget(self):
        """Begin anew: the next forces may be any."""
        self.start = None    # Solution with a reserve
        self._published = None  # Grasp, forces (k, 4) in its contact frames, time [s]

    def settle(self, grasp, task, load, solution, rate, limit):
        """
        Hold an answer back to what the hand can follow.

        Parameters
        ----------
        grasp : Grasp
            Present contacts.
        task : TaskWrench or TaskCone
            Of the answer.
        load : (6,) array [N, N m] or None
            External wrench, in the object frame.
        solution : Solution
            Answer for these contacts.
        rate : float [N/s]
            force_rate_limit; 0 lets everything pass.
        limit : TimeLimit
            Of the whole answer.

        Returns
        -------
        Solution, and whether it was held back

        """
        self.start = solution if solution.feasible and solution.center is not None else None
        if not solution.feasible:
            return solution, False
        if rate == 0.0 or self._published is None:
            return solution, False
        before, forces, then = self._published
        if before.names != grasp.names:
            return solution, False
        last = np.concatenate([np.einsum(
            'kji,kjl,kl->ki', grasp.rotations, before.rotations, forces[:, :3]),
            forces[:, 3:]], axis=1)
        followed = follow(
            build_problem(grasp, task, load), solution, last,
            rate * (time.monotonic() - then), limit)
        return followed.solution, followed.limited

    def published(self, grasp, forces):
        """Remember forces (k, 4) that were just published, in the contact frames of a grasp."""
        if len(forces):
            self._published = grasp, forces, time.monotonic()

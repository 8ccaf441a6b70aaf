# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A map of the forces around the unit ball, worked out a few directions at a time.

For those who have something more urgent to do in the same thread: each call of ``advance`` takes
about as long as it is given. All slices are of the one grasp and load given at the start.
"""

import time

from grasp_quality.directions import force_grid
from grasp_quality.grasp import Grasp
from grasp_quality.measures import wrench_map
import numpy as np
from numpy.typing import NDArray

FIRST_SLICE, LEAST_SLICE = 32, 4  # directions


class SlicedMap:
    """
    The map of ``wrench_map(grasp, force_grid(resolution), external_wrench)``, Fig. 3b.

    Parameters
    ----------
    grasp : Grasp
    resolution : int
        r of ``force_grid``: 2 r^2 directions.
    external_wrench : (6,) array [N, N m] or None
        What the world applies on the object, about the object frame's origin.
    slice_size : int
        Directions of the first slice; ``slice_size`` of an earlier map, adapted to the machine.

    """

    def __init__(self, grasp: Grasp, resolution: int,
                 external_wrench: NDArray[np.float64] | None = None,
                 slice_size: int = FIRST_SLICE) -> None:
        self.resolution = resolution
        self.slice_size = slice_size
        self._grasp, self._load = grasp, external_wrench
        self._directions = force_grid(resolution)  # (2 r^2, 6)
        self._alphas = np.zeros(len(self._directions))
        self._done = 0

    def advance(self, budget_s: float, time_limit_s: float | None = None) -> bool:
        """
        Work out the next slice.

        Parameters
        ----------
        budget_s : float
            Time that a slice should take [s]; the next one is larger or smaller accordingly.
        time_limit_s : float, optional
            Time that this slice may take [s].

        Returns
        -------
        bool
            Whether the map is complete.

        Raises
        ------
        SolverError, SolverTimeoutError

        """
        rows = slice(self._done, self._done + self.slice_size)
        started = time.perf_counter()
        self._alphas[rows] = wrench_map(
            self._grasp, self._directions[rows], self._load, time_limit_s=time_limit_s).alpha
        faster = budget_s / max(time.perf_counter() - started, 1e-6)
        # at most twice as many at once: one quick slice tells little of the next
        wanted = int(self.slice_size * min(faster, 2.0))
        self._done = min(rows.stop, len(self._directions))
        self.slice_size = min(max(wanted, LEAST_SLICE), len(self._directions))
        return self.complete

    @property
    def complete(self) -> bool:
        """Whether all directions are worked out."""
        return self._done == len(self._directions)

    @property
    def alphas(self) -> NDArray[np.float64]:
        """Largest forces (2 r^2,) [N]; those of directions still to come are 0."""
        return self._alphas.copy()

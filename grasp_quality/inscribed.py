# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The largest factor by which an ellipsoid E fits into W: least sigma_W over the support of E.

Both support functions are closed forms. Local searches bring the ratio down, each step of which is
a task wrench problem: the point where E would touch W is the task, its multiplier the next
direction. ``ball_search`` then proves that no direction is lower, in coordinates that make W round
and the ellipsoid's axes orthogonal, so that neither the unit of torque nor the size of the object
matters. Everything is in the scaled wrenches of ``Grasp.scaled_matrix``.
"""

from typing import cast

from grasp_quality import ball_search, bounds, friction_cone
from grasp_quality.exceptions import SolverError
from grasp_quality.grasp import Grasp
from grasp_quality.problem import build_problem
from grasp_quality.proof import Proof
from grasp_quality.solution import Solution
from grasp_quality.solve import solve
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray

SAMPLES = 1000        # directions that the search for the weakest one begins with
DESCENTS = 3          # local searches, from the best of these
STEPS = 12            # of one local search, at most
FIRST_CELLS = 1024    # room for so many at first; doubled when full
MOST_CELLS = 400_000  # some 100 MB and a few seconds
POPS = 50             # cells between two looks at the clock
ROUNDING = 1e-12      # relative; the interval is widened by it
EPSILON = 8.0 * np.finfo(float).eps  # of products and sums of six
SETTLED = 1e-10       # relative change of the ratio that ends a local search
ZERO = 1e3            # times what rounding can do: a ratio below that cannot be told from zero
ONES = np.ones(4)     # cone scales of scaled coordinates
FLAT = 1e-9           # share of an axis that may stand out of the wrenches that G spans

Array = NDArray[np.float64]
Arrays = tuple[Array, Array, NDArray[np.int64], NDArray[np.int64]]  # G, D^2, groups, best


class Inscribed:
    """
    One search, done when it is made.

    Parameters
    ----------
    grasp : Grasp
    axes : (n, 6) array [N, N m]
        Semi-axes of the ellipsoid, about the object frame's origin.
    width : float
        Relative width of the interval that is asked for.
    limit : TimeLimit or None
        Ends the search early.

    Attributes
    ----------
    lower, upper : float
    multiplier : (6,) array
        Scaled lambda with sigma_W(lambda) = upper and support one on the ellipsoid.
    weakest : Solution or None
        Of the task wrench where the ellipsoid's support by the multiplier is.
    reached : bool
        Whether the interval is as narrow as asked.
    cells : int
        Cells looked at.

    """

    def __init__(self, grasp: Grasp, axes: Array, width: float,
                 limit: TimeLimit | None) -> None:
        self.grasp, self.axes, self.width, self.limit = grasp, axes, width, limit
        self.scaled_axes = grasp.scaled_wrench(axes)  # (n, 6)
        self.lower, self.upper, self.cells, self.reached = 0.0, np.inf, 0, True
        self.multiplier: Array = np.zeros(6)
        self._magnitudes = np.abs(grasp.scaled_matrix.reshape(6, -1))
        self.weakest: Solution | None = None
        if not self._flat():
            self._run()

    @property
    def touching(self) -> Array:
        """Point of the ellipsoid where its support by the multiplier is, (6,) [N, N m]."""
        return (self.scaled_axes @ self.multiplier) @ self.axes

    def ratio(self, multiplier: Array) -> float:
        """Evaluate sigma_W(lambda) over the ellipsoid's support, of a scaled lambda (6,)."""
        size = np.linalg.norm(self.scaled_axes @ multiplier)
        local = (multiplier @ self.grasp.scaled_matrix.reshape(6, -1)).reshape(-1, 4)
        sigma = bounds.support(
            friction_cone.support(local, ONES), self.grasp.bound, self.grasp.groups)
        sigma += EPSILON * float((np.abs(multiplier) @ self._magnitudes).sum()) * (sigma > 0.0)
        return sigma / size if size > 0.0 else np.inf

    def _flat(self) -> bool:
        """Whether forces of no size would do: an axis stands out of the wrenches that G spans."""
        span = self.grasp.span
        outside = self.scaled_axes - self.scaled_axes @ span @ span.T
        shares = np.linalg.norm(outside, axis=1) / np.linalg.norm(self.scaled_axes, axis=1)
        if shares.max() <= FLAT:
            return False
        out = outside[shares.argmax()]
        self.upper, self.multiplier = 0.0, out / np.linalg.norm(self.scaled_axes @ out)
        return True

    def _run(self) -> None:
        """Search from above, then prove from below."""
        turn, G, D = self._rounded()
        groups = np.array(self.grasp.groups)
        best = np.empty(0 if self.grasp.bound == 'l2' else groups.max() + 1, dtype=np.int64)
        problem = G, D ** 2, groups, best
        directions = np.random.default_rng(0).normal(size=(SAMPLES, len(D)))
        directions = np.vstack([directions, np.eye(len(D)), -np.eye(len(D))])
        directions = directions[(directions * D).any(axis=1)]
        found = np.empty(len(directions))
        ball_search.ratios(*problem, directions, found)
        for i in np.argsort(found)[:DESCENTS]:
            self._descend(turn @ directions[i])
        # how far rounding in G and in D can move p . v and upper |D v| of any v of the cube
        noise = EPSILON * float((self._magnitudes.T @ np.abs(turn)).sum() + self.upper * (
            np.abs(self.scaled_axes) @ np.abs(turn)).sum())
        nothing = ZERO * noise / D.max()
        if self.upper > nothing:
            self._prove(problem, turn, noise)
        self.upper *= 1.0 + ROUNDING
        self.lower = max(0.0, min(self.lower * (1.0 - ROUNDING), self.upper))
        narrow = self.upper - self.lower <= (self.width + 3.0 * ROUNDING) * self.upper
        self.reached = bool(narrow or self.upper <= nothing)

    def _rounded(self) -> tuple[Array, Array, Array]:
        """
        Coordinates v of lambda in which W is about round and the ellipsoid's axes orthogonal.

        Returns
        -------
        (6, d) array with lambda = turn v; (k, 4, d) array G, rows n, t1, t2, m_n; (d,) array D
        with |D v| the ellipsoid's support. d is the rank of the grasp matrix.

        """
        span, k = self.grasp.span, len(self.grasp)
        flat = span.T @ self.grasp.scaled_matrix.reshape(6, -1)  # (d, 4 k)
        U, s, _ = np.linalg.svd(flat, full_matrices=False)
        turn = span @ (U / s)
        _, D, V = np.linalg.svd(self.scaled_axes @ turn)
        turn = turn @ V.T
        D = np.concatenate([D, np.zeros(turn.shape[1] - len(D))])[:turn.shape[1]]
        G = (self.grasp.scaled_matrix.reshape(6, -1).T @ turn).reshape(k, 4, -1)
        return turn, np.ascontiguousarray(G[:, (2, 0, 1, 3)]), D

    def _descend(self, multiplier: Array) -> None:
        """Walk down from a direction; keep the lowest ratio met."""
        at = np.inf
        for _ in range(STEPS):
            value = self.ratio(multiplier)
            if not value < at * (1.0 - SETTLED):
                return
            multiplier = multiplier / np.linalg.norm(self.scaled_axes @ multiplier)
            at, lowest = value, value < self.upper
            if lowest:
                self.upper, self.multiplier, self.weakest = value, multiplier, None
            task = TaskWrench((self.scaled_axes @ multiplier) @ self.axes)
            try:
                solution = solve(build_problem(self.grasp, task), self.limit)
            except SolverError:  # or out of time: what was met holds all the same
                return
            multiplier = cast(Proof, solution.proof).multiplier  # feasible: there is no load
            if lowest:
                self.weakest = solution

    def _prove(self, problem: Arrays, turn: Array, noise: float) -> None:
        """Cover all directions by cells and halve the worst ones until the width is reached."""
        d = turn.shape[1]
        faces = np.zeros((2 * d, 3, d))
        for f in range(2 * d):
            faces[f, ball_search.CENTRE, f // 2] = 2.0 * (f % 2) - 1.0
            faces[f, ball_search.HALF] = np.arange(d) != f // 2
        D2 = problem[1]
        size = np.sqrt(D2.max())
        problem = problem[0], D2 / D2.max(), *problem[2:]
        cells, keys = np.zeros((FIRST_CELLS, 3, d)), np.zeros(FIRST_CELLS)
        axes, heap = np.zeros((2, FIRST_CELLS), dtype=np.int64)
        cells[:2 * d], heap[:2 * d] = faces, np.arange(2 * d)
        axes[:2 * d] = np.argmax(D2 * faces[:, ball_search.HALF], axis=1)
        counters, direction = np.array([2 * d, 2 * d, 0]), np.zeros(d)
        values = np.array([self.upper * size, np.inf])
        while True:
            met = values[ball_search.UPPER]
            ball_search.search(*problem, cells, keys, axes, heap, counters, values, direction,
                               self.width, noise, POPS)
            if values[ball_search.UPPER] < met:
                self._descend(turn @ direction)
                values[ball_search.UPPER] = min(values[ball_search.UPPER], self.upper * size)
            waiting = keys[heap[0]] if counters[ball_search.WAITING] else np.inf
            lower = min(waiting, values[ball_search.PROVED])
            if lower >= (1.0 - self.width) * values[ball_search.UPPER] * (1.0 - ROUNDING) \
                    or len(cells) >= MOST_CELLS or self._out_of_time():
                break
            if counters[ball_search.MADE] == len(cells):
                cells, keys = np.concatenate([cells, cells]), np.concatenate([keys, keys])
                axes, heap = np.concatenate([axes, axes]), np.concatenate([heap, heap])
        self.lower, self.cells = float(lower / size), int(counters[ball_search.BOUNDED])

    def _out_of_time(self) -> bool:
        return self.limit is not None and self.limit.is_over

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A weighted centre of a conic program, by a primal-dual interior-point method.

    minimise -c . u - sum_b w_b log det u_b   subject to   E u = e

Every cone has a weight of its own: the barrier weight of eq. (11) on the contacts, next to nothing
on the rest. The method is the common one with Nesterov-Todd scaling (of CVXOPT, ECOS, Clarabel):
it follows complementarity u o z down to the weights instead of to zero, one Cholesky factor of
rows x rows a step. Clarabel states the same with exponential cones, but an objective that is
proved to 1e-9 fixes a smooth optimum only to the square root of that (docs/decisions.md).
"""

from collections.abc import Callable

from grasp_quality.arrays import Array
from grasp_quality.cone_algebra import (
    determinant, divide, is_interior, largest_step, product, Scaling)
import numpy as np
from scipy.linalg import cho_factor, cho_solve, LinAlgError

MAX_ITERATIONS = 80
STEP_SHARE = 0.95    # of the way to the edge of the cones
SHORT_STEP = 0.3     # below it the iterate is too far off the middle for a cut
DECREASE = (0.7, 0.1, 1e-4)  # of the mean distance: after a short step, a cut one, a full one
TOLERANCE = 1e-12    # residuals, and distance from the weights relative to the largest
ACCEPTED = 1e-8      # of the same, when rounding stops the iteration short of it
RANK_TOLERANCE = 1e-9


@np.errstate(over='ignore', invalid='ignore', divide='ignore')  # where there is no centre
def weighted_center(E: Array, e: Array, c: Array, weights: Array,
                    start: tuple[Array, Array] | None = None,
                    on_step: Callable[[], object] | None = None) -> tuple[Array, Array] | None:
    """
    Find the weighted centre.

    Parameters
    ----------
    E : (rows, blocks, d) array
        Equations, with zero columns where a block is padded.
    e : (rows,) array
        Right side of the equations E u = e.
    c : (blocks, d) array
        Objective, maximised: c . u + sum_i w_i log det u_i.
    weights : (blocks,) array
        w > 0 of each cone, for log det; half of what a half line's own logarithm would have.
    start : (u, x), optional
        Centre of a problem close by with the same weights, to begin from.
    on_step : callable, optional
        Called before every step; what it raises ends the search.

    Returns
    -------
    (u, x) : (blocks, d) and (rows,) arrays, or None when the iteration does not converge, as when
        there is no strictly interior point.

    """
    blocks, d = E.shape[1:]
    flat = E.reshape(len(e), -1)
    range_of_E, singular, E_flat = np.linalg.svd(flat, full_matrices=False)
    E_flat[:, ~flat.any(axis=0)] = 0.0  # rounding in what is padded would grow from step to step
    kept = singular > RANK_TOLERANCE * singular[0]
    range_of_E, E_flat = range_of_E[:, kept], E_flat[kept]
    e = (range_of_E.T @ e) / singular[kept]
    rows = len(e)
    Et = E_flat.T.reshape(blocks, d, rows)
    if start is None:
        u = np.zeros((blocks, d))
        u[:, 0] = 0.5
        z = np.zeros((blocks, d))
        z[:, 0] = 1.0
        x = np.zeros(rows)
    else:
        u, x = start[0], singular[kept] * (range_of_E.T @ start[1])
        z = (2.0 * weights / determinant(u))[:, None] * u
        z[:, 1:] *= -1.0
    best, best_distance, step = None, np.inf, 0.0
    for _ in range(MAX_ITERATIONS):
        if on_step is not None:
            on_step()
        primal = e - E_flat @ u.ravel()
        dual = (E_flat.T @ x).reshape(blocks, d) - c - z
        excess = np.abs((u * z).sum(axis=1) / 2.0 - weights).mean()
        W = Scaling.of(u, z)
        scaled = W.apply(z)
        complementarity = product(scaled, scaled)
        target = np.zeros((blocks, d))
        target[:, 0] = 2.0 * (weights + DECREASE[(step > SHORT_STEP) + (step == 1.0)] * excess)
        finish = np.zeros((blocks, d))
        finish[:, 0] = 2.0 * weights
        distance = max(
            np.abs(primal).max(), np.abs(dual).max() / (1.0 + np.abs(x).max()),
            np.abs(complementarity - finish).max() / max(1.0, weights.max()))
        if distance < best_distance:
            best, best_distance = (u, x), distance
        elif best_distance <= ACCEPTED:
            break
        if distance <= TOLERANCE:
            break
        q = divide(scaled, target - complementarity)
        W2Et = W.squared(Et)  # (blocks, d, rows)
        free = W.apply(q) - W.squared(dual[:, :, None])[:, :, 0]
        try:
            factor = cho_factor(E_flat @ W2Et.reshape(-1, rows))
            dx = cho_solve(factor, E_flat @ free.ravel() - primal)
        except (LinAlgError, ValueError):
            break
        du = free - W2Et @ dx
        dz = dual + (E_flat.T @ dx).reshape(blocks, d)
        step = min(1.0, STEP_SHARE * min(largest_step(u, du), largest_step(z, dz)))
        u, x, z = u + step * du, x + step * dx, z + step * dz
        if not (is_interior(u) and is_interior(z)):
            break
    if best is None or best_distance > ACCEPTED:
        return None
    u, x = best
    return u, range_of_E @ (x / singular[kept])

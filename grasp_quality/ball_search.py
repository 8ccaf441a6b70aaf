# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The compiled search behind ``ball``: least sigma_W(v) / |D v| over all v, with a proof.

Directions v fill the faces of a cube; a cell is a box in such a face. On a cell |D v| is at most a
linear function l, so that any single point p of W with (p - rho l) . v >= 0 all over the cell
proves sigma_W(v) >= rho |D v| there. The best such p is a linear program whose columns, the points
of W, come from the support function (simplex method with column generation). Cells that it cannot
prove are halved, the worst first. docs/derivations.md, "The largest ball". This file calls into no
other compiled one: numba's cache would not notice that one's changes.
"""

import math

from grasp_quality.arrays import Array, Bools, Ints
import numba
import numpy as np

# no fastmath that would let the compiler assume away nan
COMPILE = {'cache': True, 'error_model': 'numpy', 'nogil': True,
           'fastmath': {'contract', 'reassoc', 'nsz'}}

COLUMNS = 60         # of W that one cell may ask for
OUTSIDE = 1e-9       # of the cube's half edge, by which a direction counts as outside its cell
SMALLEST_PIVOT = 1e-11
PERTURBATION = 1e-7  # of rho: no two slacks are zero at once, so that the simplex never cycles
SHARPNESS = 1e-6     # of rho, in the value of a cell's program

CENTRE, HALF, POINT = range(3)       # rows of a cell
WAITING, MADE, BOUNDED = range(3)    # counters: cells in the heap, in the arrays, looked at
UPPER, PROVED = range(2)             # values: least ratio met, least rho of a finished cell
# inverse, cost, is_point, points, column, v, new of the simplex method
Work = tuple[Array, Array, Bools, Array, Array, Array, Array]
PROVEN, OPEN, HOPELESS = 1, 0, -1


@numba.njit(**COMPILE)
def dot(a: Array, b: Array) -> float:
    """Sum of products, without a copy."""
    total = 0.0
    for j in range(len(a)):
        total += a[j] * b[j]
    return total


@numba.njit(**COMPILE)
def square(D2: Array, v: Array) -> float:
    """|D v|^2."""
    total = 0.0
    for j in range(len(v)):
        total += D2[j] * v[j] * v[j]
    return total


@numba.njit(**COMPILE)
def local(block: Array, v: Array) -> tuple[float, float, float, float]:
    """Worth h_n, h_t1, h_t2, h_m of one contact's coordinates along v."""
    n = a = b = c = 0.0
    for j in range(len(v)):
        n += block[0, j] * v[j]
        a += block[1, j] * v[j]
        b += block[2, j] * v[j]
        c += block[3, j] * v[j]
    return n, a, b, c


@numba.njit(**COMPILE)
def support(G: Array, groups: Ints, best: Ints, worth: Array, v: Array, p: Array) -> float:
    """Return sigma_W(v), with the point p of W that attains it; ``best`` is empty for l2."""
    total = 0.0
    best[:] = -1
    for i in range(len(G)):
        n, a, b, c = local(G[i], v)
        worth[i] = n + math.sqrt(a * a + b * b + c * c)
        if worth[i] > 0.0:
            total += worth[i] * worth[i]
            if len(best) and (best[groups[i]] < 0 or worth[i] > worth[best[groups[i]]]):
                best[groups[i]] = i
    norm, total = math.sqrt(total), 0.0
    p[:] = 0.0
    for i in range(len(G)):
        if worth[i] <= 0.0 or (len(best) and best[groups[i]] != i):
            continue
        share = 1.0 if len(best) else worth[i] / norm
        total += share * worth[i]
        n, a, b, c = local(G[i], v)
        length = math.sqrt(a * a + b * b + c * c)
        side = share / length if length > 0.0 else 0.0
        for j in range(len(p)):
            p[j] += share * G[i, 0, j] + side * (a * G[i, 1, j] + b * G[i, 2, j] + c * G[i, 3, j])
    return total


@numba.njit(**COMPILE)
def ratios(G: Array, D2: Array, groups: Ints, best: Ints, directions: Array, out: Array) -> None:
    """Evaluate sigma_W(v) / |D v| of many directions (N, d)."""
    worth, p = np.empty(len(G)), np.empty(G.shape[2])
    for i in range(len(directions)):
        out[i] = support(G, groups, best, worth, directions[i], p) / math.sqrt(
            square(D2, directions[i]))


@numba.njit(**COMPILE)
def least(p: Array, slope: Array, cell: Array) -> float:
    """Least (p - slope) . v over a cell."""
    total = 0.0
    for j in range(len(p)):
        g = p[j] - slope[j]
        total += g * cell[CENTRE, j] - abs(g) * cell[HALF, j]
    return total


@numba.njit(**COMPILE)
def begin(slope: Array, rho: float, cell: Array, inverse: Array, cost: Array, is_point: Bools,
          points: Array) -> None:
    """Start the simplex method at the cell's point, one slack a coordinate."""
    d = len(slope)
    inverse[:] = 0.0
    is_point[:] = False
    for j in range(d):
        g = cell[POINT, j] - slope[j]
        sign = 1.0 if g >= 0.0 else -1.0
        inverse[j, j] = -sign
        inverse[j, d] = abs(g) + PERTURBATION * rho * (1.0 + 0.3 * j)
        cost[j] = sign * cell[CENTRE, j] - cell[HALF, j]
    inverse[d, d], cost[d], is_point[d], points[d] = 1.0, 0.0, True, cell[POINT]


@numba.njit(**COMPILE)
def pivot(inverse: Array, column: Array) -> int:
    """Bring a column into the basis; return the row that it takes, -1 when there is none."""
    leave, step, d = -1, np.inf, inverse.shape[1] - 1
    for r in range(len(column)):
        if column[r] > SMALLEST_PIVOT and inverse[r, d] < step * column[r]:
            step, leave = inverse[r, d] / column[r], r
    if leave >= 0:
        for j in range(d + 1):
            inverse[leave, j] /= column[leave]
        for r in range(d + 1):
            for j in range(d + 1 if r != leave else 0):
                inverse[r, j] -= column[r] * inverse[leave, j]
    return leave


@numba.njit(**COMPILE)
def prove(G: Array, D2: Array, groups: Ints, best: Ints, worth: Array, slope: Array, rho: float,
          need: float, cell: Array, values: Array, direction: Array, work: Work) -> int:
    """
    Look for a point of W that proves the cell, and leave the best one in it.

    The dual of the program is the direction v of least sigma_W(v) - slope . v over the cell: where
    that is below ``need`` no point will do. Directions met on the way improve the upper bound.

    """
    inverse, cost, is_point, points, column, v, new = work
    d, outcome = len(v), OPEN
    if least(cell[POINT], slope, cell) >= need:
        return PROVEN
    begin(slope, rho, cell, inverse, cost, is_point, points)
    for _ in range(COLUMNS):
        for _ in range(4 * d):  # slacks first: they bring v back into the cell
            v[:] = 0.0
            for r in range(d + 1):
                for j in range(d):
                    v[j] -= cost[r] * inverse[r, j]
            out, enter, sign = OUTSIDE, -1, 0.0
            for j in range(d):
                beyond = abs(v[j] - cell[CENTRE, j]) - cell[HALF, j]
                if beyond > out:
                    out, enter, sign = beyond, j, 1.0 if v[j] > cell[CENTRE, j] else -1.0
            if enter < 0:
                break
            for r in range(d + 1):
                column[r] = sign * inverse[r, enter]
            row = pivot(inverse, column)
            if row < 0:
                return OPEN
            cost[row] = -sign * cell[CENTRE, enter] - cell[HALF, enter]
            is_point[row] = False
        low = dot(cost, inverse[:, d])
        if low >= need + SHARPNESS * rho:
            break
        sigma = support(G, groups, best, worth, v, new)
        norm = math.sqrt(square(D2, v))
        if sigma < values[UPPER] * norm:
            values[UPPER] = sigma / norm
            direction[:] = v
        high = sigma - dot(slope, v)
        if high < need:
            outcome = HOPELESS
            break
        if high - low <= SHARPNESS * rho:
            break
        for r in range(d + 1):
            column[r] = inverse[r, d]
            for j in range(d):
                column[r] += inverse[r, j] * (new[j] - slope[j])
        row = pivot(inverse, column)
        if row < 0:
            break
        cost[row], is_point[row], points[row] = 0.0, True, new
    new[:] = 0.0
    total = 0.0
    for r in range(d + 1):
        if is_point[r] and inverse[r, d] > 0.0:
            total += inverse[r, d]
            for j in range(d):
                new[j] += inverse[r, d] * points[r, j]
    if total > 0.0:  # a mean of points of W, whatever rounding did to the weights
        new /= total
        if least(new, slope, cell) > least(cell[POINT], slope, cell):
            cell[POINT] = new
    return PROVEN if least(cell[POINT], slope, cell) >= need else outcome


@numba.njit(**COMPILE)
def bound_of(D2: Array, cell: Array, m: float, sag: float, slack: float, rho: float) -> float:
    """Return the largest rho that the cell's point proves (Dinkelbach's iteration)."""
    for _ in range(30):
        over, under = -slack, sag
        for j in range(len(D2)):
            g = cell[POINT, j] * m - rho * D2[j] * cell[CENTRE, j]
            v = cell[CENTRE, j] - math.copysign(cell[HALF, j], g)
            over += cell[POINT, j] * v
            under += D2[j] * cell[CENTRE, j] * v
        smaller = over * m / under if under > 0.0 else 0.0
        if smaller >= rho * (1.0 - 1e-12):
            return smaller
        if smaller <= 0.0:
            return 0.0
        rho = smaller
    return 0.0


@numba.njit(**COMPILE)
def push(heap: Ints, size: int, keys: Array, cell: int) -> None:
    """Put a cell into the heap of the given size."""
    at = size
    while at > 0 and keys[heap[(at - 1) // 2]] > keys[cell]:
        heap[at] = heap[(at - 1) // 2]
        at = (at - 1) // 2
    heap[at] = cell


@numba.njit(**COMPILE)
def pop(heap: Ints, size: int, keys: Array) -> int:
    """Take the cell of least key out of the heap of the given size."""
    first: int = heap[0]
    last, at, child = heap[size - 1], 0, 1
    while child < size - 1:
        if child + 1 < size - 1 and keys[heap[child + 1]] < keys[heap[child]]:
            child += 1
        if keys[heap[child]] >= keys[last]:
            break
        heap[at] = heap[child]
        at, child = child, 2 * child + 1
    heap[at] = last
    return first


@numba.njit(**COMPILE)
def search(G: Array, D2: Array, groups: Ints, best: Ints, cells: Array, keys: Array, axes: Ints,
           heap: Ints, counters: Ints, values: Array, direction: Array, width: float, slack: float,
           pops: int) -> None:
    """
    Halve the worst cells, ``pops`` of them, or until all are proved or the arrays are full.

    ``slack`` is how far rounding can have moved p . v - rho |D v| for any direction of the cube.

    """
    k, _, d = G.shape
    worth, slope = np.empty(k), np.empty(d)
    work = (np.empty((d + 1, d + 1)), np.empty(d + 1), np.empty(d + 1, np.bool_),
            np.empty((d + 1, d)), np.empty(d + 1), np.empty(d), np.empty(d))
    for _ in range(pops):
        if (counters[WAITING] == 0 or counters[MADE] == len(cells)
                or keys[heap[0]] >= (1.0 - width) * values[UPPER]):
            return
        old, new = pop(heap, counters[WAITING], keys), counters[MADE]
        counters[WAITING] -= 1
        counters[MADE] += 1
        axis, cells[new], keys[new] = axes[old], cells[old], keys[old]
        cells[old, HALF, axis] *= 0.5
        cells[new, HALF, axis] *= 0.5
        cells[old, CENTRE, axis] -= cells[old, HALF, axis]
        cells[new, CENTRE, axis] += cells[new, HALF, axis]
        for i in (old, new):
            cell, rho = cells[i], (1.0 - width) * values[UPPER]
            sag = square(D2, cell[HALF])
            m = math.sqrt(square(D2, cell[CENTRE]) + sag)
            factor = rho / m if m > 0.0 else 0.0
            for j in range(d):
                slope[j] = factor * D2[j] * cell[CENTRE, j]
            need = factor * sag + slack
            counters[BOUNDED] += 1
            outcome = prove(G, D2, groups, best, worth, slope, rho, need, cell, values, direction,
                            work)
            if outcome == PROVEN:
                values[PROVED] = min(values[PROVED], rho)
                continue
            if m > 0.0:
                keys[i] = max(keys[i], bound_of(D2, cell, m, sag, slack, rho))
            # |D v| bends by the coordinates that D weighs; an open program needs a smaller box
            weight = D2 if outcome == HOPELESS else np.ones(d)
            axes[i] = np.argmax(weight * cell[HALF] ** 2)
            push(heap, counters[WAITING], keys, i)
            counters[WAITING] += 1

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
One task wrench, one grasp, compiled: a primal-dual interior-point method for this structure.

The program is that of ``problem`` (scaled, standard form) for bounds that partition the contacts
into groups. Every contact is one second-order cone of four coordinates [n, t1, t2, m_n], padded
with zeros where the model carries less; group slacks and alpha are half lines. The method is the
common one, with Nesterov-Todd scaling and Mehrotra's corrector (CVXOPT, ECOS, Clarabel). The Schur
complement has six rows for equilibrium and one a group; the latter are diagonal and eliminated, so
that the cost is linear in the contacts.

Weights turn the optimum into the weighted centre of eq. (11): see ``centering``. All compiled code
stands in this one file, however long: numba's cache notices a change of the file that a function
stands in, but not of the files that it calls into, and stale machine code moves motors.
"""

import math

import numba
import numpy as np

# no fastmath that would let the compiler assume away nan
COMPILE = {'cache': True, 'error_model': 'numpy', 'fastmath': {'contract', 'reassoc', 'nsz'}}

STEP_SHARE = 0.99   # of the way to the edge of the cones
REGULARISATION = 1e-15  # of the Schur complement's trace: grasps may be rank-deficient

RELATIVE_GAP = 1e-9     # of max(alpha, 1e-2 a0), aimed at
WEIGHTED_GAP = 1e-12    # of the same, or of the largest weight: a smooth optimum is that sharp
RESIDUAL = 1e-9         # of equilibrium and bound, in shares of the caps, accepted
MAX_ITERATIONS = 40

SOLVED, STALLED = 1, 0


@numba.njit(**COMPILE)
def scaling(u0, u1, u2, u3, z0, z1, z2, z3):
    """Nesterov-Todd point (4,) of determinant one and squared size eta^2 of one cone."""
    norm_u = math.sqrt(u1 * u1 + u2 * u2 + u3 * u3)
    norm_z = math.sqrt(z1 * z1 + z2 * z2 + z3 * z3)
    det_u = (u0 - norm_u) * (u0 + norm_u)
    det_z = (z0 - norm_z) * (z0 + norm_z)
    ru = 1.0 / math.sqrt(det_u)
    rz = 1.0 / math.sqrt(det_z)
    dot = (u0 * z0 + u1 * z1 + u2 * z2 + u3 * z3) * ru * rz
    half = 0.5 / math.sqrt(0.5 * (1.0 + dot))
    return ((u0 * ru + z0 * rz) * half, (u1 * ru - z1 * rz) * half, (u2 * ru - z2 * rz) * half,
            (u3 * ru - z3 * rz) * half, math.sqrt(det_u / det_z))


@numba.njit(**COMPILE)
def apply(w0, w1, w2, w3, v0, v1, v2, v3):
    """W v / eta of one cone; with w1, w2, w3 negated it is eta W^-1 v."""
    along = w1 * v1 + w2 * v2 + w3 * v3
    t = v0 + along / (1.0 + w0)
    return w0 * v0 + along, v1 + t * w1, v2 + t * w2, v3 + t * w3


@numba.njit(**COMPILE)
def squared(w0, w1, w2, w3, size, v0, v1, v2, v3):
    """W^2 v of one cone."""
    dot = 2.0 * (w0 * v0 + w1 * v1 + w2 * v2 + w3 * v3)
    return (size * (dot * w0 - v0), size * (dot * w1 + v1), size * (dot * w2 + v2),
            size * (dot * w3 + v3))


@numba.njit(**COMPILE)
def divide(l0, l1, l2, l3, r0, r1, r2, r3):
    """Solve l o y = r in the Jordan algebra of one cone."""
    norm = math.sqrt(l1 * l1 + l2 * l2 + l3 * l3)
    y0 = (l0 * r0 - l1 * r1 - l2 * r2 - l3 * r3) / ((l0 - norm) * (l0 + norm))
    return y0, (r1 - y0 * l1) / l0, (r2 - y0 * l2) / l0, (r3 - y0 * l3) / l0


@numba.njit(**COMPILE)
def longest_step(u0, u1, u2, u3, d0, d1, d2, d3):
    """Largest step t with u + t d inside one cone."""
    a = d0 * d0 - d1 * d1 - d2 * d2 - d3 * d3
    b = u0 * d0 - u1 * d1 - u2 * d2 - u3 * d3
    norm = math.sqrt(u1 * u1 + u2 * u2 + u3 * u3)
    c = (u0 - norm) * (u0 + norm)
    discriminant = b * b - a * c
    if a < 0.0 or (b < 0.0 and discriminant >= -1e-9 * b * b):
        root = math.sqrt(max(discriminant, 0.0))
        return c / (root - b) if b <= 0.0 else -(b + root) / a
    return math.inf


@numba.njit(**COMPILE)
def factor(S):
    """Cholesky factor of S (6, 6) in place, lower triangle; False when not positive definite."""
    for j in range(6):
        d = S[j, j]
        for p in range(j):
            d -= S[j, p] * S[j, p]
        if not d > 0.0:
            return False
        d = math.sqrt(d)
        S[j, j] = d
        for i in range(j + 1, 6):
            v = S[i, j]
            for p in range(j):
                v -= S[i, p] * S[j, p]
            S[i, j] = v / d
    return True


@numba.njit(**COMPILE)
def solve_factored(L, x):
    """Solve L L^T x = x in place."""
    for i in range(6):
        v = x[i]
        for p in range(i):
            v -= L[i, p] * x[p]
        x[i] = v / L[i, i]
    for i in range(5, -1, -1):
        v = x[i]
        for p in range(i + 1, 6):
            v -= L[p, i] * x[p]
        x[i] = v / L[i, i]


# rows of a contact's work (k, 8, 4); SIZE uses its first entry only
U, Z, POINT, SIZE, DUAL, FREE, DU, DZ = range(8)
# columns of a group's work (groups, 8)
SLACK, NU, SCHUR, RESIDUE, Q, DSLACK, DNU, COUNT = range(8)
# entries of the scalars (8,)
ALPHA, Z_ALPHA, D_ALPHA, DZ_ALPHA, DUAL_ALPHA = range(5)


@numba.njit(**COMPILE)
def start(groups, work, group, scalars, multipliers):
    """Begin on the cones' axes, inside the bound."""
    work[:] = 0.0
    group[:] = 0.0
    multipliers[:] = 0.0
    for i in range(len(groups)):
        group[groups[i], COUNT] += 1.0
    for i in range(len(groups)):
        work[i, U, 0] = 0.5 / group[groups[i], COUNT]
        work[i, Z, 0] = 1.0
    group[:, SLACK] = 0.5
    group[:, NU] = 1.0
    scalars[ALPHA] = 0.5
    scalars[Z_ALPHA] = 1.0


@numba.njit(**COMPILE)
def measure(G, groups, task, load, sense, weights, work, group, scalars, multipliers, residual):
    """
    Refresh the residuals of all equations.

    Returns
    -------
    (primal, dual, gap, distance): largest residuals, and complementarity's distance from the
    weights, as the sum over the cones and as the largest of any coordinate

    """
    alpha = scalars[ALPHA]
    gap = alpha * scalars[Z_ALPHA]
    distance = gap
    dual_alpha = -sense - scalars[Z_ALPHA]
    for j in range(6):
        residual[j] = load[j] - task[j] * alpha
        dual_alpha += multipliers[j] * task[j]
    scalars[DUAL_ALPHA] = dual_alpha
    dual = abs(dual_alpha)
    for g in range(group.shape[0]):
        group[g, RESIDUE] = 1.0 - group[g, SLACK]
        product = group[g, SLACK] * group[g, NU]
        gap += product
        distance = max(distance, product)
    for i in range(len(groups)):
        g = groups[i]
        group[g, RESIDUE] -= work[i, U, 0]
        product = -2.0 * weights[i]
        for c in range(4):
            u, z = work[i, U, c], work[i, Z, c]
            product += u * z
            rest = group[g, NU] - z if c == 0 else -z
            for j in range(6):
                residual[j] += G[i, c, j] * u
                rest -= G[i, c, j] * multipliers[j]
            work[i, DUAL, c] = rest
            dual = max(dual, abs(rest))
            if c > 0:
                distance = max(distance, abs(work[i, U, 0] * z + work[i, Z, 0] * u))
        gap += abs(product)
        distance = max(distance, abs(product))
    primal = 0.0
    for j in range(6):
        primal = max(primal, abs(residual[j]))
    for g in range(group.shape[0]):
        primal = max(primal, abs(group[g, RESIDUE]))
    return primal, dual, gap, distance


@numba.njit(**COMPILE)
def factor_schur(G, curvature, groups, task, work, group, cross, scalars, S, v):
    """Scale all cones and factor the Schur complement, its group rows eliminated."""
    S[:] = 0.0
    cross[:] = 0.0
    for g in range(group.shape[0]):
        group[g, SCHUR] = group[g, SLACK] / group[g, NU]
    for i in range(len(groups)):
        w0, w1, w2, w3, size = scaling(
            work[i, U, 0], work[i, U, 1], work[i, U, 2], work[i, U, 3],
            work[i, Z, 0], work[i, Z, 1], work[i, Z, 2], work[i, Z, 3])
        work[i, POINT, 0], work[i, POINT, 1] = w0, w1
        work[i, POINT, 2], work[i, POINT, 3] = w2, w3
        work[i, SIZE, 0] = size
        g = groups[i]
        for j in range(6):
            v[j] = G[i, 0, j] * w0 + G[i, 1, j] * w1 + G[i, 2, j] * w2 + G[i, 3, j] * w3
            cross[g, j] += size * (2.0 * w0 * v[j] - G[i, 0, j])
        for j in range(6):
            twice = 2.0 * v[j]
            for p in range(j + 1):
                S[j, p] += size * (twice * v[p] + curvature[i, j, p])
        group[g, SCHUR] += size * (2.0 * w0 * w0 - 1.0)
    for g in range(group.shape[0]):
        for j in range(6):
            share = cross[g, j] / group[g, SCHUR]
            for p in range(j + 1):
                S[j, p] -= share * cross[g, p]
    size_alpha = scalars[ALPHA] / scalars[Z_ALPHA]
    trace = 0.0
    for j in range(6):
        for p in range(j + 1):
            S[j, p] += size_alpha * task[j] * task[p]
        trace += S[j, j]
    for j in range(6):
        S[j, j] += REGULARISATION * trace
    return factor(S)


@numba.njit(**COMPILE)
def aimed_change(work, i, target):
    r"""
    W q of one contact: where u goes when complementarity is to become ``target`` e.

    The predictor aims at zero (target < 0 stands for it) and gives -u; the corrector adds
    W (l \ (target e - (W^-1 du) o (W dz))), with l = W z and the predictor's du, dz.

    """
    u0, u1, u2, u3 = work[i, U, 0], work[i, U, 1], work[i, U, 2], work[i, U, 3]
    if target < 0.0:
        return -u0, -u1, -u2, -u3
    w0, w1, w2, w3 = work[i, POINT, 0], work[i, POINT, 1], work[i, POINT, 2], work[i, POINT, 3]
    # l and b lack a factor sqrt(eta), a has one too many: they cancel in the result
    l0, l1, l2, l3 = apply(
        w0, w1, w2, w3, work[i, Z, 0], work[i, Z, 1], work[i, Z, 2], work[i, Z, 3])
    a0, a1, a2, a3 = apply(
        w0, -w1, -w2, -w3, work[i, DU, 0], work[i, DU, 1], work[i, DU, 2], work[i, DU, 3])
    b0, b1, b2, b3 = apply(
        w0, w1, w2, w3, work[i, DZ, 0], work[i, DZ, 1], work[i, DZ, 2], work[i, DZ, 3])
    y0, y1, y2, y3 = divide(
        l0, l1, l2, l3, target - (a0 * b0 + a1 * b1 + a2 * b2 + a3 * b3),
        -(a0 * b1 + b0 * a1), -(a0 * b2 + b0 * a2), -(a0 * b3 + b0 * a3))
    q0, q1, q2, q3 = apply(w0, w1, w2, w3, y0, y1, y2, y3)
    return q0 - u0, q1 - u1, q2 - u2, q3 - u3


@numba.njit(**COMPILE)
def direction(G, groups, task, weights, work, group, cross, scalars, L, residual, aim, change):
    """
    Newton direction of all variables; ``aim`` < 0 is the predictor.

    Returns
    -------
    The longest step that keeps every cone.

    """
    corrector = aim >= 0.0
    for j in range(6):
        change[j] = -residual[j]
    for g in range(group.shape[0]):
        q = -group[g, SLACK]
        if corrector:
            q += (aim - group[g, DSLACK] * group[g, DNU]) / group[g, NU]
        group[g, Q] = q
        group[g, DNU] = q - group[g, RESIDUE]
    for i in range(len(groups)):
        q0, q1, q2, q3 = aimed_change(work, i, aim + 2.0 * weights[i] if corrector else -1.0)
        r0, r1, r2, r3 = squared(
            work[i, POINT, 0], work[i, POINT, 1], work[i, POINT, 2], work[i, POINT, 3],
            work[i, SIZE, 0],
            work[i, DUAL, 0], work[i, DUAL, 1], work[i, DUAL, 2], work[i, DUAL, 3])
        f0, f1, f2, f3 = q0 - r0, q1 - r1, q2 - r2, q3 - r3
        work[i, FREE, 0], work[i, FREE, 1], work[i, FREE, 2], work[i, FREE, 3] = f0, f1, f2, f3
        for j in range(6):
            change[j] -= G[i, 0, j] * f0 + G[i, 1, j] * f1 + G[i, 2, j] * f2 + G[i, 3, j] * f3
        group[groups[i], DNU] += f0
    size_alpha = scalars[ALPHA] / scalars[Z_ALPHA]
    free_alpha = -scalars[ALPHA] - size_alpha * scalars[DUAL_ALPHA]
    if corrector:
        free_alpha += (aim - scalars[D_ALPHA] * scalars[DZ_ALPHA]) / scalars[Z_ALPHA]
    for j in range(6):
        change[j] += task[j] * free_alpha
    for g in range(group.shape[0]):
        share = group[g, DNU] / group[g, SCHUR]
        for j in range(6):
            change[j] += cross[g, j] * share
    solve_factored(L, change)
    return spread(G, groups, task, work, group, cross, scalars, change, free_alpha)


@numba.njit(**COMPILE)
def spread(G, groups, task, work, group, cross, scalars, change, free_alpha):
    """Turn the change of lambda into that of every variable; return the longest step."""
    step = math.inf
    for g in range(group.shape[0]):
        t = group[g, DNU]
        for j in range(6):
            t += cross[g, j] * change[j]
        t /= group[g, SCHUR]
        group[g, DNU] = t
        group[g, DSLACK] = group[g, Q] - group[g, SLACK] / group[g, NU] * t
        if group[g, DSLACK] < 0.0:
            step = min(step, -group[g, SLACK] / group[g, DSLACK])
        if t < 0.0:
            step = min(step, -group[g, NU] / t)
    t = 0.0
    for j in range(6):
        t += task[j] * change[j]
    scalars[D_ALPHA] = free_alpha - scalars[ALPHA] / scalars[Z_ALPHA] * t
    scalars[DZ_ALPHA] = scalars[DUAL_ALPHA] + t
    if scalars[D_ALPHA] < 0.0:
        step = min(step, -scalars[ALPHA] / scalars[D_ALPHA])
    if scalars[DZ_ALPHA] < 0.0:
        step = min(step, -scalars[Z_ALPHA] / scalars[DZ_ALPHA])
    for i in range(len(groups)):
        d0, d1, d2, d3 = group[groups[i], DNU], 0.0, 0.0, 0.0
        for j in range(6):
            t = change[j]
            d0 -= G[i, 0, j] * t
            d1 -= G[i, 1, j] * t
            d2 -= G[i, 2, j] * t
            d3 -= G[i, 3, j] * t
        r0, r1, r2, r3 = squared(
            work[i, POINT, 0], work[i, POINT, 1], work[i, POINT, 2], work[i, POINT, 3],
            work[i, SIZE, 0], d0, d1, d2, d3)
        u0, u1 = work[i, FREE, 0] - r0, work[i, FREE, 1] - r1
        u2, u3 = work[i, FREE, 2] - r2, work[i, FREE, 3] - r3
        work[i, DU, 0], work[i, DU, 1], work[i, DU, 2], work[i, DU, 3] = u0, u1, u2, u3
        step = min(step, longest_step(
            work[i, U, 0], work[i, U, 1], work[i, U, 2], work[i, U, 3], u0, u1, u2, u3))
        d0, d1 = work[i, DUAL, 0] + d0, work[i, DUAL, 1] + d1
        d2, d3 = work[i, DUAL, 2] + d2, work[i, DUAL, 3] + d3
        work[i, DZ, 0], work[i, DZ, 1], work[i, DZ, 2], work[i, DZ, 3] = d0, d1, d2, d3
        step = min(step, longest_step(
            work[i, Z, 0], work[i, Z, 1], work[i, Z, 2], work[i, Z, 3], d0, d1, d2, d3))
    return step


@numba.njit(**COMPILE)
def advance(step, work, group, scalars, multipliers, change):
    """Take a step along the direction."""
    for i in range(work.shape[0]):
        for c in range(4):
            work[i, U, c] += step * work[i, DU, c]
            work[i, Z, c] += step * work[i, DZ, c]
    for g in range(group.shape[0]):
        group[g, SLACK] += step * group[g, DSLACK]
        group[g, NU] += step * group[g, DNU]
    scalars[ALPHA] += step * scalars[D_ALPHA]
    scalars[Z_ALPHA] += step * scalars[DZ_ALPHA]
    for j in range(6):
        multipliers[j] += step * change[j]


@numba.njit(**COMPILE)
def solve_wrench(G, curvature, groups, task, load, sense, size, weights, work, group, multipliers):
    """
    Largest or smallest alpha of one task wrench, or the weighted centre of eq. (11).

    Parameters
    ----------
    G : (k, 4, 6) array
        Scaled grasp matrix, one contact a block, rows n, t1, t2, m_n.
    curvature : (k, 6, 6) array
        t1 t1^T + t2 t2^T + m m^T - n n^T of the rows of each block: -G J G^T.
    groups : (k,) int array
        Group of each contact, from 0; the caps' shares of a group sum to one at most.
    task, load : (6,) arrays
        Scaled task wrench, of norm one, and external wrench.
    sense : float
        1 for the largest alpha, -1 for the smallest.
    size : float
        a0, the natural size of alpha.
    weights : (k,) array
        Barrier weight of each contact's log det; zero for the optimum itself.
    work : (k, 8, 4) array
        Row U holds the contacts' variables afterwards.
    group : (groups, 8) array
        Column NU holds the bound's multipliers afterwards.
    multipliers : (6,) array
        lambda afterwards.

    Returns
    -------
    (converged, alpha, iterations)

    """
    cross = np.empty((group.shape[0], 6))
    S = np.empty((6, 6))
    residual, change = np.empty(6), np.empty(6)
    scalars = np.zeros(8)
    start(groups, work, group, scalars, multipliers)
    cones = len(groups) + group.shape[0] + 1.0
    largest = weights.max()
    weighted = largest > 0.0
    for iteration in range(MAX_ITERATIONS):
        primal, dual, gap, distance = measure(
            G, groups, task, load, sense, weights, work, group, scalars, multipliers, residual)
        natural = max(scalars[ALPHA], 1e-2 * size)
        if primal <= RESIDUAL * size and dual <= RESIDUAL and (
                distance <= WEIGHTED_GAP * max(natural, largest) if weighted
                else gap <= RELATIVE_GAP * natural):
            return True, scalars[ALPHA], iteration
        if not factor_schur(
                G, curvature, groups, task, work, group, cross, scalars, S, change):
            break
        if weighted:  # a predictor towards the weights, without a second-order term
            work[:, DU:] = 0.0
            group[:, DSLACK:DNU + 1] = 0.0
            scalars[D_ALPHA] = 0.0
        step = min(1.0, direction(
            G, groups, task, weights, work, group, cross, scalars, S, residual,
            0.0 if weighted else -1.0, change))
        aim = (1.0 - step) ** 3 * gap / cones
        step = min(1.0, STEP_SHARE * direction(
            G, groups, task, weights, work, group, cross, scalars, S, residual, aim, change))
        if not step > 1e-12:
            break
        advance(step, work, group, scalars, multipliers, change)
    return False, scalars[ALPHA], iteration


@numba.njit(nogil=True, **COMPILE)
def solve_wrenches(G, curvature, groups, group_count, tasks, load, size, alphas, shares,
                   multipliers, converged):
    """
    Largest alpha of many task wrenches on one grasp; releases Python's lock meanwhile.

    Parameters
    ----------
    G, curvature, groups, load, size
        As in ``solve_wrench``.
    group_count : int
        Number of groups.
    tasks : (N, 6) array
        Scaled task wrenches, each of norm one.
    alphas : (N,) array
        Largest alpha of each task afterwards, in its scaled unit.
    shares : (N, k, 4) array
        Contacts' variables n, t1, t2, m_n afterwards.
    multipliers : (N, 6) array
        lambda of each task afterwards.
    converged : (N,) bool array
        Whether each task met the tolerances, afterwards.

    """
    k = G.shape[0]
    work, group = np.empty((k, 8, 4)), np.empty((group_count, 8))
    weights = np.zeros(k)
    for i in range(tasks.shape[0]):
        converged[i], alphas[i], _ = solve_wrench(
            G, curvature, groups, tasks[i], load, 1.0, size, weights, work, group, multipliers[i])
        for contact in range(k):
            for c in range(4):
                shares[i, contact, c] = work[contact, U, c]

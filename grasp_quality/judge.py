# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The proof of answers to task wrenches under bounds made of groups, compiled.

What ``proof`` says of all problems, for the kind that the kernel answers, in scaled units: one
definition that judges single answers and thousands alike. It knows nothing of how an answer came
about. Tolerances are arguments, so that they stand in ``proof`` alone. Calls no compiled code of
another file (see ``kernel``).
"""

import math

from grasp_quality.arrays import Array, Codes, Ints
import numba
import numpy as np

UNPROVED, OPTIMAL, INFEASIBLE = 0, 1, 2
HEAVY = 100.0  # times the caps: beyond it a load is no measure of what may be left unbalanced

# no fastmath that would let the compiler assume away nan
COMPILE = {'cache': True, 'error_model': 'numpy', 'nogil': True,
           'fastmath': {'contract', 'reassoc', 'nsz'}}
INSIDE = {key: value for key, value in COMPILE.items() if key != 'cache'}


@numba.njit(**INSIDE)
def worth_of(block: Array, groups: Ints, multiplier: Array, per_group: Array) -> float:
    """Write the worth of every group's best contact along lambda; return their sum."""
    per_group[:] = 0.0
    for i in range(len(groups)):
        h0, h1, h2, h3 = 0.0, 0.0, 0.0, 0.0
        for j in range(6):
            x = multiplier[j]
            h0 += block[i, 0, j] * x
            h1 += block[i, 1, j] * x
            h2 += block[i, 2, j] * x
            h3 += block[i, 3, j] * x
        worth = h0 + math.sqrt(h1 * h1 + h2 * h2 + h3 * h3)
        if worth > per_group[groups[i]]:
            per_group[groups[i]] = worth
    total: float = per_group.sum()
    return total


@numba.njit(**INSIDE)
def dot(a: Array, b: Array) -> float:
    """Scalar product of two (6,) arrays."""
    total: float = (
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
    return total


@numba.njit(**INSIDE)
def usage_of(share: Array, rounding: float) -> float:
    """Share of one friction cone in use, for shares [n, t1, t2, m_n]; see ``friction_cone``."""
    normal = share[0]
    norm = math.sqrt(share[1] * share[1] + share[2] * share[2] + share[3] * share[3])
    if abs(normal) <= rounding and norm <= rounding:
        return 0.0
    return norm / normal if normal > 0.0 else math.inf


@numba.njit(**COMPILE)
def judge(block: Array, groups: Ints, task: Array, load: Array, reach: float, least_cap: float,
          alpha: float, share: Array, multiplier: Array, small_cap: float, rounding: float,
          per_group: Array,
          usage: Array) -> tuple[float, float, float, float, float, float, float]:
    """
    Judge one answer to the question for the largest alpha.

    Parameters
    ----------
    block : (k, 4, 6) array
        Scaled grasp matrix, rows n, t1, t2, m_n a contact.
    groups : (k,) int64 array
        Group of each contact.
    task, load : (6,) arrays
        Scaled task wrench and external wrench.
    reach, least_cap : float
        a0, and the smallest cap as a share of the largest.
    alpha : float
        What the answer claims.
    share : (k, 4) array
        Forces [n, t1/mu, t2/mu, m_n/gamma] as shares of the caps.
    multiplier : (6,) array
        The solver's lambda; anything is allowed, a bad one gives a bad bound.
    small_cap, rounding : float
        Of ``proof``.
    per_group : (groups,) array
        Afterwards the smallest multipliers nu of the bound that are feasible with lambda.
    usage : (k,) array
        Afterwards the cone usage of each contact.

    Returns
    -------
    (alpha, upper, scale, residual, imbalance, usage, bound_usage) : alpha between zero and its
        bound; the bound; the factor that makes lambda and nu exactly feasible; the figures of
        ``proof.Proof``

    """
    upper = dot(multiplier, load) + worth_of(block, groups, multiplier, per_group)
    slack = dot(multiplier, task)
    scale = 1.0 / slack if slack > 0.0 else math.inf
    if scale < math.inf:
        upper *= scale
    else:
        upper, scale = math.inf, 1.0
    if not alpha < upper:
        alpha = upper if alpha >= upper else 0.0
    if not alpha > 0.0:
        alpha = 0.0
    left = 0.0
    for j in range(6):
        balance = load[j] - alpha * task[j]
        for i in range(len(groups)):
            for c in range(4):
                balance += block[i, c, j] * share[i, c]
        left += balance * balance
    left = math.sqrt(left)
    size, applied = math.sqrt(dot(load, load)), abs(alpha) * math.sqrt(dot(task, task))
    largest, used = 0.0, -math.inf
    for i in range(len(groups)):
        usage[i] = usage_of(share[i], rounding)
        largest = max(largest, usage[i])
    for g in range(len(per_group)):
        pressed = 0.0
        for i in range(len(groups)):
            if groups[i] == g:
                pressed += share[i, 0]
        used = max(used, pressed)
    return (alpha, upper, scale, left / max(reach, min(size, HEAVY * reach)),
            left / max(max(size, applied), small_cap * least_cap), largest, used)


@numba.njit(**INSIDE)
def holds(alpha: float, upper: float, size: float, residual: float, imbalance: float, usage: float,
          bound_usage: float, tolerances: tuple[float, ...]) -> bool:
    """Whether gap, residuals, cone usage and use of the bound are all within tolerance."""
    return ((upper - alpha) / max(alpha, 1e-3 * size) <= tolerances[0]
            and residual <= tolerances[1] and imbalance <= tolerances[2]
            and usage <= 1.0 + tolerances[3] and bound_usage <= 1.0 + tolerances[3])


@numba.njit(**COMPILE)
def infeasibility_margin(block: Array, groups: Ints, task: Array, load: Array, reach: float,
                         multiplier: Array, per_group: Array) -> float:
    """
    Distance that a lambda proves between the load and anything the grasp can balance.

    As a share of the caps' total; lambda is turned until the task does no negative work along it.
    Uses up ``multiplier`` (6,) and ``per_group`` (groups,).

    """
    largest = 0.0
    for j in range(6):
        largest = max(largest, abs(multiplier[j]))
    if not (0.0 < largest < math.inf):
        return 0.0
    for j in range(6):
        multiplier[j] /= largest
    slack, turn = dot(multiplier, task), dot(task, task)
    if slack < 0.0:
        for j in range(6):
            multiplier[j] -= slack / turn * task[j]
    size = math.sqrt(dot(multiplier, multiplier))
    if not size > 0.0:
        return 0.0
    work = worth_of(block, groups, multiplier, per_group) + dot(multiplier, load)
    return -work / size / reach


@numba.njit(**INSIDE)
def write_forces(which: Ints, units: Array, shares: Array, status: Codes, forces: Array) -> None:
    """Write [t1, t2, n, m_n] (N, k, 4) of the proved answers, else zero; nothing for (0, k, 4)."""
    for n in range(len(forces)):
        m = which[n]
        for i in range(forces.shape[1]):
            for c in range(4):
                forces[n, i, c] = 0.0
            if status[n] == OPTIMAL:
                forces[n, i, 0] = shares[n, i, 1] * units[m, i, 0]
                forces[n, i, 1] = shares[n, i, 2] * units[m, i, 1]
                forces[n, i, 2] = shares[n, i, 0] * units[m, i, 2]
                forces[n, i, 3] = shares[n, i, 3] * units[m, i, 3]


@numba.njit(**COMPILE)
def judge_many(tolerances: tuple[float, ...], blocks: Array, which: Ints, groups: Ints,
               group_count: int, tasks: Array, loads: Array, reaches: Array, least_caps: Array,
               units: Array, sizes: Array, alphas: Array, shares: Array, multipliers: Array,
               status: Codes, uppers: Array, forces: Array) -> None:
    """
    Judge the kernel's answers to N problems, and give them their units.

    Parameters
    ----------
    tolerances : tuple of float
        Of ``proof``: gap, residual, imbalance, usage, infeasibility, SMALL_CAP, ROUNDING.
    blocks, which, groups, group_count, tasks, loads, reaches
        As in ``kernel.solve_many``.
    least_caps : (M,) array
        Smallest cap of each grasp as a share of its largest.
    units : (M, k, 4) array [N, N, N, N m]
        Local forces [t1, t2, n, m_n] that a share of one stands for.
    sizes : (N,) array
        Norm of each scaled task, by which it was divided.
    alphas, shares, multipliers : (N,), (N, k, 4), (N, 6) arrays
        The answers; alphas as multiples of the tasks afterwards, 0 where none is proved.
    status : (N,) int8 array
        OPTIMAL, INFEASIBLE or UNPROVED afterwards.
    uppers : (N,) array
        Dual bounds of alpha afterwards; inf where unproved.
    forces : (N, k, 4) array
        Afterwards [t1, t2, n, m_n] of the proved answers, else zero; (0, k, 4) when not wanted.

    """
    per_group, usage, direction = np.empty(group_count), np.empty(len(groups)), np.empty(6)
    for n in range(len(which)):
        m = which[n]
        alpha, upper, verdict = 0.0, math.inf, UNPROVED
        claimed, bound, _, residual, imbalance, largest, used = judge(
            blocks[m], groups, tasks[n], loads[n], reaches[m], least_caps[m], alphas[n],
            shares[n], multipliers[n], tolerances[5], tolerances[6], per_group, usage)
        if holds(claimed, bound, reaches[m], residual, imbalance, largest, used, tolerances):
            alpha, upper, verdict = claimed / sizes[n], bound / sizes[n], OPTIMAL
        else:
            for j in range(6):
                direction[j] = multipliers[n, j]
            if infeasibility_margin(blocks[m], groups, tasks[n], loads[n], reaches[m], direction,
                                    per_group) > tolerances[4]:
                upper, verdict = 0.0, INFEASIBLE
        alphas[n], uppers[n], status[n] = alpha, max(alpha, upper), verdict
    write_forces(which, units, shares, status, forces)


@numba.njit(**INSIDE)
def centre_bound(block: Array, groups: Ints, task: Array, load: Array, eps: float, unit: Array,
                 multiplier: Array, nu: Array) -> float:
    """Bound eq. (11)'s objective by its dual in closed form (``barrier.objective_upper``)."""
    along = dot(multiplier, task)
    if not along > 0.0:
        return math.inf
    scale = 1.0 / min(along, 1.0)
    bound = dot(multiplier, load) * scale
    for g in range(len(nu)):
        bound += max(nu[g], 0.0) * scale
    for i in range(len(groups)):
        h0, h1, h2, h3 = 0.0, 0.0, 0.0, 0.0
        for j in range(6):
            x = multiplier[j] * scale
            h0 += block[i, 0, j] * x
            h1 += block[i, 1, j] * x
            h2 += block[i, 2, j] * x
            h3 += block[i, 3, j] * x
        s = max(nu[groups[i]], 0.0) * scale - h0
        rest = math.sqrt(h1 * h1 + h2 * h2 + h3 * h3)
        if not s > rest:
            return math.inf
        if unit[i, 0] > 0.0 or unit[i, 3] > 0.0:
            bound += eps * (math.log(4.0 * eps * eps / ((s - rest) * (s + rest))) - 2.0)
        else:
            bound += eps * (math.log(eps / s) - 1.0)
    return bound


@numba.njit(**INSIDE)
def log_det_sum(share: Array, unit: Array) -> float:
    """Sum of log det P_i over the contacts, -inf on an edge (``friction_cone.log_det``)."""
    total = 0.0
    for i in range(len(share)):
        norm = math.sqrt(share[i, 1] ** 2 + share[i, 2] ** 2 + share[i, 3] ** 2)
        if not share[i, 0] > norm:
            return -math.inf
        if unit[i, 0] > 0.0 or unit[i, 3] > 0.0:
            total += math.log((share[i, 0] - norm) * (share[i, 0] + norm))
        else:
            total += math.log(share[i, 0])
    return total


@numba.njit(**COMPILE)
def judge_centres(tolerances: tuple[float, ...], blocks: Array, which: Ints, groups: Ints,
                  group_count: int, tasks: Array, loads: Array, reaches: Array, least_caps: Array,
                  units: Array, sizes: Array, weight: float, alphas: Array, shares: Array,
                  multipliers: Array, nus: Array, uppers: Array, status: Codes,
                  forces: Array) -> None:
    """
    Judge the kernel's answers to N problems with a barrier weight.

    As ``judge_many``, with ``weight`` eps in the unit of alpha, the bound's multipliers ``nus``
    (N, groups), and in ``uppers`` (N,) what is proved of alpha without the weight.

    """
    per_group, usage = np.empty(group_count), np.empty(len(groups))
    for n in range(len(which)):
        m, eps = which[n], weight * sizes[n]
        claimed = min(alphas[n], uppers[n] * sizes[n])
        alpha, _, _, residual, imbalance, largest, used = judge(
            blocks[m], groups, tasks[n], loads[n], reaches[m], least_caps[m], claimed, shares[n],
            multipliers[n], tolerances[5], tolerances[6], per_group, usage)
        upper = centre_bound(
            blocks[m], groups, tasks[n], loads[n], eps, units[m], multipliers[n], nus[n])
        objective = alpha + eps * log_det_sum(shares[n], units[m])
        proved = (upper - objective) / max(max(alpha, eps), 1e-3 * reaches[m]) <= tolerances[0] \
            and holds(alpha, alpha, reaches[m], residual, imbalance, largest, used, tolerances)
        alphas[n] = alpha / sizes[n] if proved else 0.0
        status[n] = OPTIMAL if proved else UNPROVED
    write_forces(which, units, shares, status, forces)

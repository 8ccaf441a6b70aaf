# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Task wrenches, compiled: a primal-dual interior-point method for several problems at a time.

The program is that of ``problem`` (scaled, standard form) for bounds that partition the contacts
into groups. Every contact is one second-order cone of four coordinates [n, t1, t2, m_n], padded
with zeros where the model carries less; group slacks and alpha are half lines. The method is the
common one, with Nesterov-Todd scaling and Mehrotra's corrector (CVXOPT, ECOS, Clarabel). The Schur
complement has six rows for equilibrium and one a group; the latter are diagonal and eliminated, so
that the cost is linear in the contacts.

Problems of one pattern (contact count and groups) run side by side in the lanes of the processor's
vector registers: every number below is ``WIDTH`` numbers, one a problem, and every row of a work
array holds one such. A lane whose problem is done takes the next one. One problem alone costs what
``WIDTH`` of them cost.

Weights turn the optimum into the weighted centre of eq. (11): see ``centering``. All that is
compiled together stands in this one file, however long: numba's cache notices a change of the file
that a function stands in, but not of the files that it calls into, and stale machine code moves
motors. ``judge`` and ``scaled`` are compiled by themselves and call nothing else.
"""

import math


import operator

from grasp_quality.arrays import Array, Codes, Ints
from llvmlite import ir
import numba
from numba.core import cgutils, types
from numba.core.typeconv import Conversion
from numba.core.typing import signature
from numba.core.typing.templates import ConcreteTemplate, infer_global
from numba.extending import intrinsic, lower_builtin, lower_cast, models, register_model
import numpy as np

WIDTH = 4  # problems at a time; 8 answer maps a fifth faster and one alone half as fast

STEP_SHARE = 0.99   # of the way to the edge of the cones
SHORTEST_STEP = 1e-12
REGULARISATION = 1e-16  # of the Schur complement's trace: grasps may be rank-deficient

RELATIVE_GAP = 1e-9     # of max(alpha, 1e-2 a0), aimed at
WEIGHTED_GAP = 1e-12    # of the same, or of the largest weight: a smooth optimum is that sharp
LEAST_GAP = 1e-13       # of the same: complementarity beyond which numbers only get worse
ACCEPTED = 1e-7         # gap that counts as solved when the iteration ends early
RESIDUAL = 1e-9         # of equilibrium and bound, in shares of the caps, accepted, and
SMALL_CAP = 1e-2        # hundred times that of what is balanced, or a share of the smallest cap
MAX_ITERATIONS = 40
INFEASIBLE_MARGIN = 2e-9  # of the caps' total: what proves a load out of reach (``proof``), twice

STALLED, SOLVED, INFEASIBLE = 0, 1, 2

# no fastmath that would let the compiler assume away nan
PLAIN = {'error_model': 'numpy', 'fastmath': {'contract', 'reassoc', 'nsz'}}
INLINE = {**PLAIN, 'forceinline': True}


# Lanes: WIDTH numbers as one value of the compiled code.

VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
BITS = ir.VectorType(ir.IntType(1), WIDTH)
INDEX = ir.IntType(64)


class Lanes(types.Type):
    """``WIDTH`` float64 numbers, one a problem."""

    def can_convert_from(self, context, other):
        """Take a number as the same in all lanes."""
        return Conversion.safe if other == types.float64 else None


class Mask(types.Type):
    """``WIDTH`` bools, one a problem."""


LANES, MASK = Lanes('Lanes'), Mask('Mask')


@register_model(Lanes)
class LanesModel(models.PrimitiveModel):
    """Lanes are a vector of the machine."""

    def __init__(self, manager, kind):
        super().__init__(manager, kind, VECTOR)


@register_model(Mask)
class MaskModel(models.PrimitiveModel):
    """Masks are a vector of bits."""

    def __init__(self, manager, kind):
        super().__init__(manager, kind, BITS)


@lower_cast(types.float64, LANES)
def _spread(context, builder, source, target, value):
    nothing = ir.Constant(VECTOR, ir.Undefined)
    first = builder.insert_element(nothing, value, ir.Constant(ir.IntType(32), 0))
    everywhere = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(first, nothing, everywhere)


def _operation(symbol, make, result, *arguments):
    """Teach the compiler one operator of lanes or masks."""
    class Template(ConcreteTemplate):
        cases = [signature(result, *arguments)]

    infer_global(symbol)(Template)
    lower_builtin(symbol, *arguments)(lambda context, builder, sig, args: make(builder, *args))


for symbol_, name_ in (
        (operator.add, 'fadd'), (operator.sub, 'fsub'), (operator.mul, 'fmul'),
        (operator.truediv, 'fdiv'), (operator.iadd, 'fadd'), (operator.isub, 'fsub'),
        (operator.imul, 'fmul')):
    _operation(symbol_, lambda b, x, y, name=name_: getattr(b, name)(x, y), LANES, LANES, LANES)
for symbol_, name_ in ((operator.lt, '<'), (operator.le, '<='), (operator.gt, '>')):
    _operation(symbol_, lambda b, x, y, name=name_: b.fcmp_ordered(name, x, y), MASK, LANES, LANES)
_operation(operator.neg, lambda b, x: b.fneg(x), LANES, LANES)
_operation(operator.and_, lambda b, x, y: b.and_(x, y), MASK, MASK, MASK)
_operation(operator.or_, lambda b, x, y: b.or_(x, y), MASK, MASK, MASK)


@intrinsic
def root(context, value):
    """Square roots."""
    def code(context, builder, sig, args):
        kind = ir.FunctionType(VECTOR, [VECTOR])
        name = f'llvm.sqrt.v{WIDTH}f64'
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), args)
    return LANES(LANES), code


@intrinsic
def choose(context, mask, yes, no):
    """Per lane the first where the mask is set, the second elsewhere."""
    def code(context, builder, sig, args):
        return builder.select(*args)
    return LANES(MASK, LANES, LANES), code


@intrinsic
def bits(context, mask):
    """Mask as a whole number, lane 0 in its lowest bit."""
    def code(context, builder, sig, args):
        return builder.zext(builder.bitcast(args[0], ir.IntType(WIDTH)), INDEX)
    return types.int64(MASK), code


def _row(context, builder, kind, array, row):
    first = builder.mul(row, ir.Constant(INDEX, WIDTH))
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [first]), VECTOR.as_pointer())


@intrinsic
def load(context, array, row):
    """Row of an (rows, WIDTH) array."""
    def code(context, builder, sig, args):
        return builder.load(_row(context, builder, sig.args[0], *args), align=8)
    return LANES(array, types.int64), code


@intrinsic
def store(context, array, row, value):
    """Write a row of an (rows, WIDTH) array."""
    def code(context, builder, sig, args):
        builder.store(args[2], _row(context, builder, sig.args[0], *args[:2]), align=8)
        return context.get_dummy_value()
    return types.void(array, types.int64, LANES), code


@numba.njit(**INLINE)
def least(a, b):
    """Smaller per lane."""
    return choose(a < b, a, b)


@numba.njit(**INLINE)
def most(a, b):
    """Larger per lane; the second where either is nan."""
    return choose(a > b, a, b)


@numba.njit(**INLINE)
def size_of(a):
    """Absolute value."""
    return choose(a < 0.0, -a, a)


@numba.njit(**INLINE)
def load4(array, row):
    """Four rows."""
    return load(array, row), load(array, row + 1), load(array, row + 2), load(array, row + 3)


@numba.njit(**INLINE)
def store4(array, row, v):
    """Write four rows."""
    store(array, row, v[0])
    store(array, row + 1, v[1])
    store(array, row + 2, v[2])
    store(array, row + 3, v[3])


@numba.njit(**INLINE)
def length(array, row):
    """Sum of six rows' squares."""
    total = load(array, row) * load(array, row)
    for j in range(1, 6):
        total += load(array, row + j) * load(array, row + j)
    return total


# One cone: u, z and what the method makes of them, tuples of four lanes, axis first.

@numba.njit(**INLINE)
def determinant(u):
    """u_0^2 - |u_1|^2, without cancellation."""
    norm = root(u[1] * u[1] + u[2] * u[2] + u[3] * u[3])
    return (u[0] - norm) * (u[0] + norm)


@numba.njit(**INLINE)
def apply(w, share, v):
    """W v / eta, with share = 1 / (1 + w_0)."""
    along = w[1] * v[1] + w[2] * v[2] + w[3] * v[3]
    t = v[0] + along * share
    return w[0] * v[0] + along, v[1] + t * w[1], v[2] + t * w[2], v[3] + t * w[3]


@numba.njit(**INLINE)
def apply_inverse(w, share, v):
    """W^-1 v eta, with share = 1 / (1 + w_0)."""
    along = w[1] * v[1] + w[2] * v[2] + w[3] * v[3]
    t = along * share - v[0]
    return w[0] * v[0] - along, v[1] + t * w[1], v[2] + t * w[2], v[3] + t * w[3]


@numba.njit(**INLINE)
def squared(w, size, v):
    """W^2 v."""
    dot = 2.0 * (w[0] * v[0] + w[1] * v[1] + w[2] * v[2] + w[3] * v[3])
    return (size * (dot * w[0] - v[0]), size * (dot * w[1] + v[1]), size * (dot * w[2] + v[2]),
            size * (dot * w[3] + v[3]))


@numba.njit(**INLINE)
def divide(u, r):
    """Solve u o y = r in the Jordan algebra."""
    y0 = (u[0] * r[0] - u[1] * r[1] - u[2] * r[2] - u[3] * r[3]) / determinant(u)
    t = 1.0 / u[0]
    return y0, (r[1] - y0 * u[1]) * t, (r[2] - y0 * u[2]) * t, (r[3] - y0 * u[3]) * t


@numba.njit(**INLINE)
def pressure(u, det, d):
    """Inverse of the largest step t with u + t d inside the cone; zero when every t is."""
    a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2] - d[3] * d[3]
    b = u[0] * d[0] - u[1] * d[1] - u[2] * d[2] - u[3] * d[3]
    discriminant = b * b - a * det
    r = root(most(discriminant, 0.0))
    ahead = b < 0.0
    t = choose(ahead, r - b, -a) / choose(ahead, det, r + b)
    # a half line has a double root, which rounding must not hide
    return choose(discriminant < -1e-9 * b * b, 0.0, most(t, 0.0))


# Rows of a contact in ``work``; its scaled grasp matrix has 24 in ``G``, its curvature 21.
U, Z, POINT, DUAL, Q, DU, DZ = 0, 4, 8, 12, 16, 20, 24
KEPT, SIZE, SHARE, DET_U, DET_Z, WEIGHT, CONTACT = 28, 32, 33, 34, 35, 36, 37
# Rows of a group in ``group``.
(SLACK, NU, SCHUR, RESIDUE, CHANGE, DSLACK, DNU, WORTH, KEPT_NU, CROSS, GROUP) = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 15)
# Rows of ``state``.
TASK, LOAD, LAMBDA, BALANCE, DLAMBDA, KEPT_LAMBDA, S, PIVOT = 0, 6, 12, 18, 24, 30, 36, 57
(ALPHA, Z_ALPHA, D_ALPHA, DZ_ALPHA, DUAL_ALPHA, FREE_ALPHA, REACH, LARGEST, BALANCED, KEPT_ALPHA,
 STATE) = range(63, 74)


@numba.njit(**INLINE)
def transposed(G, row, state, at):
    """G_i^T x of one contact for the six rows x of ``state``."""
    x = load(state, at)
    h0, h1 = load(G, row) * x, load(G, row + 6) * x
    h2, h3 = load(G, row + 12) * x, load(G, row + 18) * x
    for j in range(1, 6):
        x = load(state, at + j)
        h0 += load(G, row + j) * x
        h1 += load(G, row + 6 + j) * x
        h2 += load(G, row + 12 + j) * x
        h3 += load(G, row + 18 + j) * x
    return h0, h1, h2, h3


@numba.njit(**INLINE)
def add_wrench(G, row, f, state, at):
    """Add G_i f of one contact to six rows of ``state``."""
    for j in range(6):
        store(state, at + j, load(state, at + j) + (
            (load(G, row + j) * f[0] + load(G, row + 6 + j) * f[1])
            + (load(G, row + 12 + j) * f[2] + load(G, row + 18 + j) * f[3])))


@numba.njit(**INLINE)
def scale_cone(work, row):
    """Nesterov-Todd point of one cone, of determinant one, and its squared size eta^2."""
    u, z = load4(work, row + U), load4(work, row + Z)
    det_u, det_z = determinant(u), determinant(z)
    root_u = root(det_u)
    ru, rz = 1.0 / root_u, 1.0 / root(det_z)
    dot = (u[0] * z[0] + u[1] * z[1] + u[2] * z[2] + u[3] * z[3]) * (ru * rz)
    half = 0.5 / root(0.5 * (1.0 + dot))
    ru_half, rz_half = ru * half, rz * half
    w = (u[0] * ru_half + z[0] * rz_half, u[1] * ru_half - z[1] * rz_half,
         u[2] * ru_half - z[2] * rz_half, u[3] * ru_half - z[3] * rz_half)
    size = root_u * rz
    store4(work, row + POINT, w)
    store(work, row + SIZE, size)
    store(work, row + SHARE, 1.0 / (1.0 + w[0]))
    store(work, row + DET_U, det_u)
    store(work, row + DET_Z, det_z)
    return w, size


@numba.njit(**INLINE)
def aimed_change(work, row, target, first):
    r"""
    W q of one contact: where u goes when complementarity is to become ``target`` e.

    W (l \ (target e - (W^-1 du) o (W dz))) - u, with l = W z and the predictor's du, dz; ``first``
    leaves the second-order term out.

    """
    u, w = load4(work, row + U), load4(work, row + POINT)
    share = load(work, row + SHARE)
    # l and b lack a factor sqrt(eta), a has one too many: they cancel in the result
    scaled = apply(w, share, load4(work, row + Z))
    if first:
        zero = 0.0 * target
        y = divide(scaled, (target, zero, zero, zero))
    else:
        a = apply_inverse(w, share, load4(work, row + DU))
        b = apply(w, share, load4(work, row + DZ))
        y = divide(scaled, (
            target - (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]),
            -(a[0] * b[1] + b[0] * a[1]), -(a[0] * b[2] + b[0] * a[2]),
            -(a[0] * b[3] + b[0] * a[3])))
    q = apply(w, share, y)
    return q[0] - u[0], q[1] - u[1], q[2] - u[2], q[3] - u[3]


@numba.njit(**PLAIN)
def factor_schur(G, curvature, groups, work, group, state, weighted):
    """Scale all cones, factor the Schur complement, and begin the predictor's right side."""
    for row in range(21):
        store(state, S + row, 0.0)
    for j in range(6):
        store(state, DLAMBDA + j, -load(state, BALANCE + j))
    for g in range(0, group.shape[0], GROUP):
        slack, nu = load(group, g + SLACK), load(group, g + NU)
        store(group, g + SCHUR, slack / nu)
        store(group, g + CHANGE, -slack)
        store(group, g + DNU, -slack - load(group, g + RESIDUE))
        for j in range(6):
            store(group, g + CROSS + j, 0.0)
    for i in range(len(groups)):
        row, at, g = i * CONTACT, i * 24, groups[i] * GROUP
        w, size = scale_cone(work, row)
        twice = 2.0 * w[0]
        v = (
            load(G, at) * w[0] + load(G, at + 6) * w[1]
            + load(G, at + 12) * w[2] + load(G, at + 18) * w[3],
            load(G, at + 1) * w[0] + load(G, at + 7) * w[1]
            + load(G, at + 13) * w[2] + load(G, at + 19) * w[3],
            load(G, at + 2) * w[0] + load(G, at + 8) * w[1]
            + load(G, at + 14) * w[2] + load(G, at + 20) * w[3],
            load(G, at + 3) * w[0] + load(G, at + 9) * w[1]
            + load(G, at + 15) * w[2] + load(G, at + 21) * w[3],
            load(G, at + 4) * w[0] + load(G, at + 10) * w[1]
            + load(G, at + 16) * w[2] + load(G, at + 22) * w[3],
            load(G, at + 5) * w[0] + load(G, at + 11) * w[1]
            + load(G, at + 17) * w[2] + load(G, at + 23) * w[3])
        entry = 0
        for j in range(6):
            store(group, g + CROSS + j, load(group, g + CROSS + j)
                  + size * (twice * v[j] - load(G, at + j)))
            double = 2.0 * v[j]
            for p in range(j + 1):
                store(state, S + entry, load(state, S + entry)
                      + size * (double * v[p] + load(curvature, i * 21 + entry)))
                entry += 1
        store(group, g + SCHUR, load(group, g + SCHUR) + size * (twice * w[0] - 1.0))
        if weighted:
            q = aimed_change(work, row, 2.0 * load(work, row + WEIGHT), True)
        else:
            u = load4(work, row + U)
            q = (-u[0], -u[1], -u[2], -u[3])
        store4(work, row + Q, q)
        r = squared(w, size, load4(work, row + DUAL))
        f = (r[0] - q[0], r[1] - q[1], r[2] - q[2], r[3] - q[3])
        add_wrench(G, at, f, state, DLAMBDA)
        store(group, g + DNU, load(group, g + DNU) - f[0])
    trace = load(state, S)
    for j in range(1, 6):
        trace += load(state, S + j * (j + 3) // 2)
    for g in range(0, group.shape[0], GROUP):
        inverse = 1.0 / load(group, g + SCHUR)
        store(group, g + SCHUR, inverse)
        entry = 0
        for j in range(6):
            share = load(group, g + CROSS + j) * inverse
            for p in range(j + 1):
                store(state, S + entry,
                      load(state, S + entry) - share * load(group, g + CROSS + p))
                entry += 1
    size = load(state, ALPHA) / load(state, Z_ALPHA)
    store(state, FREE_ALPHA, -load(state, ALPHA) - size * load(state, DUAL_ALPHA))
    trace += size  # the task has norm one
    entry = 0
    for j in range(6):
        share = size * load(state, TASK + j)
        for p in range(j + 1):
            store(state, S + entry, load(state, S + entry) + share * load(state, TASK + p))
            entry += 1
        store(state, S + entry - 1, load(state, S + entry - 1) + REGULARISATION * trace)
    factor(state)


@numba.njit(**INLINE)
def factor(state):
    """Cholesky factor of S in place, its inverse pivots aside; zero where there is no pivot."""
    for j in range(6):
        row = S + j * (j + 1) // 2
        d = load(state, row + j)
        for p in range(j):
            v = load(state, row + p)
            d -= v * v
        inverse = choose(d > 0.0, 1.0 / root(d), 0.0)
        store(state, PIVOT + j, inverse)
        for i in range(j + 1, 6):
            below = S + i * (i + 1) // 2
            v = load(state, below + j)
            for p in range(j):
                v -= load(state, below + p) * load(state, row + p)
            store(state, below + j, v * inverse)


@numba.njit(**INLINE)
def finish_direction(state, group):
    """Solve for the change of lambda; its right side lacks what groups and task give."""
    free = load(state, FREE_ALPHA)
    for j in range(6):
        store(state, DLAMBDA + j, load(state, DLAMBDA + j) + load(state, TASK + j) * free)
    for g in range(0, group.shape[0], GROUP):
        share = load(group, g + DNU) * load(group, g + SCHUR)
        for j in range(6):
            store(state, DLAMBDA + j,
                  load(state, DLAMBDA + j) + load(group, g + CROSS + j) * share)
    for i in range(6):
        row = S + i * (i + 1) // 2
        v = load(state, DLAMBDA + i)
        for p in range(i):
            v -= load(state, row + p) * load(state, DLAMBDA + p)
        store(state, DLAMBDA + i, v * load(state, PIVOT + i))
    for k in range(6):
        i = 5 - k
        v = load(state, DLAMBDA + i)
        for p in range(i + 1, 6):
            v -= load(state, S + p * (p + 1) // 2 + i) * load(state, DLAMBDA + p)
        store(state, DLAMBDA + i, v * load(state, PIVOT + i))


@numba.njit(**PLAIN)
def direction(G, groups, work, group, state):
    """
    Turn the right side into the change of every variable.

    Returns
    -------
    Inverse of the longest step that keeps every cone.

    """
    finish_direction(state, group)
    pressed = 0.0 * load(state, ALPHA)
    for g in range(0, group.shape[0], GROUP):
        t = load(group, g + DNU)
        for j in range(6):
            t += load(group, g + CROSS + j) * load(state, DLAMBDA + j)
        t *= load(group, g + SCHUR)
        slack, nu = load(group, g + SLACK), load(group, g + NU)
        change = load(group, g + CHANGE) - slack / nu * t
        store(group, g + DNU, t)
        store(group, g + DSLACK, change)
        pressed = most(pressed, most(-change / slack, -t / nu))
    t = 0.0 * pressed
    for j in range(6):
        t += load(state, TASK + j) * load(state, DLAMBDA + j)
    alpha, z_alpha = load(state, ALPHA), load(state, Z_ALPHA)
    change, dual = load(state, FREE_ALPHA) - alpha / z_alpha * t, load(state, DUAL_ALPHA) + t
    store(state, D_ALPHA, change)
    store(state, DZ_ALPHA, dual)
    pressed = most(pressed, most(-change / alpha, -dual / z_alpha))
    for i in range(len(groups)):
        row, g = i * CONTACT, groups[i] * GROUP
        h = transposed(G, i * 24, state, DLAMBDA)
        dual = load4(work, row + DUAL)
        dz = (dual[0] + load(group, g + DNU) - h[0], dual[1] - h[1], dual[2] - h[2],
              dual[3] - h[3])
        r = squared(load4(work, row + POINT), load(work, row + SIZE), dz)
        q = load4(work, row + Q)
        du = (q[0] - r[0], q[1] - r[1], q[2] - r[2], q[3] - r[3])
        store4(work, row + DU, du)
        store4(work, row + DZ, dz)
        pressed = most(pressed, most(
            pressure(load4(work, row + U), load(work, row + DET_U), du),
            pressure(load4(work, row + Z), load(work, row + DET_Z), dz)))
    return pressed


@numba.njit(**PLAIN)
def aim_direction(G, groups, work, group, state, aim, weighted):
    """Begin the corrector's right side: complementarity shall become ``aim`` and the weights."""
    for j in range(6):
        store(state, DLAMBDA + j, -load(state, BALANCE + j))
    for g in range(0, group.shape[0], GROUP):
        slack, nu = load(group, g + SLACK), load(group, g + NU)
        second = 0.0 * aim if weighted else load(group, g + DSLACK) * load(group, g + DNU)
        change = (aim - second) / nu - slack
        store(group, g + CHANGE, change)
        store(group, g + DNU, change - load(group, g + RESIDUE))
    alpha, z_alpha = load(state, ALPHA), load(state, Z_ALPHA)
    second = load(state, D_ALPHA) * load(state, DZ_ALPHA)
    store(state, FREE_ALPHA,
          (aim - second - alpha * load(state, DUAL_ALPHA)) / z_alpha - alpha)
    for i in range(len(groups)):
        row, g = i * CONTACT, groups[i] * GROUP
        q = aimed_change(work, row, aim + 2.0 * load(work, row + WEIGHT), False)
        store4(work, row + Q, q)
        r = squared(
            load4(work, row + POINT), load(work, row + SIZE), load4(work, row + DUAL))
        f = (r[0] - q[0], r[1] - q[1], r[2] - q[2], r[3] - q[3])
        add_wrench(G, i * 24, f, state, DLAMBDA)
        store(group, g + DNU, load(group, g + DNU) - f[0])


@numba.njit(**PLAIN)
def advance(G, groups, work, group, state, moves, step, sense, loaded):
    """
    Take the step in the lanes that ``moves`` names, and refresh all residuals.

    Returns
    -------
    (primal, dual, gap, distance, upper, margin) : largest residuals; complementarity's distance
        from the weights, as the sum over the cones and as the largest of any coordinate; what
        lambda proves of the largest alpha, and by how much it proves the load to be out of reach

    """
    for j in range(6):
        x = load(state, LAMBDA + j)
        store(state, LAMBDA + j, choose(moves, x + step * load(state, DLAMBDA + j), x))
    x, z = load(state, ALPHA), load(state, Z_ALPHA)
    alpha = choose(moves, x + step * load(state, D_ALPHA), x)
    z_alpha = choose(moves, z + step * load(state, DZ_ALPHA), z)
    store(state, ALPHA, alpha)
    store(state, Z_ALPHA, z_alpha)
    gap = alpha * z_alpha
    distance = gap
    along = 0.0 * gap
    for j in range(6):
        task = load(state, TASK + j)
        store(state, BALANCE + j, load(state, LOAD + j) - task * alpha)
        along += load(state, LAMBDA + j) * task
    dual_alpha = along - sense - z_alpha
    store(state, DUAL_ALPHA, dual_alpha)
    dual = size_of(dual_alpha)
    for g in range(0, group.shape[0], GROUP):
        slack, nu = load(group, g + SLACK), load(group, g + NU)
        slack = choose(moves, slack + step * load(group, g + DSLACK), slack)
        nu = choose(moves, nu + step * load(group, g + DNU), nu)
        store(group, g + SLACK, slack)
        store(group, g + NU, nu)
        store(group, g + RESIDUE, 1.0 - slack)
        store(group, g + WORTH, 0.0)
        gap += slack * nu
        distance = most(distance, slack * nu)
    for i in range(len(groups)):
        row, g = i * CONTACT, groups[i] * GROUP
        h = transposed(G, i * 24, state, LAMBDA)
        u, du = load4(work, row + U), load4(work, row + DU)
        u = (choose(moves, u[0] + step * du[0], u[0]), choose(moves, u[1] + step * du[1], u[1]),
             choose(moves, u[2] + step * du[2], u[2]), choose(moves, u[3] + step * du[3], u[3]))
        z, dz = load4(work, row + Z), load4(work, row + DZ)
        z = (choose(moves, z[0] + step * dz[0], z[0]), choose(moves, z[1] + step * dz[1], z[1]),
             choose(moves, z[2] + step * dz[2], z[2]), choose(moves, z[3] + step * dz[3], z[3]))
        rest = (load(group, g + NU) - z[0] - h[0], -z[1] - h[1], -z[2] - h[2], -z[3] - h[3])
        store4(work, row + U, u)
        store4(work, row + Z, z)
        store4(work, row + DUAL, rest)
        add_wrench(G, i * 24, u, state, BALANCE)
        store(group, g + RESIDUE, load(group, g + RESIDUE) - u[0])
        dual = most(most(size_of(rest[0]), size_of(rest[1])),
                    most(most(size_of(rest[2]), size_of(rest[3])), dual))
        product = size_of(u[0] * z[0] + u[1] * z[1] + u[2] * z[2] + u[3] * z[3]
                          - 2.0 * load(work, row + WEIGHT))
        gap += product
        distance = most(distance, most(product, most(
            size_of(u[0] * z[1] + z[0] * u[1]), most(
                size_of(u[0] * z[2] + z[0] * u[2]), size_of(u[0] * z[3] + z[0] * u[3])))))
        worth = h[0] + root(h[1] * h[1] + h[2] * h[2] + h[3] * h[3])
        store(group, g + WORTH, most(worth, load(group, g + WORTH)))
    primal = 0.0 * gap
    for j in range(6):
        primal = most(size_of(load(state, BALANCE + j)), primal)
    upper, square = 0.0 * gap, 0.0 * gap
    for g in range(0, group.shape[0], GROUP):
        primal = most(size_of(load(group, g + RESIDUE)), primal)
        upper += load(group, g + WORTH)
    margin = 0.0 * gap - 1.0
    if loaded:
        for j in range(6):
            x = load(state, LAMBDA + j)
            upper += x * load(state, LOAD + j)
            square += x * x
        margin = choose(along < 0.0, margin, -upper / (root(square) * load(state, REACH)))
    return primal, dual, gap, distance, choose(along > 0.0, upper / along, math.inf), margin


@numba.njit(**PLAIN)
def take(lane, block, task, load_, reach, least_cap, weights, groups, same, G, curvature, work,
         group, state, sense):
    """Put a problem into a lane: on the cones' axes, inside the bound, residuals included."""
    k = len(groups)
    for g in range(0, group.shape[0], GROUP):
        group[g + SLACK, lane] = 0.5
        group[g + NU, lane] = 1.0
        group[g + RESIDUE, lane] = 0.0
        group[g + WORTH, lane] = 0.0  # counts the members meanwhile
    for i in range(k):
        group[groups[i] * GROUP + WORTH, lane] += 1.0
    for j in range(6):
        state[TASK + j, lane] = task[j]
        state[LOAD + j, lane] = load_[j]
        state[LAMBDA + j, lane] = 0.0
        state[BALANCE + j, lane] = load_[j] - 0.5 * task[j]
    state[ALPHA, lane] = 0.5
    state[Z_ALPHA, lane] = 1.0
    state[DUAL_ALPHA, lane] = -sense - 1.0
    state[REACH, lane] = reach
    square = 0.0
    for j in range(6):
        square += load_[j] * load_[j]
    state[BALANCED, lane] = max(math.sqrt(square), SMALL_CAP * least_cap)
    largest = 0.0
    gap = 0.5
    for _ in range(0, group.shape[0], GROUP):
        gap += 0.5
    for i in range(k):
        row = i * CONTACT
        for r in range(DU + 8):
            work[row + r, lane] = 0.0
        normal = 0.5 / group[groups[i] * GROUP + WORTH, lane]
        work[row + U, lane] = normal
        work[row + Z, lane] = 1.0
        work[row + WEIGHT, lane] = weights[i]
        largest = max(largest, weights[i])
        gap += abs(normal - 2.0 * weights[i])
        for j in range(6):
            state[BALANCE + j, lane] += normal * block[i, 0, j]
    state[LARGEST, lane] = largest
    if not same:
        for i in range(k):
            for c in range(4):
                for j in range(6):
                    G[i * 24 + 6 * c + j, lane] = block[i, c, j]
            entry = i * 21
            for j in range(6):
                for p in range(j + 1):
                    curvature[entry, lane] = (
                        block[i, 1, j] * block[i, 1, p] + block[i, 2, j] * block[i, 2, p]
                        + block[i, 3, j] * block[i, 3, p] - block[i, 0, j] * block[i, 0, p])
                    entry += 1
    return gap


@numba.njit(**PLAIN)
def keep(lane, groups, work, group, state, back):
    """Put a lane's iterate aside, or take it back: numbers may get worse before the end."""
    for i in range(len(groups)):
        for row in range(i * CONTACT, i * CONTACT + 4):
            if back:
                work[row + U, lane] = work[row + KEPT, lane]
            else:
                work[row + KEPT, lane] = work[row + U, lane]
    for g in range(0, group.shape[0], GROUP):
        if back:
            group[g + NU, lane] = group[g + KEPT_NU, lane]
        else:
            group[g + KEPT_NU, lane] = group[g + NU, lane]
    for j in range(6):
        if back:
            state[LAMBDA + j, lane] = state[KEPT_LAMBDA + j, lane]
        else:
            state[KEPT_LAMBDA + j, lane] = state[LAMBDA + j, lane]
    if back:
        state[ALPHA, lane] = state[KEPT_ALPHA, lane]
    else:
        state[KEPT_ALPHA, lane] = state[ALPHA, lane]


@numba.njit(**PLAIN)
def give(lane, groups, work, group, state, loaded, share, multipliers, nu):
    """Read a lane's answer, scaled back into the bound exactly; return alpha."""
    used = 1.0
    for g in range(0, group.shape[0], GROUP):
        group[g + WORTH, lane] = 0.0
    for i in range(len(groups)):
        row = groups[i] * GROUP + WORTH
        group[row, lane] += work[i * CONTACT + U, lane]
        used = max(used, group[row, lane])
    inverse = 1.0 / used
    for i in range(len(groups)):
        for c in range(4):
            share[i, c] = work[i * CONTACT + U + c, lane] * inverse
    for j in range(6):
        multipliers[j] = state[LAMBDA + j, lane]
    for g in range(len(nu)):
        nu[g] = group[g * GROUP + NU, lane]
    return state[ALPHA, lane] if loaded else state[ALPHA, lane] * inverse


@numba.njit(nogil=True, cache=True, **PLAIN)
def solve_many(blocks: Array, which: Ints, groups: Ints, group_count: int, tasks: Array,
               loads: Array, reaches: Array, least_caps: Array, sense: float, weights: Array,
               alphas: Array, shares: Array, multipliers: Array, nus: Array, status: Codes) -> int:
    """
    Largest or smallest alpha of N task wrenches, or their weighted centres of eq. (11).

    Releases Python's lock. What is not solved keeps its last lambda, which may prove that no
    forces balance the load.

    Parameters
    ----------
    blocks : (M, k, 4, 6) array
        Scaled grasp matrices, one contact a block, rows n, t1, t2, m_n.
    which : (N,) int64 array
        Grasp of each problem.
    groups : (k,) int64 array
        Group of each contact, from 0; the caps' shares of a group sum to one at most.
    group_count : int
        Number of groups.
    tasks, loads : (N, 6) arrays
        Scaled task wrenches, of norm one, and external wrenches.
    reaches : (M,) array
        a0 of each grasp, the natural size of alpha.
    least_caps : (M,) array
        Smallest cap of each grasp as a share of its largest.
    sense : float
        1 for the largest alpha, -1 for the smallest.
    weights : (N, k) array
        Barrier weight of each contact's log det; zero for the optimum itself. (1, k) for all.
    alphas : (N,) array
        Alpha of each task afterwards, in its scaled unit.
    shares : (N, k, 4) array
        Contacts' variables n, t1, t2, m_n afterwards, inside the bound.
    multipliers : (N, 6) array
        lambda afterwards.
    nus : (N, groups) array
        The bound's multipliers afterwards.
    status : (N,) int8 array
        SOLVED, INFEASIBLE or STALLED afterwards.

    Returns
    -------
    Total of iterations.

    """
    count, k = len(which), len(groups)
    if not count:
        return 0
    G, curvature = np.empty((k * 24, WIDTH)), np.empty((k * 21, WIDTH))
    work, group = np.empty((k * CONTACT, WIDTH)), np.empty((group_count * GROUP, WIDTH))
    state = np.zeros((STATE, WIDTH))
    gaps = np.empty((2, WIDTH))
    problem, held, age = np.empty(WIDTH, np.int64), np.full(WIDTH, -1), np.zeros(WIDTH, np.int64)
    loaded, weighted = False, False
    for i in range(count):
        for j in range(6):
            loaded = loaded or loads[i, j] != 0.0
    for i in range(weights.shape[0]):
        for j in range(k):
            weighted = weighted or weights[i, j] > 0.0
    following, busy, kept, total = 0, 0, 0, 0
    for lane in range(WIDTH):
        n = min(lane, count - 1)
        m = which[n]
        gaps[0, lane] = take(
            lane, blocks[m], tasks[n], loads[n], reaches[m], least_caps[m],
            weights[min(n, len(weights) - 1)], groups, False, G, curvature, work, group, state,
            sense)
        problem[lane], held[lane] = n, m
        if lane < count:
            busy |= 1 << lane
            following += 1
    cones = 1.0 / (k + group_count + 1.0)
    while busy:
        factor_schur(G, curvature, groups, work, group, state, weighted)
        pressed = direction(G, groups, work, group, state)
        step = 1.0 / most(pressed, 1.0)
        gap = load(gaps, 0)
        rest = 1.0 - step
        aim = rest * rest * rest * gap * cones
        if weighted:
            forget(groups, work, group, state)
        aim_direction(G, groups, work, group, state, aim, weighted)
        step = 1.0 / most(direction(G, groups, work, group, state) * (1.0 / STEP_SHARE), 1.0)
        store(gaps, 1, length(state, DLAMBDA))
        good = (step > SHORTEST_STEP) & (load(gaps, 1) < math.inf)
        primal, dual, gap, distance, upper, margin = advance(
            G, groups, work, group, state, good, step, sense, loaded)
        store(gaps, 0, gap)
        reach, alpha = load(state, REACH), load(state, ALPHA)
        natural = most(alpha, 1e-2 * reach)
        accepted = reach < 0.0
        solved = primal <= RESIDUAL * least(reach, 1e2 * most(alpha, load(state, BALANCED)))
        if weighted:
            solved = solved & (dual <= RESIDUAL) & (
                distance <= WEIGHTED_GAP * most(natural, load(state, LARGEST)))
        elif sense > 0.0:
            # alpha beyond its bound is an error of equilibrium in disguise
            near = (upper - alpha <= ACCEPTED * most(alpha, 1e-3 * reach)) & (
                alpha - upper <= 2.0 * RESIDUAL * reach)
            accepted = near & (primal <= 2.0 * RESIDUAL * reach)
            level = RELATIVE_GAP * natural
            solved = (solved & near & ((upper - alpha <= level) | (
                (gap <= level) & (dual <= RESIDUAL)))) | (
                    accepted & (gap <= LEAST_GAP * natural))
        else:
            solved = solved & (dual <= RESIDUAL) & (gap <= RELATIVE_GAP * natural)
        done, out = bits(solved), bits(margin > INFEASIBLE_MARGIN)
        alive, enough = bits(good & (gap < math.inf)), bits(accepted)
        for lane in range(WIDTH):
            flag = 1 << lane
            if not busy & flag:
                continue
            total += 1
            age[lane] += 1
            if not (done | out) & flag and alive & flag and age[lane] < MAX_ITERATIONS:
                if enough & flag:
                    keep(lane, groups, work, group, state, False)
                    kept |= flag
                continue
            n = problem[lane]
            status[n] = INFEASIBLE if out & flag else STALLED
            if (done | enough) & flag:
                status[n] = SOLVED
            elif kept & flag:
                status[n] = SOLVED
                keep(lane, groups, work, group, state, True)
            elif not alive & flag and gaps[1, lane] < math.inf:
                # no way to go: then the direction itself proves, if anything does
                for j in range(6):
                    state[LAMBDA + j, lane] = state[DLAMBDA + j, lane]
            alphas[n] = give(lane, groups, work, group, state, loaded, shares[n],
                             multipliers[n], nus[n])
            kept &= ~flag
            if following < count:
                n = following
                m = which[n]
                following += 1
                gaps[0, lane] = take(
                    lane, blocks[m], tasks[n], loads[n], reaches[m], least_caps[m],
                    weights[min(n, len(weights) - 1)], groups, held[lane] == m, G, curvature,
                    work, group, state, sense)
                problem[lane], held[lane], age[lane] = n, m, 0
            else:
                busy &= ~flag
    return total


@numba.njit(**PLAIN)
def forget(groups, work, group, state):
    """Leave the second-order term out of the corrector."""
    for i in range(len(groups)):
        for row in range(DU, DU + 8):
            store(work, i * CONTACT + row, 0.0)
    store(state, D_ALPHA, 0.0)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Where each variable and each equation of the conic program stands.

A layout depends on the contacts' models, the groups of the force bound, the number of joints and
the kind of virtual contact, not on any number, and is made once for each such pattern. Variables,
in order: slacks of the groups and of the joint limits, a single virtual variable, frictionless
normals (all non-negative), one second-order cone a contact, the cone of the virtual contact, and
for the l2 bound the cone of all normals.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

from grasp_quality.arrays import Array, Ints
import numpy as np

CONE_ORDER = (2, 0, 1, 3)  # axis first: n, t1, t2, m_n
Cones = tuple[tuple[str, int], ...]


@dataclass(frozen=True, eq=False)
class Layout:
    """
    Index arrays of one pattern; made by ``layout_of``.

    Attributes
    ----------
    groups : tuple of int
        Group of the bound that each contact belongs to; empty for l2.
    cones : tuple of (str, int)
        'nonnegative' or 'second_order', and dimension, in the order of u.
    virtual : (t,) int array
        Variables of the virtual contact.
    contact_variables, contact_source : (m,) int arrays
        Variables of the contacts, and the place of each in the flattened (k, 4) coordinates.
    source : (entries,) int array
        For each entry of an equilibrium row, its column in [scaled G, virtual columns].
    row_columns, row_starts : int arrays
        Sparsity of E, row by row: variables of the stored entries, and where each row begins.
    bound_entries, bound_right : arrays
        Stored entries and right sides of the bound's equations, which are constants.
    joint_sources : two (entries,) int arrays
        For each entry of an upper, and of a summed row of a joint, its place in the joint's line
        of coefficients: those of the flattened (k, 4) coordinates, of a slack, and of a common
        press in either row.
    shape : (int, int)
        Equations and variables.
    contact_count, joint_count : int

    """

    groups: tuple[int, ...]
    cones: Cones
    virtual: Ints
    contact_variables: Ints
    contact_source: Ints
    source: Ints
    row_columns: Ints
    row_starts: Ints
    bound_entries: Array
    bound_right: Array
    joint_sources: tuple[Ints, ...]
    shape: tuple[int, int]
    contact_count: int
    joint_count: int

    @cached_property
    def blocks(self) -> Ints:
        """Variables of every cone (blocks, d), one a row, axis first, padded with -1."""
        rows, start = [], 0
        for kind, size in self.cones:
            members = list(range(start, start + size))
            rows += [members] if kind == 'second_order' else [[v] for v in members]
            start += size
        width = max(len(row) for row in rows)
        return np.array([row + [-1] * (width - len(row)) for row in rows])

    def shares(self, u: Array) -> Array:
        """Contact part of u as shares [t1/mu, t2/mu, n, m_n/gamma] / f_max, (k, 4)."""
        shares = np.zeros((self.contact_count, 4))
        shares.ravel()[self.contact_source] = u[self.contact_variables]
        return shares

    def contact_multipliers(self, multipliers: Array) -> Array:
        """Multiplier nu of the bound for every contact (k,), from those of all equations."""
        if self.groups:
            return multipliers[6:][list(self.groups)]
        return multipliers[7:7 + self.contact_count]

    def worths(self, multipliers: Array) -> Array:
        """Worth of the equilibrium and, signed, of the joints (6 + j,), from all multipliers."""
        if not self.joint_count:
            return multipliers[:6]
        return np.concatenate([multipliers[:6], multipliers[-2 * self.joint_count:][
            :self.joint_count]])

    def joint_spreads(self, multipliers: Array) -> Array:
        """Sum of the multipliers of both limits of each joint, (j,)."""
        upper, both = multipliers[-2 * self.joint_count:].reshape(2, -1)
        return np.maximum(upper + 2.0 * both, np.abs(upper))


@lru_cache(maxsize=256)
def layout_of(active: bytes, groups: tuple[int, ...], is_l2: bool, virtual_size: int,
              virtual_is_cone: bool, role: str, joint_count: int = 0) -> Layout:
    """
    Lay a pattern out.

    Parameters
    ----------
    active : bytes
        (k, 4) bools: which local coordinates [t1, t2, n, m_n] each contact can transmit.
    groups : tuple of int
        Group of each contact.
    is_l2 : bool
        Whether the bound is one cone over all normals instead of group sums.
    virtual_size : int
        Number of variables of the virtual contact.
    virtual_is_cone : bool
        Whether these are a second-order cone, axis first, instead of half lines.
    role : str
        'task': the virtual contact takes part in equilibrium only. 'pressing': its first variable
        is also a normal force common to all contacts, as a share of their caps. 'widening': it
        takes no part in equilibrium; the bound is its value instead of one.
    joint_count : int
        Joints with a torque limit. Each has two slacks p, q and two rows: its torque + p at the
        upper limit, and p + q the way between the limits.

    """
    coordinates = [[j for j in CONE_ORDER if row[j]]
                   for row in np.frombuffer(active, dtype=bool).reshape(-1, 4)]
    next_variable = 0

    def take(count: int) -> range:
        nonlocal next_variable
        next_variable += count
        return range(next_variable - count, next_variable)

    slacks = take(0 if is_l2 else max(groups) + 1)
    joints = [take(2) for _ in range(joint_count)]
    virtual = range(0) if virtual_is_cone else take(virtual_size)
    variables = {i: take(1) for i, c in enumerate(coordinates) if len(c) == 1}
    cones = [('nonnegative', next_variable)]
    for i, c in enumerate(coordinates):
        if len(c) > 1:
            variables[i] = take(len(c))
            cones.append(('second_order', len(c)))
    if virtual_is_cone:
        virtual = take(virtual_size)
        cones.append(('second_order', virtual_size))
    if is_l2:
        norm_cone = take(1 + len(coordinates))
        cones.append(('second_order', len(norm_cone)))

    # (variable, column in [G, virtual]) of an equilibrium row
    entries = [(v, 4 * i + j) for i, c in enumerate(coordinates) for v, j in zip(variables[i], c)]
    contact_entries = sorted(entries)
    if role != 'widening':
        entries += [(v, 4 * len(coordinates) + t) for t, v in enumerate(virtual)]
    entries.sort()

    # rows of the bound: ({variable: coefficient}, right side)
    right = 0.0 if role == 'widening' else 1.0
    widen = {virtual[0]: -1.0} if role == 'widening' else {}
    rows: list[tuple[dict[int, float], float]] = []
    if is_l2:
        rows.append(({norm_cone[0]: 1.0, **widen}, right))
        for i in range(len(coordinates)):
            press = {virtual[0]: 1.0} if role == 'pressing' else {}
            rows.append(({variables[i][0]: 1.0, norm_cone[1 + i]: -1.0, **press}, 0.0))
    for g, slack in enumerate(slacks):
        members = [i for i, group in enumerate(groups) if group == g]
        press = {virtual[0]: float(len(members))} if role == 'pressing' else {}
        rows.append((
            {slack: 1.0, **{variables[i][0]: 1.0 for i in members}, **press, **widen}, right))
    ordered = [(sorted(row.items()), right) for row, right in rows]

    size = 4 * len(coordinates)
    pressing = [(virtual[0], size + 1)] if role == 'pressing' else []
    upper = [[(p, size), *sorted(pressing + contact_entries)] for p, _ in joints]
    pressing = [(virtual[0], size + 2)] if role == 'pressing' else []
    both = [[(p, size), (q, size), *pressing] for p, q in joints]

    lengths = [len(entries)] * 6 + [
        *(len(row) for row, _ in ordered), *map(len, upper), *map(len, both)]
    equilibrium_columns = [v for v, _ in entries] * 6
    return Layout(
        groups=() if is_l2 else groups,
        cones=tuple(cone for cone in cones if cone[1]),
        virtual=np.array(virtual),
        contact_variables=np.array([v for v, _ in contact_entries]),
        contact_source=np.array([source for _, source in contact_entries]),
        source=np.array([source for _, source in entries]),
        row_columns=np.array(equilibrium_columns + [
            *(v for row, _ in ordered for v, _ in row),
            *(v for row in [*upper, *both] for v, _ in row)]),
        row_starts=np.concatenate([[0], np.cumsum(lengths)]),
        bound_entries=np.array([value for row, _ in ordered for _, value in row]),
        bound_right=np.array([right for _, right in ordered]),
        joint_sources=tuple(np.array([source for _, source in kind[0]]) for kind in (
            (upper, both) if joints else ())),
        shape=(len(lengths), next_variable),
        contact_count=len(coordinates), joint_count=joint_count)

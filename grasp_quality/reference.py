# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The same problems stated a second time, plainly, in CVXPY: the reference that tests compare with.

Physical units, one norm cone a contact, one constraint a rule, nothing shared with ``problem``,
``layout`` or ``proof``. Also the place to start from for constraints of one's own:

    stated = state_task_wrench(grasp, wrench)
    cp.Problem(stated.problem.objective, stated.problem.constraints + [...]).solve()

CVXPY is needed by this module alone; it is too slow for the live path (docs/performance.md).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cvxpy as cp
from grasp_quality.arrays import Array
from grasp_quality.contact import Contact
from grasp_quality.grasp import Grasp
from grasp_quality.task import TaskCone
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike

Numbers = Any  # ArrayLike, or an Expression of CVXPY, which has no types
SOLVER_SETTINGS = {
    'solver': cp.CLARABEL, 'tol_gap_abs': 1e-9, 'tol_gap_rel': 1e-9, 'tol_feas': 1e-9}


@dataclass(frozen=True, eq=False)
class Statement:
    """
    A problem of CVXPY with its variables.

    Attributes
    ----------
    grasp : Grasp
    problem : cvxpy.Problem
    forces : (k, 4) cvxpy.Variable [N, N, N, N m]
        [t1, t2, n, m_n] in the contact frames, finger on object.
    value : cvxpy.Variable
        alpha, the (3,) coordinates of a task cone, the peak or the margin.

    """

    grasp: Grasp
    problem: cp.Problem
    forces: cp.Variable
    value: cp.Variable

    def solve(self, **settings: Any) -> bool:
        """Solve with tight tolerances, which ``settings`` override; True when optimal."""
        self.problem.solve(**{**SOLVER_SETTINGS, **settings})
        return bool(self.problem.status == cp.OPTIMAL)


def state_task_wrench(grasp: Grasp, wrench: Numbers, external_wrench: Numbers = None,
                      barrier_weight: float = 0.0) -> Statement:
    """
    State eq. (11): maximise alpha + eps sum_i log det P_i(x_i) with G x + F_ext = alpha F.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    wrench : (6,) array_like or cvxpy.Parameter [N, N m]
        F, about the object frame's origin.
    external_wrench : (6,) array_like or cvxpy.Parameter [N, N m], optional
        F_ext, likewise; zero if None.
    barrier_weight : float
        eps >= 0, in the unit of alpha.

    Returns
    -------
    Statement, ``value`` is alpha

    """
    forces, alpha = cp.Variable((len(grasp), 4)), cp.Variable(nonneg=True)
    objective = alpha
    if barrier_weight > 0.0:
        objective = alpha + barrier_weight * sum(
            _log_det(c, x) for c, x in zip(grasp.contacts, forces))
    return Statement(grasp, cp.Problem(cp.Maximize(objective), [
        _wrench(grasp, forces) + _load(external_wrench) == alpha * _numbers(wrench),
        *_cones(grasp, forces),
        *_joints(grasp, forces),
        *_bound(grasp, forces[:, 2], 1.0)]), forces, alpha)


def state_task_cone(grasp: Grasp, task: TaskCone,
                    external_wrench: ArrayLike | None = None) -> Statement:
    """
    State a task cone (section IV): the farthest wrench along its axis that stays inside it.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    task : TaskCone
        Axis, laterals and half angle, about the object frame's origin.
    external_wrench : (6,) array_like [N, N m], optional
        F_ext, about the object frame's origin; zero if None.

    Returns
    -------
    Statement, ``value`` (3,) holds alpha_z and the coordinates along the laterals

    """
    forces, value = cp.Variable((len(grasp), 4)), cp.Variable(3)
    directions = np.stack([task.axis, task.lateral_x, task.lateral_y])
    return Statement(grasp, cp.Problem(cp.Maximize(value[0]), [
        _wrench(grasp, forces) + _load(external_wrench) == value @ directions,
        cp.norm(value[1:]) <= np.tan(task.half_angle) * value[0],
        *_cones(grasp, forces),
        *_joints(grasp, forces),
        *_bound(grasp, forces[:, 2], 1.0)]), forces, value)


def state_minimum_forces(grasp: Grasp, external_wrench: ArrayLike) -> Statement:
    """
    State the dual problem (section III): the smallest forces with G x + F_ext = 0.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    external_wrench : (6,) array_like [N, N m]
        F_ext, about the object frame's origin.

    Returns
    -------
    Statement, ``value`` is the peak: what the force bound must be widened to

    """
    forces, peak = cp.Variable((len(grasp), 4)), cp.Variable(nonneg=True)
    return Statement(grasp, cp.Problem(cp.Minimize(peak), [
        _wrench(grasp, forces) + _load(external_wrench) == 0,
        *_cones(grasp, forces),
        *_joints(grasp, forces),
        *_bound(grasp, forces[:, 2], peak)]), forces, peak)


def state_force_closure(grasp: Grasp) -> Statement:
    """
    State the internal force with the largest margin: |(t/mu, m_n/gamma)| <= n - margin f_max.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.

    Returns
    -------
    Statement, ``value`` is the margin

    """
    forces, margin = cp.Variable((len(grasp), 4)), cp.Variable(nonneg=True)
    return Statement(grasp, cp.Problem(cp.Maximize(margin), [
        _wrench(grasp, forces) == 0,
        *_cones(grasp, forces, margin),
        *_joints(grasp, forces, margin),
        *_bound(grasp, forces[:, 2], 1.0)]), forces, margin)


def _wrench(grasp: Grasp, forces: cp.Variable) -> cp.Expression:
    """G x (6,), eq. (4)."""
    return grasp.matrix.reshape(6, -1) @ cp.vec(forces, order='C')


def _load(external_wrench: Numbers) -> Array | cp.Expression:
    return np.zeros(6) if external_wrench is None else _numbers(external_wrench)


def _numbers(wrench: Numbers) -> Array | cp.Expression:
    return wrench if isinstance(wrench, cp.Expression) else as_wrench(wrench)


def _parts(contact: Contact, x: cp.Expression) -> tuple[list[cp.Expression], list[cp.Expression]]:
    """Friction part (t1/mu, t2/mu, m_n/gamma) of a force, and its components that must be zero."""
    mu, gamma = contact.effective_friction, contact.effective_torsional_friction
    parts = [(x[0], mu), (x[1], mu), (x[3], gamma)]
    return [part / size for part, size in parts if size > 0.0], [
        part for part, size in parts if size == 0.0]


def _cones(grasp: Grasp, forces: cp.Variable,
           margin: cp.Variable | float = 0.0) -> list[cp.Constraint]:
    """Eq. (1) to (3): the friction cone of every contact, pulled in by ``margin`` f_max."""
    constraints = []
    for contact, x in zip(grasp.contacts, forces):
        carried, absent = _parts(contact, x)
        normal = x[2] - margin * contact.max_normal_force
        constraints.append(cp.norm(cp.hstack(carried)) <= normal if carried else normal >= 0)
        constraints += [part == 0 for part in absent]
    return constraints


def _joints(grasp: Grasp, forces: cp.Variable,
            margin: cp.Variable | float = 0.0) -> list[cp.Constraint]:
    """|T x + tau_g| <= (1 - margin) tau_max of every joint that has a limit."""
    limits = grasp.joint_limits
    if limits is None:
        return []
    torques = limits.torque_matrix.reshape(len(limits.max_torques), -1) @ cp.vec(
        forces, order='C') + limits.gravity_torques
    return [cp.abs(torques) <= (1.0 - margin) * limits.max_torques]


def _log_det(contact: Contact, x: cp.Expression) -> cp.Expression:
    """Return log det P_i up to a constant: log(n^2 - |friction|^2), or log n without it."""
    carried, _ = _parts(contact, x)
    if not carried:
        return cp.log(x[2])
    # n^2 - |part|^2 = n (n - |part|^2 / n), both factors concave
    # (the sum is over one term: quad_over_lin comes back with shape (1,) from some CVXPY)
    return cp.log(x[2]) + cp.log(x[2] - cp.sum(cp.quad_over_lin(cp.hstack(carried), x[2])))


def _bound(grasp: Grasp, normals: cp.Expression, size: cp.Variable | float) -> list[cp.Constraint]:
    """Bound the normals: the sum of n_i / f_max,i over each group, or the norm of all."""
    shares = cp.multiply(normals, 1.0 / grasp.max_normal_forces)
    if grasp.bound == 'l2':
        return [cp.norm(shares) <= size]
    return [cp.sum(shares[np.flatnonzero(np.equal(grasp.groups, group))]) <= size
            for group in sorted(set(grasp.groups))]

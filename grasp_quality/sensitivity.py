# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the multipliers say about single contacts: worth of friction, and which one limits the task.

``h`` (k, 4) is G_i^T lambda - T_i^T mu of every contact, in the coordinates [t1, t2, n, m_n]: what
a force is worth to the task, less what it costs the joints (docs/derivations.md).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grasp_quality.arrays import Array, frozen
from grasp_quality.contact import ContactModel
from grasp_quality.grasp import Grasp
from grasp_quality.wrench import cross, skew
import numpy as np

if TYPE_CHECKING:
    from grasp_quality.problem import ConicProblem
    from grasp_quality.solution import Solution

NEGLIGIBLE = 1e-6  # share of alpha below which a cap is worth nothing to the task
LEAST = 1e-3  # of a0: a smaller alpha counts as this much
ALIKE = 1e-3  # share by which two limits may differ in worth and still count as alike


def friction_worth(grasp: Grasp, h: Array) -> Array:
    """Worth of the friction part of each contact at normal force one, (k,)."""
    t1, t2, _, moment = (h * grasp.scales).T
    worth: Array = np.sqrt(t1 * t1 + t2 * t2 + moment * moment)
    return worth


def friction_slope(grasp: Grasp, h: Array) -> Array:
    """Slope of the worth of each contact by mu at normal force one, (k,); 0 in an FPC contact."""
    mu, along = grasp.scales[:, 0], friction_worth(grasp, h)
    square = h[:, 0] ** 2 + h[:, 1] ** 2
    slope = np.divide(mu * square, along, where=along > 0.0, out=np.sqrt(square))
    if not mu.all():  # no friction yet, or a model that has none
        slope *= [m is not ContactModel.FPC for m in grasp.contacts.models]
    return slope


def limited_by(solution: Solution) -> dict[str, str]:
    """
    Find what limits the task most: contacts, or joints, by name, with the reason of each.

    Those whose limits carry the largest part of alpha; several where they carry it alike, none
    where alpha hangs on no limit. 'slip': what a cap is worth it is worth mostly through friction;
    'cap': through the normal force; 'joint': it is the limit of a torque. A tighter limit takes
    that part from alpha, or more ('l1' and 'l2' aside). What a wider one gives may be nothing
    where others hold alpha too, or for the smallest step only: ``explain`` solves for that.

    """
    grasp, joints = solution.grasp, solution.grasp.joint_limits
    worth = solution.dalpha_dmax_force * grasp.max_normal_forces
    if joints is not None:
        worth = np.append(worth, solution.dalpha_dmax_torque * joints.max_torques)
    most = float(worth.max())
    if not most > NEGLIGIBLE * max(solution.alpha, LEAST * solution.size):
        return {}
    return {name_of(grasp, i): reason(grasp, solution.local_multipliers, i)
            for i in np.flatnonzero(worth >= (1.0 - ALIKE) * most).tolist()}


def name_of(grasp: Grasp, i: int) -> str:
    """Name of a contact, or of a joint counted on behind them."""
    if i < len(grasp) or grasp.joint_limits is None:
        return grasp.name_of(i)
    return grasp.joint_limits.names[i - len(grasp)]


def reason(grasp: Grasp, h: Array, i: int) -> str:
    """Tell whether friction is most of what a stronger press of contact i is worth."""
    if i >= len(grasp):
        return 'joint'
    return 'slip' if friction_worth(grasp, h)[i] >= abs(h[i, 2]) else 'cap'


def local_worth(grasp: Grasp, multiplier: Array, joint_multiplier: Array) -> Array:
    """Worth h (k, 4) of every contact's local force, from those of wrench (6,) and joints (j,)."""
    # about the contacts' centre, where nothing cancels: a wrench's worth moves like a velocity
    worth = multiplier.copy()
    worth[:3] += skew(worth[3:]) @ grasp.center
    h = (worth @ grasp.centered_matrix.reshape(6, -1)).reshape(-1, 4)
    if grasp.joint_limits is None:
        return h
    price: Array = np.einsum('j,jki->ki', joint_multiplier, grasp.joint_limits.torque_matrix)
    return h - price


def position_slope(solution: Solution) -> Array:
    """
    Slope of alpha by the position of each contact (k, 3) [1/m] in object axes: lambda . dG x.

    A force f at p does the work lambda_t . (p x f), whose slope by p is f x lambda_t.

    """
    force, _ = _in_object(solution)
    return cross(force, solution.multiplier[3:])


def rotation_slope(solution: Solution) -> Array:
    """
    Slope of alpha by small turns of each contact frame about object axes (k, 3) [1/rad].

    The local forces turn with the frame: d f = w x f does work along v = lambda_f + lambda_t x p,
    and so does the moment along lambda_t.

    """
    grasp, turn = solution.grasp, solution.multiplier[3:]
    at_center = solution.multiplier[:3] + cross(turn, grasp.center)
    along = at_center + cross(turn, grasp.positions - grasp.center)
    force, moment = _in_object(solution)
    return cross(force, along) + cross(moment, turn)


def _in_object(solution: Solution) -> tuple[Array, Array]:
    """Return forces and moments (k, 3) of the slopes, in object axes; zero if infeasible."""
    grasp, local = solution.grasp, solution.reference_forces
    if not len(local):
        return np.zeros((len(grasp), 3)), np.zeros((len(grasp), 3))
    force = np.einsum('kij,kj->ki', grasp.rotations, local[:, :3])
    return force, grasp.rotations[:, :, 2] * local[:, 3:]


def dimensional_multiplier(problem: ConicProblem, multiplier: Array) -> Array:
    """Turn a scaled lambda (6,) into d alpha / d F_ext about the object frame's origin."""
    grasp = problem.grasp
    worth = multiplier * (problem.virtual.unit / grasp.force_scale)
    worth[3:] /= grasp.lever_arm
    worth[:3] -= skew(worth[3:]) @ grasp.center
    return frozen(worth)

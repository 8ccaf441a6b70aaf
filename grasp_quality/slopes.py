# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Slopes of alpha by everything about a contact that somebody could change, to either side.

Where alpha is smooth both sides are the derivative that the multipliers give. At a kink they are
differences of alpha itself, of second order, over steps that are small against the grasp.
"""

from collections.abc import Callable
from dataclasses import dataclass

from grasp_quality.contact import ContactModel, FARTHEST
from grasp_quality.contact_set import ContactSet
from grasp_quality.grasp import Grasp
from grasp_quality.problem import build_problem
from grasp_quality.solution import Solution
from grasp_quality.solve import prove_optimal
from grasp_quality.task import TaskCone, TaskWrench
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
STEP = 1e-4  # of lever arm, radian, cap or friction coefficient, for differences at a kink
RESOLUTION = 1e-8  # share of alpha that a solved alpha can be told to
FIELDS = ('max_force', 'friction', 'position', 'rotation')


@dataclass(frozen=True, eq=False)
class Slopes:
    """
    Slopes of alpha to one side, of every contact.

    Attributes
    ----------
    max_force : (k,) array [1/N]
        By the cap f_max.
    friction : (k,) array [-]
        By the Coulomb coefficient; 0 in an FPC contact.
    position : (k, 3) array [1/m]
        By moving the contact along t1, t2 and n of its own frame, which is not turned by it; nor
        do the torques change that its local forces need of the joints.
    rotation : (k, 3) array [1/rad]
        By turning the contact frame about its own t1, t2 and n, in its place.

    """

    max_force: Array
    friction: Array
    position: Array
    rotation: Array


def smooth_slopes(solution: Solution) -> Slopes:
    """Return the derivatives that the multipliers give."""
    R = solution.grasp.rotations
    return Slopes(solution.dalpha_dmax_force, solution.dalpha_dfriction,
                  np.einsum('kij,ki->kj', R, solution.dalpha_dposition),
                  np.einsum('kij,ki->kj', R, solution.dalpha_drotation))


def one_sided_slopes(alpha: Callable[[Grasp], float], grasp: Grasp,
                     noise: float = 0.0) -> tuple[Slopes, Slopes]:
    """
    Return slopes (forward, backward) as differences of ``alpha``, a function of a grasp.

    Differences up to ``noise`` count as none.

    """
    here, k = alpha(grasp), len(grasp)
    sides = []
    for sign in (1.0, -1.0):
        found = {}
        for field in FIELDS:
            values = np.zeros((k, 3 if field in ('position', 'rotation') else 1))
            for i, axis in np.ndindex(*values.shape):
                h = sign * step_of(grasp, i, field)
                if h != 0.0 and can_step(grasp, i, field, 2.0 * h):
                    near, far = (alpha(changed(grasp, i, field, n * h, axis)) for n in (1, 2))
                    rise = 2.0 * near - 1.5 * here - 0.5 * far
                    if abs(rise) > max(RESOLUTION * here, noise):
                        values[i, axis] = rise / h
            found[field] = values if values.shape[1] == 3 else values[:, 0]
        sides.append(Slopes(**found))
    return sides[0], sides[1]


def step_of(grasp: Grasp, i: int, field: str) -> float:
    """Step in a field of contact i that is small against the grasp; 0 where it has no effect."""
    if field == 'position':
        return STEP * float(grasp.lever_arm)
    if field == 'rotation':
        return STEP
    if field == 'max_force':
        return STEP * float(grasp.max_normal_forces[i])
    if grasp.contacts.models[i] is ContactModel.FPC:
        return 0.0
    return STEP * float(grasp.contacts.friction[i] or 1.0)


def can_step(grasp: Grasp, i: int, field: str, h: float) -> bool:
    """Whether a contact can be changed by h: neither friction below 0 nor out of the world."""
    if field == 'position':
        return float(np.abs(grasp.positions[i]).max()) + abs(h) <= FARTHEST
    return field != 'friction' or float(grasp.contacts.friction[i]) + h >= 0.0


def changed(grasp: Grasp, i: int, field: str, h: float, axis: int = 0) -> Grasp:
    """
    Return a grasp with one contact changed.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    i : int
        Index of the contact.
    field : str
        'max_force' [N], 'friction' [-], 'position' [m] or 'rotation' [rad].
    h : float
        Change, in the unit of the field.
    axis : int
        0, 1, 2: t1, t2, n of the contact frame, for positions and rotations.

    """
    return changed_along(grasp, i, field, h * np.eye(3)[axis])


def changed_along(grasp: Grasp, i: int, field: str, change: Array) -> Grasp:
    """Return a grasp with one contact changed by a vector (3,) in its frame, or its first."""
    contacts = grasp.contacts
    arrays = {name: np.array(getattr(contacts, name)) for name in (
        'positions', 'rotations', 'friction', 'max_normal_forces')}
    R = contacts.rotations[i]
    if field == 'position':
        arrays['positions'][i] += R @ change
    elif field == 'rotation':
        arrays['rotations'][i] = R @ turn(change)
    else:
        arrays['friction' if field == 'friction' else 'max_normal_forces'][i] += change[0]
    return Grasp(ContactSet(
        arrays['positions'], arrays['rotations'], contacts.models, arrays['friction'],
        contacts.torsional_friction, arrays['max_normal_forces'], contacts.names,
        contacts.fingers), grasp.bound, grasp.joint_limits)


def turn(vector: Array) -> Array:
    """Rotation matrix (3, 3) of a rotation vector (3,) [rad] (Rodrigues' formula)."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * K + (1.0 - np.cos(angle)) * K @ K)


def largest_alpha(task: TaskWrench | TaskCone, external_wrench: ArrayLike | None,
                  limit: TimeLimit | None) -> Callable[[Grasp], float]:
    """Return the function that gives the largest alpha of a task on a grasp; 0 if infeasible."""
    def alpha(grasp: Grasp) -> float:
        problem = build_problem(grasp, task, external_wrench)
        optimum = prove_optimal(problem, limit)
        return 0.0 if optimum is None else float(optimum.values[0]) * problem.virtual.unit
    return alpha

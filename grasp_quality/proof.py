# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The proof that goes with every answer, computed apart from the solver.

From any multipliers (lambda for equilibrium, nu for the bound, mu for the joints) weak duality
gives an upper bound of the objective, once they are made exactly feasible: nu is recomputed from
lambda and mu through the support functions of the cones, and all are scaled until the virtual
contact's condition holds (docs/derivations.md). From the forces come the equilibrium residual, the
largest cone usage and the use of the bound and of the joints' limits. An answer counts only when
``Proof.holds``. What the compiled kernel answers is judged by ``judge``; the rest here, in numpy.
"""

from dataclasses import dataclass
import math

from grasp_quality import bounds, friction_cone, judge, kernel_solver
from grasp_quality.arrays import Array, frozen
from grasp_quality.grasp import Grasp
from grasp_quality.problem import ConicProblem
import numpy as np

GAP_TOLERANCE = 1e-6       # of max(objective, 1e-3 a0)
ZERO_TOLERANCE = 2e-3 * GAP_TOLERANCE  # of a0: a bound that a proof does not tell from zero
RESIDUAL_TOLERANCE = 1e-8  # of the caps' total, torques over the lever arm
IMBALANCE_TOLERANCE = 1e-6  # of the task's or the load's own size
USAGE_TOLERANCE = 1e-9     # over a cone usage, or a use of the bound, of one
FREE_TASK = 1e-8  # share of the multipliers by which a task's worth may fall below zero
JOINT_TOLERANCE = 1e-8  # over a use of a torque limit of one
SMALL_CAP = 1e-2  # share of the smallest cap that counts as something to balance
NO_JOINTS = frozen(np.zeros(0))
ROUNDING = 1e-12  # share of a cap that may stand outside its cone unseen


@dataclass(frozen=True, eq=False)
class Proof:
    """
    Evidence for one answer, in the scaled units of its problem.

    Attributes
    ----------
    objective, upper : float
        Value that the forces reach, and a bound that no forces can exceed.
    residual : float
        |G x + F_ext - alpha F| as a share of the caps' total or of the load (``judge.HEAVY``).
    cone_usage : (k,) array
        Share of each friction cone in use, down to rounding.
    imbalance : float
        The same residual as a share of what is balanced: the larger of task and load, or a
        hundredth of the smallest cap. Keeps small fingers honest; no matter to a common press.
    bound_usage : float
        How much of the force bound the normals take.
    multiplier : (6,) array
        lambda, the worth of equilibrium, made exactly feasible.
    bound_multiplier : (k,) array
        nu of each contact's group (for l2 of each contact).
    size : float
        Natural size of the objective, a0.
    joint_usage : (j,) array
        How much of each joint's torque limit the forces and gravity take.
    joint_multiplier : (j,) array
        Signed worth of each joint's torque, in scaled units.

    """

    objective: float
    upper: float
    residual: float
    imbalance: float
    cone_usage: Array
    bound_usage: float
    multiplier: Array
    bound_multiplier: Array
    size: float
    joint_usage: Array
    joint_multiplier: Array

    @property
    def usage(self) -> float:
        """Largest cone usage of a contact."""
        return float(self.cone_usage.max())

    @property
    def gap(self) -> float:
        """Upper bound minus objective, as a share of max(objective, 1e-3 a0)."""
        return (self.upper - self.objective) / max(abs(self.objective), 1e-3 * self.size)

    @property
    def holds(self) -> bool:
        """Whether the forces are admissible and the gap is within tolerance."""
        return bool(self.gap <= GAP_TOLERANCE and self.admissible)

    @property
    def admissible(self) -> bool:
        """Whether residual and use of cones, bound and joints are within tolerance."""
        return bool(
            self.residual <= RESIDUAL_TOLERANCE and self.imbalance <= IMBALANCE_TOLERANCE
            and self.usage <= 1.0 + USAGE_TOLERANCE
            and self.bound_usage <= 1.0 + USAGE_TOLERANCE
            and self.joint_usage.max(initial=0.0) <= 1.0 + JOINT_TOLERANCE)

    def __str__(self) -> str:
        """State these numbers in one line."""
        return (f'gap {self.gap:.2g}, residual {self.residual:.2g}, usage {self.usage:.12g}, '
                f'use of the bound {self.bound_usage:.12g}, of the joints '
                f'{self.joint_usage.max(initial=0.0):.12g}')


def prove(problem: ConicProblem, shares: Array, values: Array, multipliers: Array) -> Proof:
    """
    Judge an answer.

    Parameters
    ----------
    problem : ConicProblem
        Program that the answer belongs to.
    shares : (k, 4) array
        Local contact forces [t1/mu, t2/mu, n, m_n/gamma] as shares of the caps.
    values : (t,) array
        Variables of the virtual contact.
    multipliers : (equations,) array
        The solver's lambda, and its nu behind it; anything is allowed here, a bad one gives a bad
        bound.

    Returns
    -------
    Proof

    """
    if kernel_solver.handles(problem) and problem.virtual.objective[0] > 0.0:
        return _judged(problem, shares, values, np.array(multipliers[:6]))
    grasp, virtual = problem.grasp, problem.virtual
    nu, multipliers = multipliers, problem.layout.worths(multipliers)
    _, per_contact, bound_total = worth_of(grasp, multipliers)
    if virtual.role == 'pressing':  # here the least nu is not always the best
        per_contact = np.maximum(per_contact, problem.layout.contact_multipliers(nu))
        bound_total = bounds.support(per_contact, grasp.bound, grasp.groups)
    slack = _virtual_slack(problem, multipliers, per_contact, bound_total)
    upper = float(multipliers[:6] @ problem.scaled_external_wrench)
    joints = grasp.joint_rows
    if joints is not None:
        spreads = np.abs(multipliers[6:])
        if virtual.role == 'pressing':
            spreads = problem.layout.joint_spreads(nu)
            slack += float(joints.pressing @ multipliers[6:] + joints.b @ spreads)
        upper += joints.cost(multipliers[6:], spreads)
    if virtual.role != 'widening':
        upper += bound_total
    scale = 1.0
    if virtual.objective[0] > 0.0:
        scale = 1.0 / slack if slack > 0.0 else np.inf
    elif slack < -1.0:
        scale = -1.0 / slack
    if scale < np.inf:
        upper, multipliers, per_contact = upper * scale, multipliers * scale, per_contact * scale
    else:
        upper = np.inf
    if virtual.role == 'task' and virtual.objective[0] < 0.0 and upper > 0.0:
        # least alpha >= 0: no multipliers at all bound it by zero, without their rounding
        upper, multipliers, per_contact = 0.0, np.zeros_like(multipliers), np.zeros(len(grasp))
    if virtual.role == 'task' and virtual.objective[0] > 0.0:
        values = held(values, upper)
    load, widening = problem.scaled_external_wrench, virtual.role == 'widening'
    allowed = values[0] if widening else 1.0
    applied: Array | float = 0.0 if widening else virtual.columns @ values
    balance = grasp.scaled_matrix.reshape(6, -1) @ shares.ravel() + load - applied
    press = values[0] if virtual.role == 'pressing' else 0.0
    used = bounds.gauge(shares[:, 2] + press, grasp.bound, grasp.groups)
    heaviest = judge.HEAVY * problem.reach if virtual.objective[0] > 0.0 else np.inf
    left = math.sqrt(balance @ balance)
    balanced = math.sqrt(max(float(load @ load), float(np.vdot(applied, applied))))
    return Proof(
        objective=float(virtual.objective @ values), upper=float(upper),
        residual=left / max(problem.reach * allowed, min(math.sqrt(load @ load), heaviest)),
        imbalance=left / max(balanced, SMALL_CAP * grasp.least_cap) * (virtual.role != 'pressing'),
        cone_usage=friction_cone.usage_of_shares(shares, unloaded=ROUNDING),
        bound_usage=used / allowed if allowed > 0.0 else float(used > 0.0) * np.inf,
        multiplier=frozen(multipliers[:6]), bound_multiplier=frozen(per_contact),
        size=1.0 if virtual.role != 'task' else problem.reach,
        joint_usage=NO_JOINTS if joints is None else frozen(joints.usage(shares, press)),
        joint_multiplier=frozen(multipliers[6:]))


def _judged(problem: ConicProblem, shares: Array, values: Array, multiplier: Array) -> Proof:
    """Judge an answer to a question for the largest alpha of one wrench, by ``judge``."""
    grasp = problem.grasp
    block, _, groups = grasp.blocks
    per_group, usage = np.empty(max(grasp.groups) + 1), np.empty(len(grasp))
    alpha, upper, scale, residual, imbalance, _, used = judge.judge(
        block, groups, problem.virtual.columns[:, 0].copy(), problem.scaled_external_wrench.copy(),
        problem.reach, grasp.least_cap, float(values[0]), shares[:, (2, 0, 1, 3)].copy(order='C'),
        multiplier, SMALL_CAP, ROUNDING, per_group, usage)
    return Proof(
        objective=alpha, upper=upper, residual=residual, imbalance=imbalance, cone_usage=usage,
        bound_usage=used, multiplier=frozen(multiplier * scale), size=problem.reach,
        bound_multiplier=frozen(per_group[groups] * scale), joint_usage=NO_JOINTS,
        joint_multiplier=NO_JOINTS)


def held(values: Array, upper: float) -> Array:
    """Values of a task with the first between zero and its bound, the others in proportion."""
    first = max(0.0, min(float(values[0]), float(upper)))
    return values * (first / values[0]) if first > 0.0 else np.zeros(len(values))


def worth_of(grasp: Grasp, multipliers: Array) -> tuple[Array, Array, float]:
    """
    Value what each contact can do along a scaled lambda.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    multipliers : (6,) array, or (6 + j,) with joint limits
        lambda, and the signed worth of the joints' torques, which forces have to pay for.

    Returns
    -------
    (k,) array : support function of each contact's cone at its cap
    (k,) array : smallest feasible multiplier nu of its bound
    float : support function of the wrench space, sigma_W(lambda)

    """
    h = (multipliers @ grasp.work_matrix).reshape(-1, 4)
    worth = friction_cone.support(h, 1.0)
    useful = np.maximum(worth, 0.0)
    if grasp.bound in ('linf', 'l2'):
        per_contact = useful
    elif grasp.bound == 'l1':
        per_contact = np.full(len(useful), useful.max())
    else:
        per_contact = bounds.group_maxima(useful, grasp.groups)[list(grasp.groups)]
    return worth, per_contact, bounds.support(worth, grasp.bound, grasp.groups)


def _virtual_slack(problem: ConicProblem, multipliers: Array, per_contact: Array, total: float
                   ) -> float:
    """Left side of the virtual contact's dual condition: axis minus norm of the rest."""
    virtual = problem.virtual
    if virtual.role == 'widening':
        return -total
    along = multipliers[:6] @ virtual.columns
    if virtual.is_cone:
        return float(along[0]) - math.sqrt(along[1:] @ along[1:])
    if virtual.role == 'pressing':
        # the other variables are tasks, alpha >= 0: a lambda that gains by one bounds nothing
        size = max(np.abs(multipliers[:6]).max(), per_contact.max())
        free = (along[1:] < -FREE_TASK * size).any()
        return -np.inf if free else float(along[0] + per_contact.sum())
    return float(along[0])

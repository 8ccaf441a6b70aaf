# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The barrier term of eq. (11): friction margin bought with alpha.

    maximise alpha + eps sum_i log det P_i(x_i)   over the real contacts

log det P_i is log(n^2 - |(t1/mu, t2/mu, m_n/gamma)|^2), or log n without friction, up to a
constant. The proof is the Lagrangian dual of this objective in closed form (docs/derivations.md).
alpha_upper, the sensitivities and the feasible interval stay those of eps = 0, so that
alpha_upper - alpha is the price of the margin.
"""

import dataclasses
from functools import partial
from typing import cast

from grasp_quality import friction_cone, kernel_solver
from grasp_quality.arrays import Array, Bools, frozen
from grasp_quality.bounds import gauge, support
from grasp_quality.centering import weighted_center
from grasp_quality.exceptions import SolverError
from grasp_quality.grasp import Grasp
from grasp_quality.problem import assemble, ConicProblem, VirtualContact
from grasp_quality.proof import GAP_TOLERANCE, held, Proof, prove
from grasp_quality.solution import Solution
from grasp_quality.solve import prove_optimal, task_share
from grasp_quality.status import Status
from grasp_quality.time_limit import Limit, TimeLimit
import numpy as np

# weights of what eq. (11) gives none; a cone's edge is only as sharp as rounding, which goes by
# eps
NO_WEIGHT_LINE = 1e-13
NO_WEIGHT_CONE = 1e-9
NEGLIGIBLE = 1e-8          # share of a0 below which the task counts as not served at all
INTERIOR_TOLERANCE = 1e-8  # share of the caps below which a force is not strictly inside
CONE_GENERATORS = 16       # of a task cone, where only its polyhedral inside can be asked


def with_margin(problem: ConicProblem, solution: Solution, barrier_weight: float,
                time_limit_s: Limit = None) -> Solution:
    """
    Trade alpha of a solved task for friction margin.

    Parameters
    ----------
    problem : ConicProblem
        Of a task wrench or cone.
    solution : Solution
        Its feasible answer at eps = 0.
    barrier_weight : float
        eps > 0, in the unit of alpha.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    Solution; the given one with status OPTIMAL_NO_INTERIOR where no strictly interior force exists

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    grasp, unit = problem.grasp, problem.virtual.unit
    eps = barrier_weight / unit
    limit = TimeLimit.of(time_limit_s)
    center = _center(
        problem, eps, solution.alpha_upper / unit > NEGLIGIBLE * problem.reach, limit)
    if center is not None:
        shares, values, multipliers = center
        values = held(values, solution.alpha_upper / unit)
        forces = frozen(shares * grasp.force_units)
        proof = prove(problem, shares, values, multipliers)
        objective = values[0] + eps * _log_det(grasp, shares).sum()
        upper = objective_upper(problem, multipliers, eps, cast(Proof, solution.proof))
        gap = (upper - objective) / max(values[0], eps, 1e-3 * proof.size)
        if gap <= GAP_TOLERANCE and dataclasses.replace(proof, upper=proof.objective).holds:
            alpha, wrench = task_share(problem, values, solution.alpha_upper)
            return dataclasses.replace(
                solution, alpha=alpha, alpha_lower=min(solution.alpha_lower, alpha),
                forces=forces, wrench=wrench,
                cone_usage=frozen(friction_cone.usage_of_shares(shares)),
                proof=dataclasses.replace(
                    proof, objective=float(objective), upper=float(upper),
                    size=max(eps, proof.size)),
                barrier_weight=barrier_weight)
    if not has_interior(problem, limit):
        return dataclasses.replace(
            solution, status=Status.OPTIMAL_NO_INTERIOR, barrier_weight=barrier_weight)
    raise SolverError(
        f'no answer could be proved at barrier_weight {barrier_weight:g}: choose another weight, '
        'or 0', problem, 'centering failed' if center is None else f'gap {gap:.2g}, {proof}')


def _frictional(grasp: Grasp) -> Bools:
    frictional: Bools = np.any(grasp.scales[:, (0, 1, 3)] > 0.0, axis=1)
    return frictional


def _log_det(grasp: Grasp, shares: Array) -> Array:
    return friction_cone.log_det(shares, (grasp.scales > 0.0).astype(np.float64))


def _center(problem: ConicProblem, eps: float, with_task: bool,
            limit: TimeLimit | None) -> tuple[Array, Array, Array] | None:
    """
    Find the weighted centre: forces as shares (k, 4), values (t,) and multipliers, or None.

    A task that cannot be served at all leaves alpha no interior, and is left out: alpha is 0.

    """
    grasp = problem.grasp
    found = None
    if with_task and kernel_solver.handles(problem):
        weights = np.where(_frictional(grasp), 1.0, 0.5) * eps
        answer = kernel_solver.run(problem, limit, weights)
        if answer.solved:
            found = answer.shares, answer.values, answer.multipliers
    found = found or _general_center(problem, eps, with_task, limit)
    if found is None:
        return None
    shares, values, multipliers = found
    excess = max(1.0, gauge(shares[:, 2], grasp.bound, grasp.groups))
    if grasp.joint_rows is not None:
        excess = max(excess, grasp.joint_rows.shrinkage(shares))
    return shares / excess, values, multipliers


def _general_center(problem: ConicProblem, eps: float, with_task: bool,
                    limit: TimeLimit | None) -> tuple[Array, Array, Array] | None:
    """Weighted centre of any problem, by ``centering``."""
    layout = problem.layout
    blocks = layout.blocks  # (blocks, d), -1 where padded
    if not with_task:
        blocks = blocks[~np.isin(blocks[:, 0], layout.virtual)]
    padded = blocks < 0
    E = np.where(padded, 0.0, problem.E[:, blocks])
    c = np.where(padded, 0.0, problem.c[blocks])
    is_line = padded[:, 1:].all(axis=1)
    # the logarithm of a half line is half of its log det as a cone
    weights = np.where(
        np.isin(blocks[:, 0], layout.contact_variables), np.where(is_line, 0.5, 1.0) * eps,
        np.where(is_line, NO_WEIGHT_LINE, NO_WEIGHT_CONE * max(1.0, eps)))
    found = weighted_center(E, problem.e, c, weights,
                            on_step=None if limit is None else partial(limit.remaining_s, problem))
    if found is None:
        return None
    u = np.zeros(layout.shape[1])
    u[blocks[~padded]] = found[0][~padded]
    return layout.shares(u), u[layout.virtual], found[1]


def objective_upper(problem: ConicProblem, multipliers: Array, eps: float, proof: Proof) -> float:
    """
    Bound the objective of eq. (11), in scaled units, by its Lagrangian dual in closed form.

    With s_i = (nu_i - h_n, -h_rest), h = G_i^T lambda - T_i^T mu, every contact contributes
    eps (log(4 eps^2 / det s_i) - 2), or eps (log(eps / s_i) - 1) without friction; any lambda with
    lambda . F >= 1 gives a bound, and so does any nu that keeps every s_i inside its cone. What
    lambda . F lacks of one is made up with the multipliers of eps = 0.

    Parameters
    ----------
    problem : ConicProblem
        The task without the barrier term.
    multipliers : (equations,) array
        lambda, in scaled units, and the multipliers of the bound's equations behind it.
    eps : float
        Barrier weight over the unit of alpha.
    proof : Proof
        Of the answer at eps = 0.

    """
    grasp, columns = problem.grasp, problem.virtual.columns
    nu = np.maximum(problem.layout.contact_multipliers(multipliers), 0.0)
    along = multipliers[:6] @ columns
    missing = max(0.0, 1.0 - along[0] + np.sqrt(along[1:] @ along[1:]))
    worths = problem.layout.worths(multipliers) + missing * np.concatenate(
        [proof.multiplier, proof.joint_multiplier])
    lambda_, mu = worths[:6], worths[6:]
    nu = nu + missing * proof.bound_multiplier
    h = (worths @ grasp.work_matrix).reshape(-1, 4)
    rest = np.sqrt(h[:, 0] ** 2 + h[:, 1] ** 2 + h[:, 3] ** 2)
    s = nu - h[:, 2]
    if not (s > rest).all():
        return np.inf
    frictional = _frictional(grasp)
    each = np.where(frictional, np.log(4.0 * eps ** 2 / ((s - rest) * (s + rest))) - 2.0,
                    np.log(eps / s) - 1.0)
    joints = 0.0 if grasp.joint_rows is None else grasp.joint_rows.cost(mu, np.abs(mu))
    upper: float = (
        support(nu, grasp.bound, grasp.groups) + lambda_ @ problem.scaled_external_wrench
        + joints + eps * each.sum())
    return upper


def has_interior(problem: ConicProblem, time_limit_s: Limit = None) -> bool:
    """
    Tell whether some force strictly inside all cones serves the task, alpha >= 0 left open.

    A task cone is asked through ``CONE_GENERATORS`` wrenches of its surface, so that a force which
    exists only between them and the surface is missed.

    """
    grasp, columns = problem.grasp, problem.virtual.columns
    if problem.virtual.is_cone:
        angles = np.linspace(0.0, 2.0 * np.pi, CONE_GENERATORS, endpoint=False)
        columns = columns @ np.stack([np.ones_like(angles), np.cos(angles), np.sin(angles)])
    normals = grasp.scaled_matrix[:, :, 2].sum(axis=1, keepdims=True)
    objective = np.zeros(1 + columns.shape[1])
    objective[0] = 1.0
    pressing = VirtualContact(
        np.concatenate([-normals, columns], axis=1), False, objective, role='pressing')
    optimum = prove_optimal(assemble(grasp, pressing, problem.external_wrench), time_limit_s)
    return optimum is not None and optimum.values[0] > INTERIOR_TOLERANCE

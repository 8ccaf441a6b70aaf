# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The admissible forces nearest to given ones.

    minimise sum_i |x_i - y_i|^2   subject to   E u = e,   u in K

in newtons, a soft finger's moment counted as m_n / gamma; the alpha of a task is left open. A
convex quadratic program, which Clarabel takes as it stands. Its answer is proved like any other.
"""

from dataclasses import dataclass

import clarabel
from grasp_quality.bounds import gauge
from grasp_quality.clarabel_solver import ATTEMPTS, CONES, run_matrices, solver_settings
from grasp_quality.exceptions import SolverError
from grasp_quality.problem import ConicProblem
from grasp_quality.proof import Proof, prove
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, diags_array, eye_array, vstack

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NearestForces:
    """
    Admissible forces with their proof.

    Attributes
    ----------
    shares : (k, 4) array
        Local forces [t1/mu, t2/mu, n, m_n/gamma] as shares of the caps.
    values : (t,) array
        Variables of the virtual contact, in its scaled units.
    proof : Proof
        Of equilibrium, cones and bounds; its gap means nothing here.

    """

    shares: Array
    values: Array
    proof: Proof


def distances(problem: ConicProblem, shares: Array, others: Array) -> Array:
    """Distance [N] of the forces of each contact (k,), moments counted as m_n / gamma."""
    return np.asarray(np.linalg.norm((shares - others) * _newtons(problem), axis=1))


def nearest_forces(problem: ConicProblem, shares: Array,
                   limit: TimeLimit | None = None) -> NearestForces | None:
    """
    Find the admissible forces nearest to given ones.

    Parameters
    ----------
    problem : ConicProblem
        Of a task, whose alpha is free; one that has no columns stays at zero.
    shares : (k, 4) array
        Given forces as shares [t1/mu, t2/mu, n, m_n/gamma] / f_max, anywhere.
    limit : TimeLimit, optional
        Of the question that this is part of.

    Returns
    -------
    NearestForces, or None when no forces are admissible

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    layout, size = problem.layout, problem.layout.shape[1]
    place = layout.contact_source
    weights, target = np.zeros(size), np.zeros(size)
    newtons = np.broadcast_to(_newtons(problem) / problem.grasp.force_scale, shares.shape)
    weights[layout.contact_variables] = newtons.ravel()[place] ** 2
    target[layout.contact_variables] = shares.ravel()[place]
    linear = -weights * target
    if not problem.virtual.columns.any():
        linear[layout.virtual] = 1.0
    P = csc_matrix(diags_array(weights))
    A = csc_matrix(vstack([csc_matrix(problem.E), -eye_array(size)]))
    b = np.concatenate([problem.e, np.zeros(size)])
    cones = [clarabel.ZeroConeT(len(problem.e)), *(CONES[kind](n) for kind, n in problem.cones)]
    said = ''
    for attempt in reversed(range(len(ATTEMPTS))):  # the sharpest first
        settings = solver_settings(
            attempt, None if limit is None else limit.remaining_s(problem))
        _, u, said = run_matrices(P, linear, A, b, cones, settings, problem)
        if said == 'PrimalInfeasible':
            return None
        if said == 'Solved':
            answer = proved(problem, layout.shares(u), u[layout.virtual])
            if answer is not None:
                return answer
    raise SolverError(f'no nearest forces could be proved; the solver said: {said}', problem, said)


def proved(problem: ConicProblem, shares: Array, values: Array) -> NearestForces | None:
    """Return forces with their proof, once they are brought exactly into cones and bound."""
    rest = np.sqrt((shares[:, (0, 1, 3)] ** 2).sum(axis=1))
    pressed = np.maximum(shares[:, 2], rest)  # what lies outside by the solver's tolerance
    shares = np.column_stack([shares[:, :2], pressed, shares[:, 3]])
    shares = shares / max(1.0, gauge(pressed, problem.grasp.bound, problem.grasp.groups))
    proof = prove(problem, shares, values, np.zeros(problem.layout.shape[0]))
    return NearestForces(shares, values, proof) if proof.admissible else None


def _newtons(problem: ConicProblem) -> Array:
    """Newtons (k, 4) that a share of one stands for, of a moment those of m_n / gamma."""
    return np.asarray(problem.grasp.force_units / np.where(
        np.arange(4) < 3, 1.0, np.where(problem.grasp.scales > 0.0, problem.grasp.scales, 1.0)))

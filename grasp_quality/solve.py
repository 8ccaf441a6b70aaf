# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Solve: a conic program to an answer with its proof.

``prove_optimal`` runs solvers until an answer passes the proof or proves infeasibility; an
answer that does neither, "almost solved" included, is a SolverError. ``solve`` turns that into the
Solution of a task.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import dataclasses
from typing import TypeVar

from grasp_quality import clarabel_solver, friction_cone, kernel_solver
from grasp_quality.arguments import require_made
from grasp_quality.arrays import Array, frozen
from grasp_quality.bounds import gauge
from grasp_quality.exceptions import SolverError
from grasp_quality.grasp import Grasp
from grasp_quality.infeasibility import infeasibility_margin, INFEASIBILITY_TOLERANCE
from grasp_quality.problem import ConicProblem, NO_WRENCH
from grasp_quality.proof import (
    GAP_TOLERANCE, held, NO_JOINTS, Proof, prove, ZERO_TOLERANCE)
from grasp_quality.raw_answer import RawAnswer
from grasp_quality.sensitivity import dimensional_multiplier
from grasp_quality.solution import ConeSolution, NO_FORCES, NO_USAGE, Solution
from grasp_quality.status import Status
from grasp_quality.time_limit import Limit, TimeLimit
import numpy as np

Answer = TypeVar('Answer', bound=Solution)


@dataclasses.dataclass(frozen=True, eq=False)
class Optimum:
    """
    A proved answer.

    ``shares`` (k, 4) of the contacts' caps, ``values`` (t,) of the virtual contact, ``proof``.

    """

    shares: Array
    values: Array
    proof: Proof


def prove_optimal(problem: ConicProblem, time_limit_s: Limit = None) -> Optimum | None:
    """
    Solve a conic program until the proof holds.

    Parameters
    ----------
    problem : ConicProblem
        Program in scaled standard form.
    time_limit_s : float, optional
        Of all attempts together [s].

    Returns
    -------
    Optimum, or None when the problem is proved infeasible

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    return first_proved(problem, _answers(problem, TimeLimit.of(time_limit_s)))


def first_proved(problem: ConicProblem, answers: Iterable[RawAnswer]) -> Optimum | None:
    """Return the first Optimum of RawAnswers, or None at the first proof that there is none."""
    said = []
    for answer in answers:
        if answer.solved:
            optimum = _optimum(problem, answer)
            if optimum.proof.holds:
                return optimum
            said.append(f'{answer.status} with {optimum.proof}')
        else:  # whatever the solver calls it, a direction that separates proves infeasibility
            margin = infeasibility_margin(
                problem, problem.layout.worths(answer.multipliers))
            if margin > INFEASIBILITY_TOLERANCE:
                return None
            said.append(f'{answer.status} with margin {margin:.2g}')
    raise SolverError(
        'no answer could be proved; the solver said: ' + '; '.join(said), problem, said[-1])


def _answers(problem: ConicProblem, limit: TimeLimit | None) -> Iterator[RawAnswer]:
    """Ask one solver after the other: the kernel where it knows the problem, then Clarabel."""
    if kernel_solver.handles(problem):
        yield kernel_solver.run(problem, limit)
    for attempt in range(len(clarabel_solver.ATTEMPTS)):
        yield clarabel_solver.run(problem, attempt, limit)


def _optimum(problem: ConicProblem, answer: RawAnswer) -> Optimum:
    grasp, role = problem.grasp, problem.virtual.role
    values, shares = answer.values, answer.shares
    # the solver holds the equations to its tolerance only; the bound shall hold exactly
    press = values[0] if role == 'pressing' else 0.0
    used = gauge(shares[:, 2] + press, grasp.bound, grasp.groups)
    if grasp.joint_rows is not None:
        excess = grasp.joint_rows.shrinkage(shares, press)
        if role == 'widening':
            shares, used = shares / excess, used / excess
        else:
            used = max(used, excess)
    if role == 'widening':
        values = np.array([used])
    elif used > 1.0:
        shares = shares / used
        if role == 'pressing' or not problem.external_wrench.any():
            values = values / used
    return Optimum(shares, values, prove(problem, shares, values, answer.multipliers))


def solve(problem: ConicProblem, time_limit_s: Limit = None) -> Solution:
    """
    Solve the conic program of a task wrench or a task cone.

    Parameters
    ----------
    problem : ConicProblem
        From ``build_problem``.
    time_limit_s : float, optional
        [s]

    Returns
    -------
    Solution (ConeSolution for a cone, without alpha_axis and alpha_worst filled in)

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_made(problem, ConicProblem, 'problem', 'build_problem(grasp, task)')
    time_limit_s = TimeLimit.of(time_limit_s)
    grasp, virtual = problem.grasp, problem.virtual
    kind = ConeSolution if virtual.is_cone else Solution
    optimum = prove_optimal(problem, time_limit_s)
    if optimum is None:
        return infeasible(kind, grasp)
    proof, unit = optimum.proof, virtual.unit
    alpha, wrench = task_share(problem, optimum.values, proof.upper * unit)
    loaded = bool(problem.external_wrench.any()) or not grasp.rests
    lower, holdable = _lower_end(problem, alpha, time_limit_s) if loaded else (0.0, True)
    # without a load only alpha = 0 can come of a wrench that the grasp does not span
    suspect = loaded or alpha <= GAP_TOLERANCE * proof.size * unit
    pinned = suspect and not virtual.is_cone and not grasp.spans(virtual.wrenches[0])
    forces = frozen(optimum.shares * grasp.force_units)
    is_loaded = optimum.shares[:, 2] > friction_cone.UNLOADED
    return kind(
        grasp=grasp, status=Status.OPTIMAL, alpha=alpha,
        alpha_upper=max(proof.upper * unit, alpha), alpha_lower=lower, holdable=holdable,
        pinned=pinned, wrench=wrench,
        forces=forces, cone_usage=frozen(np.where(is_loaded, proof.cone_usage, 0.0)),
        proof=proof, multiplier=dimensional_multiplier(problem, proof.multiplier),
        bound_multiplier=frozen(proof.bound_multiplier * unit),
        reference_forces=forces, joint_multiplier=_joint_multiplier(problem, proof),
        size=proof.size * unit)


def task_share(problem: ConicProblem, values: Array, alpha_upper: float) -> tuple[float, Array]:
    """Alpha and the wrench (6,) that it stands for, held between zero and its upper bound."""
    applied = held(values * problem.virtual.unit, alpha_upper)
    return float(applied[0]), frozen(applied @ problem.virtual.wrenches)


def infeasible(kind: type[Answer], grasp: Grasp) -> Answer:
    """Answer that no forces inside cones and caps balance the external wrench with the task."""
    return kind(
        grasp=grasp, status=Status.INFEASIBLE, alpha=0.0, alpha_upper=0.0, alpha_lower=0.0,
        holdable=False, pinned=False, wrench=NO_WRENCH, forces=NO_FORCES, cone_usage=NO_USAGE,
        proof=None, multiplier=NO_WRENCH, bound_multiplier=frozen(np.zeros(len(grasp))),
        reference_forces=NO_FORCES, joint_multiplier=frozen(
            np.zeros(len(grasp.joint_limits or ()))))


def _joint_multiplier(problem: ConicProblem, proof: Proof) -> Array:
    """Return d alpha / d tau of each joint (j,) [1/(N m)], signed."""
    joints = problem.grasp.joint_rows
    return NO_JOINTS if joints is None else frozen(
        proof.joint_multiplier * (problem.virtual.unit / joints.units))


def _lower_end(problem: ConicProblem, alpha: float, time_limit_s: Limit) -> tuple[float, bool]:
    """Smallest feasible alpha >= 0 and whether it is zero; the problem is known to be feasible."""
    downward = dataclasses.replace(problem, virtual=dataclasses.replace(
        problem.virtual, objective=-problem.virtual.objective))
    optimum = prove_optimal(downward, time_limit_s)
    unit = problem.virtual.unit
    if optimum is None:  # feasible upward and infeasible downward: a load at the very edge
        return alpha, False
    lower = min(max(float(optimum.values[0]), 0.0) * unit, alpha)
    load = problem.scaled_external_wrench
    # against the load's own size, as far as a proof to 1e-9 a0 can tell it from zero
    noise = max(GAP_TOLERANCE * float(np.sqrt(load @ load)), ZERO_TOLERANCE * problem.reach)
    if lower <= unit * noise:
        return 0.0, True
    return lower, False

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The same question to other solvers: ECOS, and Clarabel from scratch, as CVXPY states it.

The messages are read by the parts of ``force_audit`` and scaled here, so that nothing but the
statement in ``grasp_quality.reference`` is shared with what answered. A reference that does not
end with "optimal" or "infeasible" says nothing; a difference counts when both solvers see one.
"""

from collections.abc import Mapping
import enum
from typing import Any
import warnings

from benchmarks.fuzz.asking import Answer
from benchmarks.fuzz.cases import Case, LIVE
from benchmarks.fuzz.dual_bound import lever_arm
from benchmarks.fuzz.judging import GAP, limits_of, received, result_of
import cvxpy as cp
from grasp_quality import Contact, ContactModel, Grasp, JointLimits, reference
from grasp_quality.node_settings import Settings
from grasp_quality_hand.audit_messages import six, xyz
from grasp_quality_hand.force_rules import Array, Limits
from grasp_quality_msgs.msg import ResultCode
import numpy as np

SOLVERS = ((cp.ECOS, {'abstol': 1e-10, 'reltol': 1e-10, 'feastol': 1e-10}),
           (cp.CLARABEL, {'tol_gap_abs': 1e-10, 'tol_gap_rel': 1e-10, 'tol_feas': 1e-10}))
AGREEMENT = 1e-5
EDGE = 1e-4  # by which caps shrink before a load that is called too heavy counts as held
RESOLVED = 1e-6  # of the caps: smaller loads are next to nothing for solvers that resolve 1e-10
KINDS = ('evaluate_task_wrench', 'minimum_forces', 'evaluate_task_polytope', 'wrench_map', LIVE)


class Verdict(enum.Enum):
    """What a cross-check came to."""

    AGREES = 'agrees'
    DIFFERS = 'differs'
    SILENT = 'no reference'


class Scale:
    """Units in which all numbers of a question are about one."""

    def __init__(self, limits: Mapping[str, Limits]) -> None:
        points = np.array([c.position for c in limits.values()])
        self.center = points.mean(axis=0)
        self.length = lever_arm(limits)
        self.force = max(c.cap for c in limits.values())

    def wrench(self, wrench: Array) -> Array:
        """Scale wrench components (6,) about the origin to those about the centre."""
        moment = wrench[3:] - np.cross(self.center, wrench[:3])
        return np.asarray(np.concatenate(
            [wrench[:3] / self.force, moment / (self.force * self.length)]))

    def grasp(self, limits: Mapping[str, Limits], bound: str, message: Any, share: float = 1.0
              ) -> Grasp:
        """Build the scaled grasp with its joint limits, caps and coefficients times a share."""
        contacts = [Contact(
            (c.position - self.center) / self.length, rotation=c.R, model=ContactModel.SFCE,
            friction=share * c.friction, torsional_friction=share * c.torsional_friction
            / self.length, max_normal_force=share * c.cap / self.force, finger=c.finger)
            for c in limits.values()]
        joints = getattr(message, 'joint_limits', ())
        if not joints:
            return Grasp(contacts, bound)
        sizes = np.array([joint.max_torque for joint in joints])
        matrix = np.array([[[*(c.R.T @ xyz(t.linear)), self.length * (c.R[:, 2] @ xyz(t.angular))]
                            for c, t in zip(limits.values(), joint.twists)] for joint in joints])
        return Grasp(contacts, bound, JointLimits(
            [joint.name for joint in joints], np.full(len(joints), share),
            matrix * (self.force / sizes)[:, None, None],
            np.array([joint.gravity_torque for joint in joints]) / sizes))


def crosscheck(case: Case, settings: Settings, answer: Answer) -> tuple[Verdict, str] | None:
    """Compare an answered question with the references; None where there is no statement of it."""
    if case.kind not in KINDS or settings.barrier_weight or settings.alpha_reserve or (
            settings.force_rate_limit or settings.min_contact_force):
        return None
    limits = limits_of(case, settings)
    found = _claimed(case, answer)
    if found is None:
        return None
    task, load, value = found
    said = []
    for solver, tolerances in SOLVERS:
        text = _differs(case, settings, limits, task, load, value, result_of(case, answer).code,
                        solver, tolerances)
        if text == '':
            return Verdict.AGREES, ''
        if text is not None:
            said.append(f'{solver}: {text}')
    return (Verdict.DIFFERS, '; '.join(said)) if len(said) == len(SOLVERS) else (
        Verdict.SILENT, '; '.join(said))


def _claimed(case: Case, answer: Answer) -> tuple[Array | None, Array, float] | None:
    """Task (None: balance the load), load, and the alpha or peak that was answered."""
    request, response = case.messages.get('request'), answer.response
    if case.kind == LIVE:
        if request is not None and request.kind != 1:
            return None
        quality = answer.published['quality'][-1]
        return six(quality.task_wrench), six(quality.external_wrench), quality.alpha
    load = six(request.external_wrench)
    optimal = response.result.code == ResultCode.OPTIMAL
    if case.kind == 'minimum_forces':
        return None, load, response.peak
    if case.kind == 'evaluate_task_wrench':
        return six(request.task_wrench), load, response.alpha
    tasks = response.directions if case.kind == 'wrench_map' else request.task_wrenches
    if not optimal or not all(response.alphas):
        return None
    return six(tasks[-1]), load, response.alphas[-1]


def _differs(case: Case, settings: Settings, limits: Mapping[str, Limits], task: Array | None,
             load: Array, value: float, code: int, solver: str, tolerances: dict[str, float]
             ) -> str | None:
    """Say how a solver's answer differs; '' for not at all, None where it has none."""
    scale, message = Scale(limits), received(case)
    external = scale.wrench(load)
    unit = 1.0
    if task is not None:
        scaled = scale.wrench(task)
        unit = float(np.linalg.norm(scaled))

    def solved(share: float) -> tuple[str, float]:
        grasp = scale.grasp(limits, settings.force_bound, message, share)
        stated = reference.state_minimum_forces(grasp, external) if task is None else (
            reference.state_task_wrench(grasp, scaled / unit, external))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')
                stated.problem.solve(solver=solver, **tolerances)
        except (cp.SolverError, ValueError, ZeroDivisionError):
            return 'failed', 0.0
        known = stated.problem.status == cp.OPTIMAL
        return stated.problem.status, float(stated.value.value) if known else 0.0

    if code == ResultCode.INFEASIBLE:
        if np.linalg.norm(external) < RESOLVED:
            return None
        status, reached = solved(1.0 - EDGE)
        if status not in (cp.OPTIMAL, cp.INFEASIBLE):
            return None
        held = status == cp.OPTIMAL and (task is not None or reached < 1.0)
        return f'INFEASIBLE, but even {1.0 - EDGE:g} of the caps are enough' if held else ''
    status, reached = solved(1.0)
    if status != cp.OPTIMAL:
        return None
    claimed = value * unit
    size = max(abs(reached), 1e-3 if task is not None else GAP)
    return '' if abs(claimed - reached) <= AGREEMENT * size else (
        f'answered {claimed:.9g}, reference {reached:.9g} (scaled)')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Task-oriented grasp quality: how much of a task wrench a grasp can apply, with which forces.

After R. Haschke, J. J. Steil, I. Steuwer, H. Ritter, "Task-Oriented Quality Measures for Dextrous
Grasping" (2005). Conventions: SI units; wrenches [fx fy fz tx ty tz] about the origin of the
object frame; contact frames with +z along the inward normal; forces are those the finger applies
on the object. See docs/conventions.md; examples/python_only.py is a first program.

========================================================  =======================================
question                                                  function
========================================================  =======================================
how much of a task, with which forces, what limits it     ``evaluate(grasp, task)``
how to hold a load: least forces, or those with margin    ``minimum_forces``, ``hold_forces``
how close measured forces are to slip, what restores it   ``slip_margin``, ``measured_margin``
what to change for more                                   ``explain``
worst case over all directions, size of the wrench space  ``ball_radius``, ``volume``
alpha for many directions, or for many grasps             ``wrench_map``, ``evaluate_many``
alpha when contacts, friction and load are uncertain      ``robust_alpha``
can it hold anything at all                               ``force_closure``, ``grasp_indices``
========================================================  =======================================

Contacts are ``Contact``, a grasp is ``Grasp(contacts, bound)``, tasks are ``TaskWrench``,
``TaskCone``, ``TaskPolytope`` and ``TaskEllipsoid``. All errors are ``GraspQualityError``.
"""

from grasp_quality.ball import ball_radius, BallRadius, ellipsoid_scale
from grasp_quality.closure import force_closure, ForceClosure
from grasp_quality.contact import Contact, ContactModel
from grasp_quality.exceptions import (
    GraspQualityError, InvalidContactError, InvalidGraspError, InvalidTaskError, SolverError,
    SolverTimeoutError)
from grasp_quality.explanation import Change, explain, Explanation
from grasp_quality.grasp import Grasp
from grasp_quality.grasp_set import GraspSet
from grasp_quality.holding import minimum_forces, MinimumForces
from grasp_quality.indices import grasp_indices, GraspIndices
from grasp_quality.joint_limits import JointLimits
from grasp_quality.many import evaluate_many, ManySolution, Outcome
from grasp_quality.margin_forces import hold_forces, HoldForces
from grasp_quality.measured_margin import measured_margin, MeasuredMargin
from grasp_quality.measures import evaluate, slip_margin, wrench_map
from grasp_quality.problem import build_problem, ConicProblem
from grasp_quality.robust import robust_alpha, RobustAlpha
from grasp_quality.slopes import Slopes
from grasp_quality.solution import ConeSolution, PolytopeSolution, Solution, WrenchMap
from grasp_quality.solve import solve
from grasp_quality.status import Status
from grasp_quality.task import TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench
from grasp_quality.volume import volume, WrenchVolume

__version__ = '0.1.0'  # a test compares it with package.xml

__all__ = [
    'BallRadius', 'Change', 'ConeSolution', 'ConicProblem', 'Contact', 'ContactModel',
    'Explanation', 'ForceClosure', 'Grasp', 'GraspIndices', 'GraspQualityError', 'GraspSet',
    'HoldForces', 'InvalidContactError', 'InvalidGraspError', 'InvalidTaskError', 'JointLimits',
    'ManySolution', 'MeasuredMargin', 'MinimumForces', 'Outcome', 'PolytopeSolution',
    'RobustAlpha', 'Slopes', 'Solution', 'SolverError', 'SolverTimeoutError', 'Status',
    'TaskCone', 'TaskEllipsoid', 'TaskPolytope', 'TaskWrench', 'WrenchMap', 'WrenchVolume',
    'ball_radius', 'build_problem', 'ellipsoid_scale', 'evaluate', 'evaluate_many', 'explain',
    'force_closure', 'grasp_indices', 'hold_forces', 'measured_margin', 'minimum_forces',
    'robust_alpha', 'slip_margin', 'solve', 'volume', 'wrench_map']

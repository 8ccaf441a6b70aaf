# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The known answers of test/core/cases.json, as grasps and tasks."""

import json
from pathlib import Path

from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, TaskCone, TaskPolytope, TaskWrench)
import numpy as np

PATH = Path(__file__).parents[1] / 'test' / 'core' / 'cases.json'
CASES = json.loads(PATH.read_text())


def grasp_of(case):
    """Build the grasp that a case states."""
    count = len(case['positions'])
    torsional = case.get('torsional_friction')
    caps = np.broadcast_to(case.get('max_normal_force', 1.0), count)
    gammas = np.broadcast_to(0.0 if torsional is None else torsional, count)
    return Grasp([
        Contact(
            position=position, normal=normal, friction=case['friction'],
            model=ContactModel.PCWF if torsional is None else ContactModel.SFCE,
            torsional_friction=gamma, max_normal_force=cap)
        for position, normal, gamma, cap in zip(
            case['positions'], case['normals'], gammas, caps)], case['bound'])


def evaluate_case(kind, case):
    """Evaluate a case of that kind: its answer by ``evaluate``."""
    grasp = grasp_of(case)
    if kind == 'task_cone':
        return evaluate(grasp, TaskCone(
            case['axis'], case['lateral_x'], case['lateral_y'],
            np.deg2rad(case['half_angle_deg'])))
    if kind == 'polytope':
        return evaluate(grasp, TaskPolytope(case['wrenches']))
    return evaluate(
        grasp, TaskWrench(case['task_wrench']), external_wrench=case.get('external_wrench'),
        barrier_weight=case.get('barrier_weight', 0.0))

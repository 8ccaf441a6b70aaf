# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How far answers are from known ones, and from the same problems stated in CVXPY."""

from benchmarks import document
from benchmarks.cases import CASES, evaluate_case
from benchmarks.random_grasps import random_grasp, random_load
from grasp_quality import evaluate, GraspQualityError, reference, TaskWrench
import numpy as np

GRASPS = 1000
AGREEMENT = 1e-6
KINDS = ('task_wrench', 'task_cone', 'barrier', 'polytope')


def measure():
    """Return the section as Markdown."""
    rows = []
    for kind in KINDS:
        errors = [case_error(kind, case) for case in CASES[kind]]
        rows.append([f'`cases.json`, {kind}', *counts(errors)])
    errors = [reference_error(seed) for seed in range(GRASPS)]
    rows.append(['random grasps against CVXPY', *counts(errors)])
    return '\n'.join([
        '## Agreement', '',
        'Errors of alpha, relative to the larger of alpha and one. Random grasps have 1 to 12 '
        'contacts of all models under all bounds, half of them a load.', '',
        document.table(
            ['problems', 'count', 'largest error', f'beyond {AGREEMENT:g}', 'failures'], rows)])


def counts(errors):
    """Return count, largest error, how many are too large, and how many failed (None)."""
    known = np.array([e for e in errors if e is not None])
    return [len(errors), f'{known.max(initial=0.0):.1e}', int((known > AGREEMENT).sum()),
            len(errors) - len(known)]


def relative(found, expected):
    """Return the largest error, relative to the larger of the value and one."""
    found, expected = np.atleast_1d(found), np.atleast_1d(expected)
    return float((np.abs(found - expected) / np.maximum(1.0, np.abs(expected))).max())


def case_error(kind, case):
    """Return the error of a known case, None where the status is wrong."""
    try:
        solution = evaluate_case(kind, case)
    except GraspQualityError:
        return None
    if kind == 'polytope':
        return max(relative(solution.alphas, case['alphas']),
                   relative(solution.parallelotope_scale, case['parallelotope_scale']))
    if case['alpha'] is None or not solution.feasible:
        return 0.0 if case['alpha'] is None and not solution.feasible else None
    return relative(solution.alpha, case['alpha'])


def reference_error(seed):
    """Return the error of a random grasp, None where either side fails."""
    rng = np.random.default_rng(seed)
    grasp, wrench = random_grasp(rng), rng.normal(size=6)
    load = random_load(rng, grasp) if seed % 2 else None
    stated = reference.state_task_wrench(grasp, wrench, load)
    try:
        solution = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
    except GraspQualityError:
        return None
    if not stated.solve() or not solution.feasible:
        return None
    return relative(solution.alpha, float(stated.value.value))

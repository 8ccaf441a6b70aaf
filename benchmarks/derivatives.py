# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Slopes of alpha by caps, friction, positions and normals against central differences."""

from benchmarks.document import table
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import build_problem, explain, solve, TaskWrench
from grasp_quality.kinks import uniqueness
from grasp_quality.slopes import changed, FIELDS, largest_alpha, smooth_slopes
import numpy as np

COUNT = 1000
STEP = 5e-5     # of the central differences, in SI units, on grasps of the size of one: larger
#                 ones err by their square, smaller ones by the solver's tolerance
CHECKED = 2     # contacts of each grasp that differences are taken of
BESIDE = 20     # kinks at which differences are taken too


def problem(seed):
    """Grasp of 4 to 8 contacts, task that it can serve, and a load or none."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=int(rng.integers(4, 9)), bound=BOUNDS[seed % 4])
    load = random_load(rng, grasp) if rng.uniform() < 0.5 else None
    if rng.uniform() < 0.5:
        return grasp, TaskWrench(rng.normal(size=6)), load
    return grasp, TaskWrench(grasp.wrench(
        rng.uniform(0.3, 1.0, (len(grasp), 4)) * [0.2, 0.2, 1.0, 0.2] * grasp.scales)), load


def disagreement(grasp, task, load, contacts=None):
    """Largest difference between slopes and central differences, over the largest slope."""
    slopes = smooth_slopes(solve(build_problem(grasp, task, load)))
    alpha = largest_alpha(task, load, None)
    worst = largest = 0.0
    for field in FIELDS:
        found = getattr(slopes, field).reshape(len(grasp), -1)
        largest = max(largest, np.abs(found).max())
        for i in range(len(grasp)) if contacts is None else contacts:
            for axis in range(found.shape[1]):
                ahead, behind = (
                    alpha(changed(grasp, i, field, h, axis)) for h in (STEP, -STEP))
                worst = max(worst, abs((ahead - behind) / (2.0 * STEP) - found[i, axis]))
    return worst / largest


def measure(count=COUNT):
    """Compare and return the section's text."""
    errors, kinks, seed = [], [], 0
    while len(errors) < count:
        grasp, task, load = problem(seed)
        program = build_problem(grasp, task, load)
        solution = solve(program)
        if solution.alpha > 1e-3:
            if uniqueness(program).smooth:
                rng = np.random.default_rng(seed)
                chosen = rng.choice(len(grasp), CHECKED, replace=False)
                errors.append(disagreement(grasp, task, load, chosen))
            else:
                kinks.append(seed)
        seed += 1
    differ = 0
    for s in kinks[:BESIDE]:
        found = explain(*problem(s))
        sides = [np.concatenate([getattr(side, f).ravel() for f in FIELDS])
                 for side in (found.forward, found.backward)]
        differ += int(np.abs(sides[0] - sides[1]).max() > 1e-2 * np.abs(sides[0]).max())
    errors = np.array(errors)
    rows = [['called smooth', len(errors)],
            ['median disagreement', f'{np.median(errors):.1e}'],
            ['largest disagreement', f'{errors.max():.1e}'],
            ['above 1e-4', int((errors > 1e-4).sum())],
            ['called a kink, and answered with one-sided slopes', len(kinks)],
            [f'of the first {len(kinks[:BESIDE])} of these, sides differ by 1 % or more', differ]]
    return '\n'.join([
        '## Derivatives', '',
        f'`python -m benchmarks derivatives`: random grasps of 4 to 8 contacts, all bounds, half '
        'of them with a load; slopes by cap, friction, position and normal of two contacts each '
        f'against central differences with a step of {STEP:g}, as a share of the largest slope.',
        '', table(['', 'grasps'], rows)])

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``robust_alpha``: the time of a whole question, drawing and statistics included."""

import time

from benchmarks import document
from benchmarks.random_grasps import random_grasp, random_load
from grasp_quality import ContactModel, robust_alpha, TaskWrench
import numpy as np

COUNTS = (3, 5, 8, 20)
SAMPLES, REPETITIONS = 1000, 40
TARGETS_MS = {5: 25.0}
NOISE = {'contact_noise': 0.001, 'normal_noise': 0.05, 'friction_noise': 0.05}


def measure():
    """Return the section as Markdown."""
    rows = []
    for count in COUNTS:
        times, answer = timed(count)
        target = TARGETS_MS.get(count)
        rows.append([
            count, f'{1e3 * np.median(times):.1f}', f'{1e3 * np.quantile(times, 0.9):.1f}',
            f'{target:.0f}' if target else '', f'{1e6 * np.median(times) / SAMPLES:.0f}',
            answer.infeasible, answer.unproved])
    return '\n'.join([
        '## Alpha under uncertainty', '', document.machine(),
        f'`robust_alpha` with {SAMPLES} samples, all noises but that of the load; random grasps, '
        f'bound linf, PCWF; {REPETITIONS} runs.', '',
        document.table(
            ['contacts', 'median [ms]', '90 % [ms]', 'below [ms]', 'a sample [us]', 'infeasible',
             'unproved'], rows)])


def timed(count):
    """Return the times of all repetitions [s] and one answer."""
    rng = np.random.default_rng(count)
    grasp = random_grasp(rng, count, 'linf', (ContactModel.PCWF,))
    task = TaskWrench(-random_load(rng, grasp))
    times = np.empty(REPETITIONS)
    answer = robust_alpha(grasp, task, samples=SAMPLES, **NOISE)
    for i in range(REPETITIONS):
        begin = time.perf_counter()
        answer = robust_alpha(grasp, task, samples=SAMPLES, seed=i, **NOISE)
        times[i] = time.perf_counter() - begin
    return times, answer

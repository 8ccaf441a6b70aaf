# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How many of 20,000 degenerate problems end without an answer."""

from collections import Counter
import time

from benchmarks import document
from benchmarks.random_grasps import degenerate_grasp, degenerate_load, degenerate_wrench
from grasp_quality import evaluate, force_closure, minimum_forces, SolverError, TaskWrench
import numpy as np

COUNTS = {'task wrench': 20_000, 'task wrench with barrier weight': 4_000,
          'minimum forces': 4_000, 'force closure': 4_000}


def measure():
    """Return the section as Markdown."""
    rows = []
    for kind, count in COUNTS.items():
        begin = time.perf_counter()
        outcomes = Counter(outcome(kind, seed) for seed in range(count))
        failed = outcomes.pop('unproved', 0)
        rows.append([
            kind, count, ', '.join(f'{n} {name}' for name, n in outcomes.most_common()), failed,
            f'{100 * failed / count:.2f} %', f'{time.perf_counter() - begin:.0f}'])
    return '\n'.join([
        '## Degenerate problems', '',
        'Contacts on top of each other, in a line or facing one way, friction and caps over six '
        'decades, sizes from 1 mm and 1 mN on, tasks of any size and just in reach, loads at the '
        'very edge of the caps. Without a proof there is no answer, but an error.', '',
        document.table(['problem', 'count', 'answers', 'errors', 'share', 'time [s]'], rows)])


def outcome(kind, seed):
    """Return the status of a problem, in words."""
    rng = np.random.default_rng(seed)
    grasp = degenerate_grasp(rng)
    wrench, load = degenerate_wrench(rng, grasp), degenerate_load(rng, grasp)
    try:
        if kind == 'force closure':
            return 'closed' if force_closure(grasp).closed else 'open'
        if kind == 'minimum forces':
            return minimum_forces(grasp, wrench if load is None else load).status.name.lower()
        size = np.linalg.norm(grasp.scaled_wrench(wrench))
        weight = 10.0 ** rng.uniform(-4, 1) / size if 'barrier' in kind else 0.0
        return evaluate(grasp, TaskWrench(wrench), load, weight).status.name.lower()
    except SolverError:
        return 'unproved'

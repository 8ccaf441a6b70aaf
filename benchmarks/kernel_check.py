# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The batch kernel against Clarabel on 100,000 random problems, one in five of them degenerate.

Both have to prove what they say; what the kernel does not prove is handed over and counts as such.
"""

from concurrent.futures import ProcessPoolExecutor
import itertools
import os
import time

from benchmarks import document
from benchmarks.random_grasps import (
    degenerate_grasp, degenerate_load, degenerate_wrench, random_grasp, random_load)
from grasp_quality import build_problem, clarabel_solver, GraspSet, SolverError, TaskWrench
from grasp_quality.batch import Answers
from grasp_quality.many import by_kernel, Outcome
from grasp_quality.solve import first_proved
import numpy as np

COUNT, AT_ONCE, DEGENERATE = 100_000, 2_000, 5
AGREEMENT = 1e-6  # of the larger of alpha and 1e-3 a0, as in the proof
KINDS = ('ordinary', 'degenerate', 'l2')


def problem(seed):
    """Return the grasp, the task and the load of a seed."""
    rng = np.random.default_rng(seed)
    if seed % DEGENERATE == 0:
        grasp = degenerate_grasp(rng)
        wrench, load = degenerate_wrench(rng, grasp), degenerate_load(rng, grasp)
    else:
        grasp, wrench = random_grasp(rng), rng.normal(size=6)
        load = random_load(rng, grasp) if seed % 2 else None
    return grasp, wrench, np.zeros(6) if load is None else load


def compare(seeds):
    """Return what happened to each: a row (kind, what, error) a problem."""
    grasps, wrenches, loads = zip(*(problem(seed) for seed in seeds))
    many = Answers.empty(len(grasps), 0)
    by_kernel(GraspSet.of(grasps), np.arange(len(grasps)), np.array(wrenches), np.array(loads),
              many, None)
    rows = []
    for i, (seed, grasp) in enumerate(zip(seeds, grasps)):
        kind = 'l2' if grasp.bound == 'l2' else (
            'degenerate' if seed % DEGENERATE == 0 else 'ordinary')
        ours = Outcome(int(many.status[i])).name
        if ours == 'UNPROVED':
            rows.append((kind, 'handed over', 0.0))
            continue
        conic = build_problem(grasp, TaskWrench(wrenches[i]), loads[i])
        try:
            theirs = first_proved(conic, (
                clarabel_solver.run(conic, n) for n in range(len(clarabel_solver.ATTEMPTS))))
        except SolverError:
            rows.append((kind, 'Clarabel proves nothing', 0.0))
            continue
        if (theirs is None) != (ours == 'INFEASIBLE'):
            rows.append((kind, 'wrong status', 0.0))
            continue
        error = 0.0
        if theirs is not None:
            alpha, unit = float(theirs.values[0]), conic.virtual.unit
            error = abs(many.alpha[i] / unit - alpha) / max(alpha, 1e-3 * conic.reach)
        rows.append((kind, ours.lower(), error))
    return rows


def measure():
    """Return the section as Markdown."""
    begin = time.perf_counter()
    parts = [range(at, min(at + AT_ONCE, COUNT)) for at in range(0, COUNT, AT_ONCE)]
    with ProcessPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        rows = list(itertools.chain.from_iterable(pool.map(compare, parts)))
    took = time.perf_counter() - begin
    lines = []
    for name in (*KINDS, 'all but l2', 'all'):
        kinds = {'all': KINDS, 'all but l2': KINDS[:2]}.get(name, (name,))
        lines.append(line(name, [row for row in rows if row[0] in kinds]))
    return '\n'.join([
        f'## The kernel on {COUNT:,} random problems', '',
        f'1 to 12 contacts, all models and bounds, half of the ordinary ones with a load; one in '
        f'{DEGENERATE} is degenerate (see "Degenerate problems"). Error of alpha against Clarabel '
        'over the larger of alpha and a thousandth of a0; each side has proved its answer. The '
        f'kernel does not know l2. {took:.0f} s.', '',
        document.table(
            ['problems', 'count', 'optimal', 'infeasible', 'largest error',
             f'beyond {AGREEMENT:g}', 'wrong status', 'Clarabel proves nothing', 'handed over',
             'share'], lines)])


def line(name, rows):
    """Count one kind of problems."""
    def count(what):
        return sum(row[1] == what for row in rows)

    errors = np.array([row[2] for row in rows])
    return [name, len(rows), count('optimal'), count('infeasible'), f'{errors.max():.1e}',
            int((errors > AGREEMENT).sum()), count('wrong status'),
            count('Clarabel proves nothing'), count('handed over'),
            f'{100 * count("handed over") / len(rows):.2f} %']

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
One task wrench: ``evaluate`` with everything it gives, against Clarabel alone and other ways.

All ways are timed in turns in one run, so that they share the machine's moods; what counts are
medians and their ratios. The bound is linf; qhull cannot do that (a Minkowski sum), it gets l1.
"""

import time

from benchmarks import document
from benchmarks.random_grasps import random_grasp, random_load
import clarabel
import cvxpy as cp
from grasp_quality import ContactModel, evaluate, Grasp, reference, TaskWrench
from grasp_quality.clarabel_solver import CONES
from grasp_quality.problem import build_problem
import numpy as np
from scipy.sparse import csc_matrix
from scipy.spatial import ConvexHull

COUNTS = (3, 8, 64)
TARGETS = {3: 3.0, 8: 2.0, 64: 1.3}
REPETITIONS, SLOW_REPETITIONS, HULL_REPETITIONS = 1000, 20, {3: 20, 8: 20, 64: 1}
EDGES = 8


def measure():
    """Return the section as Markdown."""
    rows, scale = [], []
    for count in COUNTS:
        grasp, wrench = problem(count)
        fast = medians(fast_ways(grasp, wrench), REPETITIONS)
        slow = medians(slow_ways(grasp, wrench), SLOW_REPETITIONS)
        hull, shortfall = linearised(grasp, wrench, HULL_REPETITIONS[count])
        theirs = fast['clarabel']
        rows.append([
            count, us(theirs), us(fast['new grasp']), us(fast['same grasp']),
            f'{fast["new grasp"] / theirs:.2f}', f'{fast["same grasp"] / theirs:.2f}',
            f'{TARGETS[count]:.1f}'])
        scale.append([count, ms(theirs), ms(fast['new grasp']), ms(slow['cached']),
                      ms(slow['rebuilt']), ms(hull), f'{100 * shortfall:.1f} %'])
    return '\n'.join([
        '## One task wrench', '', document.machine(),
        f'Medians of {REPETITIONS} in turns; the bound is linf, contacts are PCWF.', '',
        document.table(
            ['contacts', 'Clarabel [us]', 'evaluate, new grasp [us]', 'same grasp [us]',
             'ratio, new', 'ratio, same', 'at most'], rows), '',
        'For scale:', '',
        document.table(
            ['contacts', 'Clarabel [ms]', 'evaluate [ms]', 'CVXPY cached [ms]',
             'CVXPY rebuilt [ms]', f'qhull, {EDGES} edges, l1 [ms]', 'its alpha is low by'],
            scale)])


def problem(count):
    """Return a grasp of point contacts with friction, and a task within its reach."""
    rng = np.random.default_rng(count)
    grasp = random_grasp(rng, count, 'linf', (ContactModel.PCWF,))
    return grasp, -random_load(rng, grasp)


def fast_ways(grasp, wrench):
    """Return the ways that take microseconds, as functions."""
    conic = build_problem(grasp, TaskWrench(wrench))
    rows, variables = conic.layout.shape
    matrix = csc_matrix((-conic.equation_values, conic.layout.row_columns,
                         conic.layout.row_starts), shape=(variables, rows))
    nothing, right, objective = csc_matrix((rows, rows)), conic.e, -conic.c
    cones = [CONES[kind](size) for kind, size in conic.cones]
    settings = clarabel.DefaultSettings()
    settings.verbose, settings.max_threads = False, 1

    def clarabel_alone():
        return clarabel.DefaultSolver(
            nothing, right, matrix, objective, cones, settings).solve()

    def ours(grasp):
        solution = evaluate(grasp, TaskWrench(wrench))
        return (solution.alpha, solution.forces, solution.dalpha_dexternal_wrench,
                solution.dalpha_dmax_force, solution.dalpha_dfriction, solution.limiting_contact)

    return {'clarabel': clarabel_alone, 'new grasp': lambda: ours(Grasp(grasp.contacts, 'linf')),
            'same grasp': lambda: ours(grasp)}


def slow_ways(grasp, wrench):
    """Return the ways that take milliseconds, as functions."""
    parameter = cp.Parameter(6)
    stated = reference.state_task_wrench(grasp, parameter)
    other = np.random.default_rng(0)

    def cached():
        parameter.value = wrench * other.uniform(0.5, 2.0)
        stated.problem.solve(solver=cp.CLARABEL)

    def rebuilt():
        reference.state_task_wrench(grasp, wrench).problem.solve(solver=cp.CLARABEL)

    return {'cached': cached, 'rebuilt': rebuilt}


def medians(ways, repetitions):
    """Time the ways in turns; return the median of each [s]."""
    times = {name: np.empty(repetitions) for name in ways}
    for _ in range(1 + repetitions // 10):
        for way in ways.values():
            way()
    for i in range(repetitions):
        for name, way in ways.items():
            begin = time.perf_counter()
            way()
            times[name][i] = time.perf_counter() - begin
    return {name: float(np.median(values)) for name, values in times.items()}


def linearised(grasp, wrench, repetitions):
    """Return qhull's time [s] on the cones' edges, and by what share its alpha falls short."""
    grasp = Grasp(grasp.contacts, 'l1')
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        alpha = alpha_of_edges(grasp, wrench)
        times.append(time.perf_counter() - begin)
    return float(np.median(times)), 1.0 - alpha / evaluate(grasp, TaskWrench(wrench)).alpha


def alpha_of_edges(grasp, wrench):
    """Return the alpha of the convex hull of all edges' wrenches (l1 bound)."""
    angles = np.linspace(0.0, 2.0 * np.pi, EDGES, endpoint=False)
    edges = np.stack([np.cos(angles), np.sin(angles), np.ones(EDGES), np.zeros(EDGES)])  # (4, e)
    columns = np.einsum('ijk,jk,ke->ije', grasp.matrix, grasp.force_units, edges)
    points = np.concatenate([np.zeros((1, 6)), columns.reshape(6, -1).T])
    facets = ConvexHull(points).equations  # normal . w + offset <= 0
    along = facets[:, :6] @ wrench
    return float((-facets[:, 6] / np.where(along > 1e-12, along, np.nan))[along > 1e-12].min())


def us(seconds):
    """Write a time in microseconds."""
    return f'{1e6 * seconds:,.0f}'


def ms(seconds):
    """Write a time in milliseconds."""
    return f'{1e3 * seconds:,.2f}'

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Ways to solve one direction of a map, each a function that takes the next one when called."""

from itertools import cycle
import time

from benchmarks.speed import alpha_of_edges
import clarabel
import cvxpy as cp
import ecos
from grasp_quality import build_problem, Grasp, judge, kernel, reference, TaskWrench
from grasp_quality.batch import TOLERANCES
from grasp_quality.clarabel_solver import CONES
from grasp_quality.scaled import Scaled
import numpy as np
from scipy.sparse import csc_matrix
import scs

SAMPLE = 32          # directions that the general solvers take in turns
LARGEST_HULL = 64    # contacts; beyond it qhull takes minutes
TOLERANCE, TOLERANCE_SCS = 1e-9, 1e-6


class MapWays:
    """
    The ways for one grasp.

    Parameters
    ----------
    grasp : Grasp
    tasks : (N, 6) array [N, N m]

    """

    def __init__(self, grasp, tasks):
        self.grasp, self.tasks = grasp, tasks[:SAMPLE]
        self.problems = [build_problem(grasp, TaskWrench(task)) for task in self.tasks]
        self.parameter = cp.Parameter(6)
        self.stated = reference.state_task_wrench(grasp, self.parameter)

    def each(self):
        """Return them by name."""
        ways = {'clarabel': self.clarabel(), 'ecos': self.ecos(), 'scs': self.scs(),
                'cached': self.cached(), 'rebuilt': self.rebuilt(), 'kernel': self.kernel()}
        if len(self.grasp) <= LARGEST_HULL:
            grasp = Grasp(self.grasp.contacts, 'l1')
            ways['qhull'] = lambda: alpha_of_edges(grasp, self.tasks[0])
        return ways

    def matrices(self):
        """Matrices of the problems, min e.x, -E^T x + s = -c, s in K, one after the other."""
        found = []
        for problem in self.problems:
            rows, variables = problem.layout.shape
            found.append((csc_matrix(
                (-problem.equation_values, problem.layout.row_columns, problem.layout.row_starts),
                shape=(variables, rows)), problem.e, -problem.c))
        return cycle(found)

    def clarabel(self):
        """Clarabel alone."""
        matrices, rows = self.matrices(), self.problems[0].layout.shape[0]
        nothing = csc_matrix((rows, rows))
        cones = [CONES[kind](size) for kind, size in self.problems[0].cones]
        settings = clarabel.DefaultSettings()
        settings.verbose, settings.max_threads = False, 1
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = TOLERANCE

        def way():
            A, q, b = next(matrices)
            clarabel.DefaultSolver(nothing, q, A, b, cones, settings).solve()
        return way

    def ecos(self):
        """ECOS alone."""
        matrices, dims = self.matrices(), self.dims()

        def way():
            G, c, h = next(matrices)
            ecos.solve(c, G, h, dims, verbose=False, abstol=TOLERANCE, reltol=TOLERANCE,
                       feastol=TOLERANCE)
        return way

    def scs(self):
        """SCS alone, a first-order method: with a looser tolerance."""
        matrices, dims = self.matrices(), self.dims()

        def way():
            A, c, b = next(matrices)
            scs.SCS({'A': A, 'b': b, 'c': c}, dims, verbose=False, eps_abs=TOLERANCE_SCS,
                    eps_rel=TOLERANCE_SCS).solve()
        return way

    def dims(self):
        """Cones as ECOS and SCS take them."""
        cones = self.problems[0].cones
        return {'l': sum(size for kind, size in cones if kind == 'nonnegative'),
                'q': [size for kind, size in cones if kind == 'second_order']}

    def cached(self):
        """CVXPY with the task as a parameter."""
        tasks = cycle(self.tasks)

        def way():
            self.parameter.value = next(tasks)
            self.stated.problem.solve(solver=cp.CLARABEL)
        return way

    def rebuilt(self):
        """CVXPY stated anew."""
        tasks = cycle(self.tasks)
        return lambda: reference.state_task_wrench(
            self.grasp, next(tasks)).problem.solve(solver=cp.CLARABEL)

    def kernel(self):
        """Kernel and judge on this thread, as ``batch.solve_part`` calls them."""
        scaled, which, k = Scaled.of(self.grasp), np.zeros(1, np.int64), len(self.grasp)
        tasks = scaled.wrenches(self.tasks.copy(), np.zeros(len(self.tasks), np.int64))
        sizes = np.sqrt((tasks * tasks).sum(axis=1))
        questions = cycle([((task / size)[None], np.array([size]))
                           for task, size in zip(tasks, sizes)])
        load, weights = np.zeros((1, 6)), np.zeros((1, k))
        shares, multipliers = np.empty((1, k, 4)), np.empty((1, 6))
        nus, forces = np.empty((1, scaled.group_count)), np.empty((1, k, 4))
        alpha, upper, status = np.empty(1), np.empty(1), np.empty(1, np.int8)

        def way():
            task, size = next(questions)
            kernel.solve_many(
                scaled.blocks, which, scaled.groups, scaled.group_count, task, load,
                scaled.reaches, scaled.least_caps, 1.0, weights, alpha, shares, multipliers, nus,
                status)
            judge.judge_many(
                TOLERANCES, scaled.blocks, which, scaled.groups, scaled.group_count, task, load,
                scaled.reaches, scaled.least_caps, scaled.units, size, alpha, shares, multipliers,
                status, upper, forces)
            if status[0] != judge.OPTIMAL:
                raise RuntimeError('a direction that the kernel did not prove')
        return way


def medians(ways, enough_s, at_most=1000):
    """Time ways in turns until each has had its time; return the median of each [s]."""
    times = {name: [] for name in ways}
    for way in ways.values():
        way()
    waiting = dict(ways)
    while waiting:
        for name, way in list(waiting.items()):
            begin = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - begin)
            if sum(times[name]) > enough_s or len(times[name]) >= at_most:
                del waiting[name]
    return {name: float(np.median(values)) for name, values in times.items()}

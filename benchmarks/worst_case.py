# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The largest ball: time, agreement with closed forms and local searches, and qhull beside it."""

from __future__ import annotations

import time

from benchmarks import document
from benchmarks.edges import hull_radius
from benchmarks.random_grasps import BOUNDS, random_grasp
from grasp_quality import (
    ball_radius, BallRadius, Contact, ContactModel, Grasp, SolverError, TaskWrench, wrench_map)
from grasp_quality.problem import build_problem
from grasp_quality.solve import solve
import numpy as np

COUNTS, TARGETS = (3, 8), {3: 50, 8: 250}
TIMED = 25              # grasps of each bound and count
GRASPS = 500            # with a ball
RESTARTS, STEPS = 100, 40
INNER = 200             # random directions whose alpha has to reach the lower end
EDGES = (8, 16, 32)
TURNS = 8               # of the tangents of the linearised cones


def measure() -> str:
    """Return the section as Markdown."""
    return '\n'.join(['## The largest ball', '', document.machine(), *times(), *hulls(), *study()])


def pair(mu: float, gamma: float, bound: str) -> Grasp:
    """Two soft fingers that face each other on the unit ball."""
    return Grasp([Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), ContactModel.SFCE, mu, gamma)
                  for x in (-1.0, 1.0)], bound)


def circle(count: int, mu: float, bound: str) -> Grasp:
    """Contacts spread evenly on the equator of the unit ball."""
    angles = np.pi + 2.0 * np.pi * np.arange(count) / count
    points = np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1)
    return Grasp([Contact(p, -p, friction=mu) for p in points], bound)


def cube(mu: float, bound: str) -> Grasp:
    """Four contacts on each of two faces of a cube, the paper's Fig. 3."""
    return Grasp([Contact((x, y, z), (-x, 0.0, 0.0), friction=mu)
                  for x in (-1.0, 1.0) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], bound)


def timed(grasp: Grasp, repetitions: int = 3) -> tuple[BallRadius, float]:
    """Answer, and the median time [ms] of it."""
    spent = []
    for _ in range(repetitions):
        fresh = Grasp(grasp.contacts, grasp.bound)
        begin = time.perf_counter()
        found = ball_radius(fresh)
        spent.append(1e3 * (time.perf_counter() - begin))
    return found, float(np.median(spent))


def times() -> list[str]:
    """Time closed forms, symmetric grasps (slow: many equal minima) and random ones."""
    ball_radius(circle(3, 0.5, 'linf'))
    exact = {
        'pair of soft fingers, mu = gamma = 0.5, l1': (pair(0.5, 0.5, 'l1'), 1.0 / 3.0),
        'pair of soft fingers, mu = 0.5, gamma = 0.1, l1': (pair(0.5, 0.1, 'l1'), 0.1),
        'three fingers, mu = 0.3, linf': (circle(3, 0.3, 'linf'), 0.9 / np.sqrt(5.0)),
        'three fingers, mu = 0.5, linf': (circle(3, 0.5, 'linf'), 1.5 / np.sqrt(5.0)),
        'three fingers, mu = 0.5, l1': (circle(3, 0.5, 'l1'), None),
        'eight on a circle, mu = 0.5, linf': (circle(8, 0.5, 'linf'), None),
        "eight on two faces (the paper's Fig. 3), mu = 0.5, linf": (cube(0.5, 'linf'), None),
        "eight on two faces (the paper's Fig. 3), mu = 0.5, l1": (cube(0.5, 'l1'), None)}
    rows = []
    for name, (grasp, radius) in exact.items():
        found, spent = timed(grasp)
        holds = '' if radius is None else found.lower <= radius <= found.upper
        rows.append([name, f'{found.lower:.6f}', f'{found.upper:.6f}',
                     '' if radius is None else f'{radius:.6f}', holds,
                     f'{100.0 * found.width:.2f} %', found.cells, f'{spent:.1f}'])
    spread = []
    for count in COUNTS:
        for bound in BOUNDS:
            found_all = [timed(grasp, 1) for grasp in with_ball(count, bound, TIMED)]
            spent_all = np.array([spent for _, spent in found_all])
            spread.append([count, bound, f'{np.median(spent_all):.1f}', f'{spent_all.max():.1f}',
                           sum(found.reached for found, _ in found_all), TIMED,
                           f'{TARGETS[count]}'])
    return [
        'Relative width 1 %, torque length 1 m, caps 1 N, a new Grasp each time; median of 3.', '',
        document.table(['grasp', 'lower', 'upper', 'closed form', 'inside', 'width', 'cells',
                        'time [ms]'], rows), '',
        'The first random grasps of each kind that have a ball:', '',
        document.table(['contacts', 'bound', 'median [ms]', 'largest [ms]', 'width reached', 'of',
                        'target [ms]'], spread), '']


def hulls() -> list[str]:
    """Qhull on linearised cones, turned about their normals, beside the certified interval."""
    rows = []
    grasps = {
        'three fingers, mu = 0.5': circle(3, 0.5, 'l1'),
        **{f'random, {count} contacts': with_ball(count, 'l1', 1, (ContactModel.PCWF,))[0]
           for count in COUNTS},
        'pair of point contacts (rank 5)': Grasp(
            [Contact((x, 0.0, 0.0), (-x, 0.0, 0.0)) for x in (-1.0, 1.0)], 'l1')}
    for name, grasp in grasps.items():
        found, spent = timed(grasp)
        rows.append([name, 'true cones', f'{found.lower:.4f} to {found.upper:.4f}', '',
                     f'{spent:.1f}'])
        for edges in (4, *EDGES):
            rows.append([name, f'qhull, {edges} edges',
                         *hull_row(grasp, edges, found.upper, 1 if edges > 16 else TURNS)])
        if found.upper == 0.0:
            rows.append([name, f'qhull QJ, {EDGES[0]} edges',
                         *hull_row(grasp, EDGES[0], 0.0, TURNS, 'QJ')])
    return [
        'The l1 bound, which a convex hull can do (linf is a Minkowski sum). The tangents of the '
        f'linearised cones are turned {TURNS} times (once for more than 16 edges): least and '
        'largest answer, error of the least one.', '',
        document.table(['grasp', 'method', 'radius', 'error', 'time [ms]'], rows), '']


def hull_row(grasp: Grasp, edges: int, exact: float, turns: int, options: str = '') -> list[str]:
    """Radius over the turns, error against the exact one, time of one hull."""
    begin = time.perf_counter()
    angles = 2.0 * np.pi / edges * np.arange(turns) / turns
    radii = [hull_radius(grasp, edges, angle, options) for angle in angles]
    spent = 1e3 * (time.perf_counter() - begin) / turns
    known = [r for r in radii if r is not None]
    if not known:
        return ['no hull: qhull fails on a flat set', '', f'{spent:.1f}']
    low, high = min(known), max(known)
    shown = f'{low:.4f} to {high:.4f}' if exact > 0.0 else f'{low:.1e} to {high:.1e}, for 0'
    return [shown, f'{100.0 * (low / exact - 1.0):.1f} %' if exact > 0.0 else '', f'{spent:.1f}']


def with_ball(count: int, bound: str, wanted: int,
              models: tuple[ContactModel, ...] = tuple(ContactModel)) -> list[Grasp]:
    """Return the first random grasps that have a ball."""
    grasps: list[Grasp] = []
    seed = 0
    while len(grasps) < wanted:
        grasp = random_grasp(np.random.default_rng(seed), count, bound, models)
        if ball_radius(grasp).lower > 0.0:
            grasps.append(grasp)
        seed += 1
    return grasps


def study() -> list[str]:
    """Random grasps against a local search from many directions, and against alpha inside."""
    tally = dict.fromkeys(['inside', 'below', 'above', 'inner', 'wide'], 0)
    flat, done, seed, least, best = 0, 0, 0, np.inf, 0.0
    while done < GRASPS:
        rng = np.random.default_rng(seed)
        seed += 1
        grasp = random_grasp(rng, int(rng.integers(3, 9)))
        found = ball_radius(grasp)
        if found.upper <= 1e-9:
            flat += 1
            continue
        done += 1
        value = min(local_search(grasp, rng.normal(size=6)) for _ in range(RESTARTS))
        tally['below'] += value < found.lower
        tally['above'] += value > found.upper * (1.0 + 1e-9)
        tally['inside'] += found.lower <= value <= found.upper * (1.0 + 1e-9)
        tally['wide'] += not found.reached
        best = max(best, found.upper / value - 1.0)
        directions = rng.normal(size=(INNER, 6))
        directions[0] = found.weakest_wrench
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        alpha = wrench_map(grasp, directions).alpha.min()
        tally['inner'] += alpha < found.lower
        least = min(least, alpha / found.lower)
    return [
        f'{GRASPS} random grasps of 3 to 8 contacts, all models and bounds, that have a ball '
        f'({flat} others without were passed over), against {RESTARTS} local searches each from '
        f'random directions on the support function, and against alpha in {INNER} directions:', '',
        document.table(['check', 'count'], [
            ['value of the local searches inside the interval', tally['inside']],
            ['below the lower end (would disprove it)', tally['below']],
            ['above the upper end by more than 1e-9', tally['above']],
            ['alpha of some direction below the lower end (would disprove it)', tally['inner']],
            ['interval wider than asked', tally['wide']],
            ['least alpha over lower end', f'{least:.4f}'],
            ['largest upper end over the best local search, minus 1', f'{best:.1e}']])]


def local_search(grasp: Grasp, start: np.ndarray) -> float:
    """Walk down the support function over |lambda|; each step is a task wrench problem."""
    direction, value = start / np.linalg.norm(start), np.inf
    for _ in range(STEPS):
        try:
            solution = solve(build_problem(grasp, TaskWrench(direction)))
        except SolverError:
            return value
        multiplier = solution.dalpha_dexternal_wrench
        size = float(np.linalg.norm(multiplier))
        last, value = value, min(value, solution.alpha_upper / size)
        if not value < last * (1.0 - 1e-9):
            return value
        direction = multiplier / size
    return value

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Side by side in one run: general solvers, CVXPY, qhull and the kernel, from 3 to 256 contacts.

One direction, a map of 2,592 and 2,592 grasps. General solvers are called directly, with their
matrices ready, on the form that is smallest to factor (``clarabel_solver``). What would take
minutes is timed on a sample of the map and multiplied, which the table says.
"""

import math
import time

from benchmarks import document
from benchmarks.random_grasps import random_grasp, random_load
from benchmarks.solver_plot import draw
from benchmarks.solver_ways import MapWays, medians
from grasp_quality import ContactModel, evaluate_many, GraspSet, wrench_map
from grasp_quality.directions import force_grid
import numpy as np

COUNTS = (3, 8, 20, 64, 256)
DIRECTIONS = 2592
ENOUGH_S = 0.5   # spent on each way before its median is taken
TARGETS = {'single': 8.0, 'map': 20.0, 'cached': 100.0, 'ms': 20.0, 'forces': 1.5, 'power': 1.1}


def problem(count):
    """Return a grasp of point contacts with friction, 2,592 tasks, one in its reach first."""
    rng = np.random.default_rng(count)
    grasp = random_grasp(rng, count, 'linf', (ContactModel.PCWF,))
    tasks = np.concatenate([force_grid(36), np.zeros((DIRECTIONS, 6))])[:DIRECTIONS]
    tasks = tasks + 0.1 * rng.normal(size=(DIRECTIONS, 6))
    tasks[0] = -random_load(rng, grasp)
    return grasp, tasks


def many(count):
    """Return 2,592 grasps of that many contacts, as arrays."""
    rng = np.random.default_rng(count)
    positions = rng.normal(size=(DIRECTIONS, count, 3))
    positions /= np.linalg.norm(positions, axis=2, keepdims=True)
    return positions, -positions + 0.3 * rng.normal(size=positions.shape)


def best(way, repetitions=7):
    """Return the median time [s] of a call that takes long, after one to get warm."""
    way()
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        way()
        times.append(time.perf_counter() - begin)
    return float(np.median(times))


def measure():
    """Return the section as Markdown, and draw docs/images/solvers.png."""
    machine, single, maps, sizes = document.machine(), [], [], {}
    for count in COUNTS:
        grasp, tasks = problem(count)
        ways = MapWays(grasp, tasks)
        one = medians(ways.each(), ENOUGH_S)
        rows = many(count)

        def grasps(arrays=rows):
            evaluate_many(GraspSet.of_arrays(*arrays), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0])

        whole = {'map': best(lambda: wrench_map(grasp, tasks)),
                 'forces': best(lambda: wrench_map(grasp, tasks, forces=True)),
                 'grasps': best(grasps)}
        sizes[count] = {**one, **{name: s / DIRECTIONS for name, s in whole.items()}}
        single.append([count, *(us(one.get(name)) for name in (
            'clarabel', 'ecos', 'scs', 'cached', 'rebuilt', 'qhull', 'kernel')),
            f'{one["clarabel"] / one["kernel"]:.1f}'])
        maps.append([count, *(ms(one[name] * DIRECTIONS) for name in (
            'clarabel', 'ecos', 'scs', 'cached')), ms(whole['map']), ms(whole['forces']),
            ms(whole['grasps']), f'{one["clarabel"] * DIRECTIONS / whole["map"]:.0f}',
            f'{one["cached"] * DIRECTIONS / whole["map"]:.0f}'])
    draw(sizes)
    return '\n'.join([
        '## Solvers side by side', '', machine,
        'Bound linf, point contacts with friction (qhull: l1, 8 edges a cone, which is another '
        'and easier problem). General solvers with their matrices ready, tolerance 1e-9 (SCS: '
        '1e-6), a new direction each time. "Kernel" is one direction, scaled problem in, proved '
        'answer out.', '', 'One direction [us]:', '',
        document.table(['contacts', 'Clarabel', 'ECOS', 'SCS', 'CVXPY cached', 'CVXPY rebuilt',
                        'qhull', 'kernel', 'Clarabel / kernel'], single), '',
        f'Map of {DIRECTIONS:,} directions, and {DIRECTIONS:,} grasps from arrays with one task '
        f'[ms]; loops over the general solvers are {DIRECTIONS:,} times their median for one '
        'direction:', '',
        document.table(['contacts', 'Clarabel', 'ECOS', 'SCS', 'CVXPY cached', '`wrench_map`',
                        'with forces', '`evaluate_many`', 'Clarabel / map', 'cached / map'],
                       maps), '', *targets(sizes), '',
        '![Time of one problem over the contacts](images/solvers.png)'])


def targets(sizes):
    """Compare with what was asked for."""
    eight = sizes[8]
    power = {name: math.log(sizes[256][name] / eight[name]) / math.log(32.0)
             for name in ('map', 'kernel')}
    ratios = {n: sizes[n]['clarabel'] / sizes[n]['kernel'] for n in (3, 8)}
    return [document.table(['figure', 'asked for', 'measured'], [
        ['one direction, Clarabel over kernel, 3 / 8 contacts', f'at least {TARGETS["single"]:g}',
         f'{ratios[3]:.1f} / {ratios[8]:.1f}'],
        ['map, 8 contacts, loop over Clarabel over ours', f'at least {TARGETS["map"]:g}',
         f'{eight["clarabel"] / eight["map"]:.0f}'],
        ['the same against CVXPY cached', f'at least {TARGETS["cached"]:g}',
         f'{eight["cached"] / eight["map"]:.0f}'],
        ['map, 8 contacts [ms]', f'below {TARGETS["ms"]:g}',
         ms(eight['map'] * DIRECTIONS)],
        ['forces included, over without', f'at most {TARGETS["forces"]:g}',
         f'{eight["forces"] / eight["map"]:.2f}'],
        ['exponent of the time from 8 to 256 contacts, map / one direction',
         f'at most {TARGETS["power"]:g}', f'{power["map"]:.2f} / {power["kernel"]:.2f}']])]


def us(seconds):
    """Write a time in microseconds."""
    return '' if seconds is None else f'{1e6 * seconds:,.0f}'


def ms(seconds):
    """Write a time in milliseconds."""
    return f'{1e3 * seconds:,.1f}'

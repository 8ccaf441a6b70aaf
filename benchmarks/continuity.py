# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Published forces while contacts move: how far they jump, and what alpha it costs to keep them calm.

Each contact rolls on a ball along a winding path, 0.1 mm and 0.1 degree a step, 1,000 steps at
100 Hz. Four ways to choose the forces: of the largest alpha; with a reserve; that and a rate
limit; the rate limit alone. Every force set is checked for cones, caps and equilibrium apart from
the solver.
"""

from pathlib import Path

from benchmarks.document import table
from grasp_quality import build_problem, Contact, evaluate, Grasp, TaskWrench
from grasp_quality.follow import follow
import numpy as np

STEPS = 1000
STRIDE, TURN = 1e-4, np.deg2rad(0.1)  # [m], [rad] of every contact a step
RADIUS = STRIDE / TURN                # [m] of the ball, on which one makes the other
PERIOD = 0.01                         # [s] of a step
CAP, FRICTION = 10.0, 0.5             # [N], [-]
TASK = TaskWrench([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
HANDS = tuple((count, seed) for count in (3, 4, 5) for seed in range(4))
WAYS = (('largest alpha', 0.0, 0.0), ('alpha_reserve 0.02', 0.02, 0.0),
        ('both', 0.02, 20.0), ('force_rate_limit 20 N/s', 0.0, 20.0))
SHOWN = (5, 3)
PICTURE = Path(__file__).parents[1] / 'docs' / 'images' / 'continuity.png'


def paths(count, seed):
    """Return unit vectors (steps + 1, count, 3) of contacts that wander over a ball."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, 3))
    for _ in range(200):  # spread them first, as fingers are
        points /= np.linalg.norm(points, axis=1)[:, None]
        apart = points[:, None] - points[None]
        distance = np.linalg.norm(apart, axis=2) + np.eye(count)
        points += 0.02 * (apart / distance[..., None] ** 3).sum(axis=1)
    points /= np.linalg.norm(points, axis=1)[:, None]
    heading, bend = rng.normal(size=(count, 3)), 0.01 * rng.normal(size=(count, 1))
    found = []
    for _ in range(STEPS + 1):
        found.append(points.copy())
        heading -= (heading * points).sum(axis=1)[:, None] * points
        heading /= np.linalg.norm(heading, axis=1)[:, None]
        points, heading = (np.cos(TURN) * points + np.sin(TURN) * heading,
                           np.cos(TURN) * heading - np.sin(TURN) * points)
        heading = np.cos(bend) * heading + np.sin(bend) * np.cross(points, heading)
    return np.array(found)


def grasp_at(points):
    """Fingers on the ball that press towards its centre."""
    return Grasp([Contact(position=RADIUS * p, normal=-p, friction=FRICTION, max_normal_force=CAP)
                  for p in points])


def follow_path(points, reserve, rate):
    """Return forces (steps + 1, k, 3) in object axes, alpha and its largest value, by step."""
    forces, alphas, largest, start = [], [], [], None
    for grasp in map(grasp_at, points):
        solution = evaluate(grasp, TASK, alpha_reserve=reserve, start=start)
        start = solution if reserve else None
        if rate and forces:
            last = np.zeros((len(grasp), 4))
            last[:, :3] = np.einsum('kji,kj->ki', grasp.rotations, forces[-1])
            solution = follow(
                build_problem(grasp, TASK), solution, last, rate * PERIOD).solution
        check(grasp, solution)
        forces.append(np.einsum('kij,kj->ki', grasp.rotations, solution.forces[:, :3]))
        alphas.append(solution.alpha)
        largest.append(solution.alpha_upper)
    return np.array(forces), np.array(alphas), np.array(largest)


def check(grasp, solution):
    """Raise where forces are not admissible or do not apply their alpha."""
    n, slide = solution.forces[:, 2], np.linalg.norm(solution.forces[:, :2], axis=1)
    rest = grasp.wrench(solution.forces) - solution.alpha * TASK.wrench
    if (slide > FRICTION * n * (1 + 1e-9) + 1e-9 * CAP).any() or n.max() > CAP * (1 + 1e-9) \
            or np.abs(rest).max() > 1e-6:
        raise AssertionError(f'not admissible: {solution.forces}, {rest}')


def jumps(forces):
    """Largest change of any contact's force from each step to the next [N]."""
    return np.linalg.norm(np.diff(forces, axis=0), axis=2).max(axis=1)


def measure():
    """Follow all paths, draw one, and return the section's text."""
    rows = []
    for count, seed in HANDS:
        points = paths(count, seed)
        found = [follow_path(points, reserve, rate) for _, reserve, rate in WAYS]
        leaps = [jumps(forces).max() for forces, _, _ in found]
        shares = [(alpha / best).min() for _, alpha, best in found]
        rows.append([count, seed, *(f'{leap:.2f}' for leap in leaps),
                     f'{leaps[0] / leaps[1]:.1f}', f'{leaps[0] / leaps[2]:.1f}',
                     *(f'{share:.4f}' for share in shares[1:])])
        if (count, seed) == SHOWN:
            draw(found)
    names = [name for name, _, _ in WAYS]
    return '\n'.join([
        '## Continuity', '',
        f'`python -m benchmarks continuity`: fingers that wander {STEPS:,} steps of '
        f'{1e3 * STRIDE:g} mm and {np.rad2deg(TURN):g} degree over a ball of '
        f'{1e3 * RADIUS:.1f} mm, caps {CAP:g} N, friction {FRICTION:g}, a force along z as the '
        'task, 100 Hz. Largest jump of any force from one step to the next [N], how many times '
        'smaller it is, and the smallest share of the largest alpha on the way.', '',
        table(['fingers', 'path', *(f'jump, {name}' for name in names), 'reserve: times smaller',
               'both: times smaller', *(f'least alpha, {name}' for name in names[1:])], rows)])


def draw(found):
    """Draw forces, jumps and alpha of the first three ways."""
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(3, 3, figsize=(12, 8), sharex=True, sharey='row')
    for column, ((name, _, _), (forces, alphas, largest)) in enumerate(zip(WAYS[:3], found)):
        top, middle, bottom = axes[:, column]
        top.set_title(name)
        top.plot(np.linalg.norm(forces, axis=2), linewidth=1)
        middle.semilogy(np.maximum(jumps(forces), 1e-4), linewidth=1)
        bottom.plot(alphas / largest, linewidth=1)
        bottom.set_xlabel('step of 0.1 mm and 0.1 degree')
    for row, label in enumerate(('force of each contact [N]', 'largest change a step [N]',
                                 'alpha over its largest')):
        axes[row, 0].set_ylabel(label)
        for axis in axes[row]:
            axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=90)
    plt.close(figure)

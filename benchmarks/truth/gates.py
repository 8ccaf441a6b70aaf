# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The bounds that the measurements must keep; they were fixed before the first run."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchmarks.truth.trials import Results
import numpy as np

FEWEST_CASES = 120
CLOSE, NEAR, FAR = 0.02, 0.03, 0.10
MOST = 0.95
FEW = 0.05                   # of the cases that may come out right with wrong friction
EDGES = 0.20                 # median error of four-edged cones that must be exceeded
LAW = 1.001
DCLAW_LOWEST, DCLAW_HIGHEST, CUBE_MEDIAN = 0.97, 1.03, 1.05


@dataclass(frozen=True)
class Gate:
    """One bound: what it is about, what was found, and whether that is within the bound."""

    what: str
    found: str
    bound: str
    kept: bool


def all_gates(results: Results) -> list[Gate]:
    """Return all gates, kept or not."""
    return [*_points(results), *_controls(results), *_law(results), *_dclaw(results)]


def errors(ratios: Sequence[float]) -> 'np.ndarray':
    """Return how far ratios are from 1; what has no value is infinitely far."""
    off = np.abs(np.array(ratios, dtype=np.float64) - 1.0)
    return np.nan_to_num(off, nan=np.inf, posinf=np.inf)


def _share(ratios: Sequence[float], limit: float) -> float:
    """Return the share of the ratios within a limit of 1."""
    return float((errors(ratios) <= limit).mean())


def _points(results: Results) -> Iterator[Gate]:
    """Yield the gates of the contact-point hand."""
    count = len(results.points)
    yield Gate('Contact points: random cases', str(count), f'at least {FEWEST_CASES}',
               count >= FEWEST_CASES)
    optimised = [point.optimised.ratio for point in results.points]
    passive = [pull.pulled.ratio for pull in results.passive]
    yield _all_within('Contact points, optimised forces: all cases', optimised, NEAR)
    yield _most_within('Contact points, optimised forces: most cases', optimised)
    yield _most_within(f'Contact points, constant normals: most of {len(passive)}', passive)
    yield _all_within(f'Contact points, constant normals: all of {len(passive)}', passive, FAR)


def _all_within(what: str, ratios: Sequence[float], limit: float) -> Gate:
    """Return the gate that all ratios are near 1."""
    worst = errors(ratios).max()
    return Gate(what, f'worst off by {worst:.2%}', f'within {limit:.0%}', bool(worst <= limit))


def _most_within(what: str, ratios: Sequence[float]) -> Gate:
    """Return the gate that nearly all ratios are very near 1."""
    share = _share(ratios, CLOSE)
    return Gate(what, f'{share:.1%} within {CLOSE:.0%}', f'at least {MOST:.0%}', share >= MOST)


def _controls(results: Results) -> Iterator[Gate]:
    """Yield the gates that wrong predictions must be found wrong."""
    for index, name in enumerate(('too much', 'too little')):
        share = _share([point.wrong[index] for point in results.points if point.passive], CLOSE)
        yield Gate(f'Negative control, 10 % {name} friction', f'{share:.1%} within {CLOSE:.0%}',
                   f'at most {FEW:.0%}', share <= FEW)
    for index, name in enumerate(('optimised forces', 'constant normals')):
        median = float(np.median(errors([point.four_edges[index] for point in results.points
                                         if point.passive or index == 0])))
        yield Gate(f'Negative control, cones of four edges, {name}',
                   f'off by {median:.1%} in the median', f'more than {EDGES:.0%}',
                   median > EDGES)


def _law(results: Results) -> Iterator[Gate]:
    """Yield the gate of the bound law."""
    pulls = [point.optimised for point in results.points]
    pulls += [pull.pulled for pull in results.passive]
    pulls += [pull for pulled in results.dclaw.values() for pull in pulled]
    largest = max(pull.bound for pull in pulls)
    yield Gate(f'Bound law in {sum(pull.samples for pull in pulls)} samples',
               f'largest ratio {largest:.5f}', f'at most {LAW}', largest <= LAW)


def _dclaw(results: Results) -> Iterator[Gate]:
    """Yield the gates of D'Claw."""
    ball = [pull.ratio for pull in results.dclaw['ball, PCWF']]
    cube = [pull.ratio for pull in results.dclaw['cube, PCWF']]
    yield Gate(f"D'Claw, ball, {len(ball)} directions", f'{min(ball):.4f} to {max(ball):.4f}',
               f'{DCLAW_LOWEST} to {DCLAW_HIGHEST}',
               min(ball) >= DCLAW_LOWEST and max(ball) <= DCLAW_HIGHEST)
    yield Gate(f"D'Claw, cube, {len(cube)} directions: smallest", f'{min(cube):.4f}',
               f'at least {DCLAW_LOWEST}', min(cube) >= DCLAW_LOWEST)
    yield Gate(f"D'Claw, cube, {len(cube)} directions: median", f'{np.median(cube):.4f}',
               f'at most {CUBE_MEDIAN}', float(np.median(cube)) <= CUBE_MEDIAN)

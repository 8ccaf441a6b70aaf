# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/truth.md."""

from collections.abc import Iterator, Sequence
from typing import Any

from benchmarks.document import machine, table
from benchmarks.truth.gates import CLOSE, errors, Gate
from benchmarks.truth.slow_pull import Pulled
from benchmarks.truth.trials import PointResult, Results
import numpy as np

MUCH = 100.0                 # larger ratios are not worth digits


def verdict_table(gates: Sequence[Gate]) -> str:
    """Return the gates as a table."""
    return str(table(['bound', 'measured', 'required', ''],
                     [[gate.what, gate.found, gate.bound, 'kept' if gate.kept else '**broken**']
                      for gate in gates]))


def ratio_table(results: Results) -> str:
    """Return how the ratios of load at slip over prediction spread."""
    points = results.points
    known = [point for point in points if point.passive is not None]
    rows = [_row('contact points, optimised forces', [p.optimised.ratio for p in points]),
            _row('contact points, constant normals of the optimum',
                 [p.pulled.ratio for p in results.passive if p.at_optimum]),
            _row('contact points, constant balanced normals',
                 [p.pulled.ratio for p in results.passive if not p.at_optimum])]
    rows += [_row(f"D'Claw, {name}", [pull.ratio for pull in pulls])
             for name, pulls in results.dclaw.items()]
    rows += [_row('wrong on purpose: friction 10 % too large', [p.wrong[0] for p in known]),
             _row('wrong on purpose: friction 10 % too small', [p.wrong[1] for p in known]),
             _row('wrong on purpose: four edges, optimised forces',
                  [p.four_edges[0] for p in points]),
             _row('wrong on purpose: four edges, constant normals',
                  [p.four_edges[1] for p in known])]
    return str(table(['load at slip / prediction', 'pulls', 'smallest', '5 %', 'median', '95 %',
                      'largest', 'within 2 %'], rows))


def _row(name: str, ratios: Sequence[float]) -> list[Any]:
    """Return one row of the table of ratios."""
    values = np.nan_to_num(np.array(ratios, dtype=np.float64), nan=np.inf, posinf=np.inf)
    quantiles = np.quantile(values, [0.0, 0.05, 0.5, 0.95, 1.0],
                            method='nearest') if len(values) else [np.nan] * 5
    return [name, len(values), *map(_number, quantiles),
            f'{(errors(values) <= CLOSE).mean():.1%}' if len(values) else '']


def _number(ratio: float) -> str:
    """Return a ratio as text."""
    return f'{ratio:.4f}' if ratio < MUCH else 'far'


def worst_table(results: Results, count: int = 5) -> str:
    """Return the cases that are off by most."""
    rows = [(float(errors([pull.ratio])[0]), point.text, way, pull)
            for point in results.points for way, pull in _pulls(point)]
    rows.sort(key=lambda row: -row[0])
    return str(table(['case', 'pull', 'ratio', 'moved at 97 % of the load [um]'],
                     [[text, way, f'{pull.ratio:.4f}', f'{1e6 * pull.creep:.1f}']
                      for _, text, way, pull in rows[:count]]))


def _pulls(point: PointResult) -> Iterator[tuple[str, Pulled]]:
    """Yield the pulls of one case."""
    yield 'optimised forces', point.optimised
    if point.passive is not None:
        yield ('normals of the optimum' if point.passive.at_optimum else 'balanced normals',
               point.passive.pulled)


def circumstances(results: Results, seed: int, duration: float) -> str:
    """Return seed, number of cases, run time and machine."""
    given_up = sum(point.too_sensitive for point in results.points)
    return (f'Seed {seed}, {len(results.points)} cases, {given_up} other draws given up as too '
            f'sensitive to be measured, {duration / 60:.1f} minutes. {machine()}')

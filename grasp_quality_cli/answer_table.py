# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Answers as tables for people, in words and with units."""

from __future__ import annotations

from collections.abc import Iterator

from grasp_quality import Status, TaskCone, TaskEllipsoid, TaskPolytope
from grasp_quality_cli.answer_rows import Row
from grasp_quality_cli.grasp_file import Task
from grasp_quality_cli.printing import print_facts, print_table
import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.markup import escape
from rich.table import Table

REASONS = {'slip': 'by slip', 'cap': 'by its cap', 'joint': 'by its torque limit'}
DUST = 1e-6  # share of the largest force that a proof does not tell from zero
TINY = 1e-300  # smaller ones have no fourth digit
DIGITS = 4  # of the largest force or moment
NO_MARGIN = 0.001  # of the friction cone, below which forces stand on its edge


def print_answer(console: Console, row: Row, task: Task) -> None:
    """Print one row of answer_rows as tables."""
    if 'answers' not in row:
        _print_one(console, row)
        return
    for i, one in enumerate(row['answers']):
        console.print(f'[bold]Wrench {i + 1}: {numbers(_wrenches_of(task)[i])}[/bold]')
        _print_one(console, one)
    console.print('[bold]All together[/bold]')
    print_facts(console, _together(row))


def _wrenches_of(task: Task) -> NDArray[np.float64]:
    if isinstance(task, TaskPolytope):
        return task.wrenches
    if isinstance(task, TaskEllipsoid):
        return np.concatenate([task.axes, -task.axes])
    return np.array([task.axis if isinstance(task, TaskCone) else task.wrench])


def _together(row: Row) -> Iterator[tuple[str, str]]:
    yield 'quality', f'{row["quality"]:.4f}, the weighted sum of the alphas'
    yield 'alpha_min', f'{row["alpha_min"]:.4f}, the smallest of them'
    if row['parallelotope_scale'] is not None:
        yield ('parallelotope_scale', f'{row["parallelotope_scale"]:.4f} of the box that the '
               'alphas span is held in all its corners')
    if row['guaranteed_scale'] is not None:
        yield 'guaranteed_scale', f'{row["guaranteed_scale"]:.4f} of the ellipsoid is held'


def _print_one(console: Console, row: Row) -> None:
    if row['status'] == Status.INFEASIBLE.name:
        console.print('[bold red]INFEASIBLE[/bold red]: no contact forces inside the friction '
                      'cones and the caps balance the load together with any share of the task')
        return
    table = Table(header_style='bold')
    for name in ('contact', 't1\n[N]', 't2\n[N]', 'normal\n[N]', 'moment\n[N m]', 'cone\nused',
                 'cap\nused'):
        table.add_column(name, justify='left' if name == 'contact' else 'right',
                         no_wrap=name != 'contact')
    forces = np.array([contact['force'] for contact in row['forces']])
    for contact, force in zip(row['forces'], rounded(forces)):
        table.add_row(escape(contact['name']), *(f'{value:.4g}' for value in force),
                      f'{contact["cone_usage"]:.1%}', f'{contact["cap_usage"]:.1%}')
    print_facts(console, _facts(row))
    print_table(console, table)


def _facts(row: Row) -> Iterator[tuple[str, str]]:
    yield 'status', row['status']
    if row['powerless']:
        yield 'alpha', row['remark'].removeprefix('alpha is ')
    else:
        yield ('alpha',
               f'{row["alpha"]:.6g} times the task (proved: at most {row["alpha_upper"]:.6g})')
    if not row['holdable']:
        yield ('alpha_lower', f'{row["alpha_lower"]:.6g}: the load alone is not held, alpha must '
               f'lie between {row["alpha_lower"]:.6g} and {row["alpha"]:.6g}')
    if row['pinned'] and not row['powerless']:
        yield 'pinned', row['remark'].removeprefix('alpha is pinned: ')
    if 'alpha_axis' in row:
        yield 'alpha_axis', f'{row["alpha_axis"]:.6g} along the bare axis of the cone'
    if row.get('alpha_worst') is not None:
        yield 'alpha_worst', f'{row["alpha_worst"]:.6g} in the worst sampled direction of it'
    if not row['powerless']:
        yield 'wrench', numbers(row['wrench']) + ' [N, N m]'
    edge = ': the forces stand on the edge of slipping, see --barrier-weight'
    yield ('friction margin', f'{row["friction_margin"]:.1%}'
           + (edge if row['friction_margin'] < NO_MARGIN else ''))
    if row['limited_by']:
        yield 'limited by', escape(limits(row['limited_by']))


def limits(limited_by: dict[str, str]) -> str:
    """Name what limits the task most, and how; several when they do so alike."""
    names, ways = list(limited_by), [REASONS[reason] for reason in limited_by.values()]
    if len(names) == 1:
        return f'{names[0]}, {ways[0]}'
    if len(set(ways)) > 1:
        names = [f'{name} ({way})' for name, way in zip(names, ways)]
    together = f'{", ".join(names[:-1])} and {names[-1]} alike'
    return together if len(set(ways)) > 1 else f'{together}, {ways[0]}'


def numbers(values: NDArray[np.float64] | list[float]) -> str:
    """Write a wrench for people, without the dust of the solver."""
    return ' '.join(f'{value:.4g}' for value in rounded(np.asarray(values)))


def rounded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """
    Keep of each number what stands before the fifth digit of the largest of its unit.

    Parameters
    ----------
    values : (..., 4) or (..., 6) array
        Contact forces [t1, t2, n, m_n], or wrenches; the first three are in N, the rest in N m.

    Returns
    -------
    (..., 4) or (..., 6) array
        What is below DUST of the largest of all is zero as well.

    """
    kept = np.where(np.abs(values) <= DUST * np.abs(values).max(initial=0.0), 0.0, values)
    for unit in (kept[..., :3], kept[..., 3:]):
        largest = np.abs(unit).max(initial=0.0)
        if TINY < largest < np.inf:
            digit = 10.0 ** (int(np.floor(np.log10(largest))) + 1 - DIGITS)
            unit[:] = np.round(unit / digit) * digit + 0.0  # no minus zero
    return kept

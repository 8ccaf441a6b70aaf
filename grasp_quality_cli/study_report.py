# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How a study is told: a progress bar, bad rows as they are found, and the summary."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import Any

from grasp_quality_cli.study_rows import Chunk
from grasp_quality_cli.study_score import BAD_ROW
import pyarrow.compute as pc
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table

BAD_ROWS_SHOWN = 20


class Report:
    """
    Progress of a study on standard error; the bar is drawn only where that is a terminal.

    Parameters
    ----------
    weight : int
        Of the whole dataset.

    """

    def __init__(self, weight: int) -> None:
        self._console = Console(stderr=True, markup=False)
        self._progress = Progress(
            TextColumn('{task.fields[rows]} rows, {task.fields[bad]} bad'), BarColumn(),
            TaskProgressColumn(), TimeRemainingColumn(), console=self._console,
            disable=not self._console.is_terminal)
        self._task = self._progress.add_task('', total=weight, rows=0, bad=0)
        self._rows = self._bad = 0

    def __enter__(self) -> Report:
        """Draw the bar."""
        self._progress.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None,
                 traceback: TracebackType | None) -> None:
        """Leave the bar as it stands."""
        self._progress.stop()

    def kept(self, chunk: Chunk, rows: int, bad: int) -> None:
        """Note a chunk that an earlier run has done."""
        self._advance(chunk, rows, bad)

    def scored(self, chunk: Chunk, answers: Any) -> None:
        """Note a chunk, and tell its bad rows, unless there were too many already."""
        is_bad = pc.equal(answers['status'], BAD_ROW)
        reasons = answers.filter(is_bad)['reason'].to_pylist()
        for reason in reasons[:max(0, BAD_ROWS_SHOWN - self._bad)]:
            self._console.print(f'bad row: {escape(reason)}', highlight=False, soft_wrap=True)
        if self._bad <= BAD_ROWS_SHOWN < self._bad + len(reasons):
            self._console.print('more bad rows follow: all stand in the file of bad rows')
        self._advance(chunk, len(answers), len(reasons))

    def _advance(self, chunk: Chunk, rows: int, bad: int) -> None:
        self._rows += rows
        self._bad += bad
        self._progress.update(
            self._task, advance=chunk.weight, rows=self._rows, bad=self._bad)


def print_summary(summary: Mapping[str, Any]) -> None:
    """Print the summary for people."""
    facts = Table.grid(padding=(0, 2))
    facts.add_row('rows', f'{summary["rows"]}, of which {summary["scored"]} scored and '
                  f'{summary["bad_rows"]} bad')
    facts.add_row('answers', f'{summary["feasible"]} feasible, {summary["infeasible"]} '
                  f'infeasible, {summary["unproved"]} without proof')
    if summary['feasible']:
        facts.add_row('alpha', f'mean {summary["alpha_mean"]:.6g}, largest '
                      f'{summary["alpha_max"]:.6g} in row {summary["best_row"]}')
    if summary['seconds'] is not None:
        facts.add_row('time', f'{summary["seconds"]:.1f} s for {summary["rows_now"]} rows; '
                      f'{summary["rows_before"]} were there from before')
    facts.add_row('answers in', escape(summary['output']))
    if summary['bad_rows_file']:
        facts.add_row('bad rows in', escape(summary['bad_rows_file']))
    Console(soft_wrap=True, markup=False).print(facts)

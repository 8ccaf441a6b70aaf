# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Tables on standard output, in which no number is ever cut."""

from __future__ import annotations

from collections.abc import Iterable
import os

from rich.cells import cell_len
from rich.console import Console
from rich.table import Table

PIPE_COLUMNS = 160  # where there is no window to fit in
LEAST_COLUMNS = 8  # of a text that is folded


def console(markup: bool = False) -> Console:
    """Return standard output, as wide as its window or COLUMNS say, and wide where none does."""
    made = Console(markup=markup)
    if not made.is_terminal and not os.environ.get('COLUMNS', '').isdigit():
        made.width = PIPE_COLUMNS
    return made


def print_facts(console: Console, facts: Iterable[tuple[str, str]]) -> None:
    """Print names, and what there is to say of each."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(no_wrap=True)
    grid.add_column()
    for name, text in facts:
        grid.add_row(name, text)
    print_table(console, grid)


def print_table(console: Console, table: Table) -> None:
    """
    Print a table in which columns with no_wrap keep their width, and texts are folded.

    In a window that is narrower than its numbers the table sticks out.
    """
    for column in table.columns:
        if column.no_wrap:
            column.min_width = max(
                (cell_len(line) for cell in (column.header, *column.cells)
                 for line in str(cell).splitlines()), default=0)
        else:
            column.overflow, column.min_width = 'fold', LEAST_COLUMNS
    width = console.width
    console.width = max(width, 1 + sum((column.min_width or 0) + 3 for column in table.columns))
    console.print(table)
    console.width = width

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality figures``: the figures of the paper, made by this software."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from grasp_quality_cli.output import print_json
from grasp_quality_cli.paper_numbers import numbers
from grasp_quality_cli.printing import console, print_table
from grasp_quality_cli.task_text import make_folder
from rich.table import Table
import typer


def paper_figures(
        output: Annotated[Path, typer.Option(
            '--output', '-o', help='Folder for the pictures.')] = Path('paper_figures'),
        json: Annotated[bool, typer.Option('--json', help='Print JSON instead of tables.')] = False
) -> None:
    """
    Draw the figures of the paper again, and print the numbers beside them.

    Fig. 3 (a grasp with eight contacts and its force map), Fig. 5 (a single direction against a
    task cone), Fig. 6 (the same in a flat wrench space) and Fig. 7 (robustness against magnitude).
    docs/paper.md says what is the paper's and what is ours.
    """
    from grasp_quality_cli.paper_pictures import draw_all  # matplotlib is slow to import

    make_folder(output)
    found, files = numbers(), draw_all(output)
    if json:
        print_json({'numbers': [number.row() for number in found],
                    'pictures': [str(file) for file in files]})
        return
    table = Table(header_style='bold')
    for name in ('figure', 'what', 'expected', 'here'):
        table.add_column(name, justify='left' if name == 'what' else 'right',
                         no_wrap=name != 'what')
    for number in found:
        table.add_row(number.figure, number.what, f'{number.expected:.6g}',
                      f'{number.here:.6g}')
    print_table(console(), table)
    for file in files:
        print(file)

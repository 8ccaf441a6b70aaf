# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality evaluate``: alpha and forces of one grasp for one task."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from grasp_quality import evaluate, Status
from grasp_quality_cli.answer_rows import answer_row
from grasp_quality_cli.answer_table import print_answer
from grasp_quality_cli.grasp_file import read_grasp_file
from grasp_quality_cli.output import INFEASIBLE, print_json
from grasp_quality_cli.printing import console
from grasp_quality_cli.task_text import chosen_load, chosen_task, LOAD_HELP, TASK_HELP
import typer


def evaluate_grasp(
        grasp: Annotated[Path, typer.Argument(help='Grasp file, see docs/grasp_files.md.')],
        task: Annotated[str | None, typer.Option(help=TASK_HELP, show_default=False)] = None,
        external_wrench: Annotated[str | None, typer.Option(
            help=LOAD_HELP + ' Instead of that of the grasp file.', show_default=False)] = None,
        barrier_weight: Annotated[float, typer.Option(
            help='Weight of the friction margin, eq. (11), in the unit of alpha: above 0 the '
            'forces keep away from slipping, and alpha gets smaller.', min=0.0)] = 0.0,
        json: Annotated[bool, typer.Option('--json', help='Print JSON instead of tables.')] = False
) -> None:
    """
    Tell how much of a task a grasp can apply, and with which contact forces.

    alpha multiplies the task as given: for the weight of the object it is a safety factor. Ends
    with code 1 when the task is infeasible.

    Example: grasp-quality evaluate examples/pinch.yaml --task "0 0 2 0 0 0"
    """
    source = read_grasp_file(grasp)
    chosen = chosen_task(task, source.tasks)
    answer = evaluate(
        source.grasp, chosen, chosen_load(external_wrench, source.external_wrench),
        barrier_weight)
    row = answer_row(source.grasp, answer)
    if json:
        print_json(row)
    else:
        print_answer(console(markup=True), row, chosen)
    if answer.status is Status.INFEASIBLE:
        raise typer.Exit(INFEASIBLE)

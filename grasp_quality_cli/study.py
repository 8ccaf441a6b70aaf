# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality study``: alpha of every grasp of a dataset, on all cores or a Dask cluster."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

from grasp_quality_cli.output import print_json, READ_IN_PART
import typer

TASK_HELP = (
    'Task for all rows: six numbers "fx fy fz tx ty tz" [N, N m], or a YAML file with one task; '
    'or the name of the task that every row has. Not needed where each row has exactly one.')


def study(
        dataset: Annotated[Path, typer.Argument(
            help='Grasps, one a line (.jsonl) or row (.parquet); see docs/study.md.')],
        output: Annotated[Path, typer.Option(
            '--output', '-o', help='Parquet file for the answers, one row a grasp.')],
        task: Annotated[str | None, typer.Option(help=TASK_HELP, show_default=False)] = None,
        external_wrench: Annotated[str | None, typer.Option(
            help='What the world does on the object besides the fingers, such as gravity: six '
            'numbers [N, N m]. Instead of those of the rows.', show_default=False)] = None,
        barrier_weight: Annotated[float, typer.Option(
            help='Weight of the friction margin, eq. (11), in the unit of alpha.', min=0.0)] = 0.0,
        forces: Annotated[bool, typer.Option(
            '--forces', help='Keep the contact forces too.')] = False,
        ignore: Annotated[list[str] | None, typer.Option(
            help='Field of the rows that is not to be read; may be given several times.',
            show_default=False)] = None,
        workers: Annotated[int, typer.Option(
            help='Processes on this machine; 0 takes one a core.', min=0)] = 0,
        scheduler: Annotated[str | None, typer.Option(
            help='Address of a Dask scheduler, such as tcp://host:8786: its workers score the '
            'rows instead of this machine.', show_default=False)] = None,
        chunk_rows: Annotated[int, typer.Option(
            help='Rows that are scored and kept together; a kill costs no more than twice as many '
            'for each worker.', min=1)] = 500,
        overwrite: Annotated[bool, typer.Option(
            '--overwrite', help='Begin anew, also where answers are there already.')] = False,
        json: Annotated[bool, typer.Option(
            '--json', help='Print the summary as JSON.')] = False) -> None:
    """
    Score every grasp of a dataset by how much of a task it can apply.

    A row that cannot be used is told with its line number, skipped, and
    written to OUTPUT.bad_rows.jsonl. However the study ends, the same command
    goes on where it was: nothing is lost and nothing is scored twice. Memory
    does not grow with the dataset.

    Example: grasp-quality study examples/grasps.jsonl --task "0 0 2 0 0 0" -o out.parquet
    """
    from grasp_quality_cli import study_run  # it imports much, which other commands do not need
    plan = study_run.Plan.of(
        dataset, output, task, external_wrench, barrier_weight, forces, tuple(ignore or ()),
        chunk_rows)
    count = workers or len(os.sched_getaffinity(0))
    summary = study_run.run(plan, count, scheduler, overwrite)
    if json:
        print_json(summary)
    else:
        study_run.print_summary(summary)
    if summary['bad_rows']:
        raise typer.Exit(READ_IN_PART)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality bag``: alpha, margin and forces over the time of a recorded bag."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

from grasp_quality_cli.bag_inputs import BagInputs
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_replay import contact_source, Question, replay, require_contacts
from grasp_quality_cli.bag_report import moment, write_report
from grasp_quality_cli.bag_source import BagSource
from grasp_quality_cli.bag_summary import Summary
from grasp_quality_cli.bag_tables import FORMATS, Tables
from grasp_quality_cli.node_settings import read_settings
from grasp_quality_cli.output import print_json, READ_IN_PART
from grasp_quality_cli.printing import console, print_table
from grasp_quality_cli.task_text import (
    ArgumentError, chosen_load, chosen_task, LOAD_HELP, make_folder, NAMELESS_TASK_HELP)
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table
import typer


def evaluate_bag(
        bag: Annotated[Path, typer.Argument(
            help='Folder of a rosbag2, or one of its .mcap or .db3 files.')],
        task: Annotated[str | None, typer.Option(
            help=NAMELESS_TASK_HELP + ' Without it: as recorded on <node>/task_wrench.',
            show_default=False)] = None,
        external_wrench: Annotated[str | None, typer.Option(
            help=LOAD_HELP + ' Without it: as recorded on <node>/external_wrench.',
            show_default=False)] = None,
        node: Annotated[str, typer.Option(
            help='Name of the node whose input topics were recorded.')] = '/grasp_quality',
        params: Annotated[Path | None, typer.Option(
            help='Parameter file of the node (friction, caps, contact_names, ...), such as '
            'config/grasp_quality.yaml.', show_default=False)] = None,
        assignments: Annotated[list[str] | None, typer.Option(
            '--set', help='One parameter of the node, name=value; may be given several times.',
            show_default=False)] = None,
        output: Annotated[Path | None, typer.Option(
            '--output', '-o', help='Folder for tables and report.',
            show_default='<bag>_grasp_quality')] = None,
        table_format: Annotated[str, typer.Option(
            '--format', help='Of the tables: parquet or csv.')] = 'parquet',
        json: Annotated[bool, typer.Option('--json', help='Print JSON instead of tables.')] = False
) -> None:
    """
    Evaluate a recorded bag: alpha, margin and forces over time, as tables and a report.

    Needs no ROS. Reads rosbag2 (MCAP and SQLite) with the input topics of the node and replays
    them through the code of the node. What cannot be read or evaluated is listed with its time; a
    bag that breaks off is read as far as it goes, and ends with code 1.

    Example: grasp-quality bag build/demo/bag --task "0 0 1 0 0 0"
    """
    if table_format not in FORMATS:
        raise ArgumentError(f'--format must be one of {", ".join(FORMATS)}, got {table_format!r}')
    source = BagSource(bag)
    question = Question(
        read_settings(params, assignments or [], node, contact_source(source, node)), node,
        None if task is None else chosen_task(task, None), chosen_load(external_wrench, None))
    folder = output or bag.with_name(f'{bag.stem}_grasp_quality')
    require_contacts(source, question)
    make_folder(folder)
    with Problems(folder / 'problems.csv') as problems:
        wants = BagInputs(question.settings, node, question.task, question.load, problems).wants
        with Tables(folder, table_format) as tables, _progress(source.total(wants)) as advance:
            summary = replay(source, question, tables, problems, advance)
        topics = {key: (count, wants(key[0])) for key, count in source.counts.items()}
        report = folder / 'report.html'
        write_report(report, bag.name, _asked(question, task, external_wrench), summary, problems,
                     topics)
        files = [report, *tables.paths, folder / 'problems.csv']
        if json:
            print_json({**summary.row(), 'problems': _problem_rows(problems),
                        'damage': source.damage, 'files': [str(file) for file in files]})
        else:
            _print(console(), summary, problems, files)
    if source.damage or not summary.samples:
        raise typer.Exit(READ_IN_PART)


@contextmanager
def _progress(total: int | None) -> Iterator[Callable[[int], None]]:
    """Show a bar on standard error, where that is a terminal."""
    shown = Console(stderr=True, markup=False)
    columns = (TextColumn('reading'), BarColumn(), MofNCompleteColumn(), TextColumn('messages'),
               TimeRemainingColumn())
    with Progress(*columns, console=shown, disable=not shown.is_terminal) as progress:
        bar = progress.add_task('reading', total=total)
        yield lambda count: progress.update(bar, advance=count)


def _asked(question: Question, task: str | None, load: str | None) -> dict[str, str]:
    settings = question.settings
    return {
        'task': task or 'as recorded', 'external wrench': load or 'as recorded, or none',
        'contacts': settings.contact_source, 'node': question.node,
        'model': f'{settings.contact_model}, friction {settings.friction_coefficient:g}, '
        f'torsional friction {settings.torsional_friction_coefficient:g} m, caps '
        f'{settings.max_normal_force:g} N (where the messages do not say otherwise)',
        'bound': settings.force_bound, 'barrier weight': f'{settings.barrier_weight:g}',
        'stale after': f'{settings.max_contact_age:g} s'}


def _problem_rows(problems: Problems) -> list[dict[str, Any]]:
    return [{'kind': kind, 'topic': topic, 'count': known.count, 'first_ns': known.first_ns,
             'last_ns': known.last_ns, 'text': known.text}
            for (kind, topic), known in problems.kinds.items()]


def _print(console: Console, summary: Summary, problems: Problems, files: list[Path]) -> None:
    if summary.samples:
        _print_summary(console, summary)
    else:
        console.print('no contacts that could be used, and no answers')
    if problems.count:
        listed = Table(title=f'{problems.count:,} problems', header_style='bold')
        for name in ('kind', 'topic', 'count', 'first (UTC)', 'what'):
            listed.add_column(name, no_wrap=name in ('count', 'first (UTC)'))
        for one in _problem_rows(problems):
            listed.add_row(one['kind'], one['topic'], f'{one["count"]:,}',
                           moment(one['first_ns']), one['text'])
        print_table(console, listed)
    for file in files:
        console.print(str(file), soft_wrap=True)


def _print_summary(console: Console, summary: Summary) -> None:
    table = Table(header_style='bold')
    for name in ('result', 'samples', 'first reason'):
        table.add_column(name, justify='right' if name == 'samples' else 'left',
                         no_wrap=name != 'first reason')
    for code, count in summary.codes.most_common():
        table.add_row(code, f'{count:,}', summary.reasons.get(code, ''))
    row = summary.row()
    console.print(f'{summary.samples:,} contact samples from {moment(summary.first_ns)} to '
                  f'{moment(summary.last_ns)} UTC')
    print_table(console, table)
    console.print(f'alpha from {row["alpha_min"]:.6g} to {row["alpha_max"]:.6g}')

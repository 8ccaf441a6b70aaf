# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A study from begin to end: what it asks, what is done already, who does the rest, what came out.

What decides the answers and the cutting of the dataset is the study's plan. It is kept beside the
parts, and in the output, so that answers to different questions are never mixed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
import time
from typing import Any

from grasp_quality_cli.grasp_file import read_task
from grasp_quality_cli.study_error import StoppedError
from grasp_quality_cli.study_parts import Parts
from grasp_quality_cli.study_report import print_summary, Report
from grasp_quality_cli.study_rows import Chunk, Dataset
from grasp_quality_cli.study_score import Question, score
from grasp_quality_cli.study_workers import dask_workers, local_workers, work_off
from grasp_quality_cli.task_text import chosen_load, chosen_task, require_folder
from grasp_quality_cli.yaml_source import parse_yaml, read_text

__all__ = ['Plan', 'print_summary', 'run']
FORMAT = 1  # of the parts and the output


@dataclass(frozen=True, eq=False)
class Plan:
    """
    What a study is.

    Attributes
    ----------
    dataset : Dataset
    question : Question
    parts : Parts
    chunk_rows : int

    """

    dataset: Dataset
    question: Question
    parts: Parts
    chunk_rows: int

    @classmethod
    def of(cls, dataset: Path, output: Path, task: str | None, external_wrench: str | None,
           barrier_weight: float, forces: bool, ignored: tuple[str, ...],
           chunk_rows: int) -> Plan:
        """Read the command line; the arguments are those of ``study``."""
        source = Dataset.of(dataset)
        require_folder(output)
        question = Question(str(dataset), task, chosen_load(external_wrench, None),
                            barrier_weight, forces, ignored)
        yaml = task is not None and task.endswith(('.yaml', '.yml'))
        task_file = read_text(task) if yaml and task is not None else None  # a pipe is read once
        if task is not None and task_file is not None:
            question = replace(question, task=read_task(parse_yaml(task_file, task)))
        elif task is not None and (' ' in task.strip() or ',' in task):
            question = replace(question, task=chosen_task(task, None))
        file = dataset.stat()
        parts = Parts(output, {
            'format': FORMAT, 'dataset': dataset.name, 'size': file.st_size,
            'modified_ns': file.st_mtime_ns, 'task': task,
            'task_file': task_file,
            'external_wrench': external_wrench, 'barrier_weight': barrier_weight,
            'forces': forces, 'ignored': list(ignored), 'chunk_rows': chunk_rows})
        return cls(source, question, parts, chunk_rows)


def run(plan: Plan, workers: int, scheduler: str | None, overwrite: bool) -> dict[str, Any]:
    """
    Run a study, or what is left of it; return its summary.

    Parameters
    ----------
    plan : Plan
        From ``Plan.of``.
    workers : int
        Processes on this machine.
    scheduler : str or None
        Dask scheduler to use instead.
    overwrite : bool
        Whether to forget what is there.

    Raises
    ------
    StudyError, FileError

    """
    found = None if overwrite else plan.parts.finished()
    if found is not None:
        return {**found, 'seconds': None, 'rows_now': 0, 'rows_before': found['rows']}
    begin = time.monotonic()
    try:
        with plan.parts.opened(overwrite):
            chunks, before = _score_all(plan, workers, scheduler)
            summary = plan.parts.merge(chunks, plan.question.forces)
    except KeyboardInterrupt as exc:
        raise StoppedError('interrupted') from exc
    return {**summary, 'seconds': time.monotonic() - begin, 'rows_before': before,
            'rows_now': summary['rows'] - before}


def _score_all(plan: Plan, workers: int, scheduler: str | None) -> tuple[int, int]:
    """Score what is not there yet; return the number of chunks, and of rows there before."""
    chunks = before = 0
    with Report(plan.dataset.weight) as report, (
            dask_workers(scheduler) if scheduler else local_workers(workers)) as (pool, window):

        def missing() -> Any:
            nonlocal chunks, before
            for chunk in plan.dataset.chunks(plan.chunk_rows):
                chunks += 1
                if not plan.parts.has(chunk.index):
                    yield chunk
                    continue
                rows, bad = plan.parts.counted(chunk.index)
                before += rows
                report.kept(chunk, rows, bad)

        def keep(chunk: Chunk, answers: Any) -> None:
            plan.parts.put(chunk, answers)
            report.scored(chunk, answers)

        work_off(missing(), lambda chunk: pool.submit(score, chunk, plan.question), window, keep)
    return chunks, before

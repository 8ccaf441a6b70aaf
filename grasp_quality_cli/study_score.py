# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Scores one chunk of a dataset; runs in worker processes, here or on other machines.

A row that cannot be read becomes a row with status BAD_ROW and the reason, never an exception:
what comes out has as many rows as went in. Task wrenches of all rows are solved in one call.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from grasp_quality import (
    evaluate, evaluate_many, Grasp, GraspQualityError, Outcome, PolytopeSolution, SolverError,
    TaskWrench)
from grasp_quality_cli.grasp_file import read_grasp, Task
from grasp_quality_cli.json_source import JsonItem
from grasp_quality_cli.source_item import FileError, SourceItem
from grasp_quality_cli.study_rows import Chunk
import numpy as np
from numpy.typing import NDArray
import pyarrow as pa

BAD_ROW = 'BAD_ROW'
NO_LOAD = np.zeros(6)
SCHEMA = pa.schema([
    pa.field('row', pa.int64(), nullable=False), ('id', pa.string()),
    pa.field('status', pa.string(), nullable=False), ('alpha', pa.float64()),
    ('alpha_upper', pa.float64()), ('quality', pa.float64()),
    ('forces', pa.list_(pa.list_(pa.float64(), 4))), ('reason', pa.string())])


@dataclass(frozen=True, eq=False)
class Question:
    """
    What is asked about every row.

    Attributes
    ----------
    file : str
        Name of the dataset, for complaints.
    task : task, str or None
        For all rows; or the name of one of the row's own; or its only one.
    external_wrench : (6,) array [N, N m] or None
        Instead of the row's own.
    barrier_weight : float
        As in ``evaluate``.
    forces : bool
        Whether to keep the contact forces too.
    ignored : tuple of str
        Fields of the rows that are not read.

    """

    file: str
    task: Task | str | None = None
    external_wrench: NDArray[np.float64] | None = None
    barrier_weight: float = 0.0
    forces: bool = False
    ignored: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class _Asked:
    row: int
    id: str | None  # noqa: A003
    grasp: Grasp
    task: Task
    load: NDArray[np.float64] | None


def score(chunk: Chunk, question: Question) -> Any:
    """Return the answers of a chunk as a Table of ``SCHEMA``, in the order of its rows."""
    asked: list[_Asked] = []
    answers: list[Mapping[str, Any]] = []
    for row, item in chunk.items(question.file):
        try:
            asked.append(_read(row, item, question))
        except GraspQualityError as exc:
            answers.append({'row': row, 'status': BAD_ROW, 'reason': str(exc)})
    wrenches = [one for one in asked if isinstance(one.task, TaskWrench)]
    answers += _wrench_answers(wrenches, question)
    answers += [_single_answer(one, question) for one in asked
                if not isinstance(one.task, TaskWrench)]
    return pa.Table.from_pylist(sorted(answers, key=lambda a: int(a['row'])), schema=SCHEMA)


def _read(row: int, item: SourceItem | FileError, question: Question) -> _Asked:
    if isinstance(item, FileError):
        raise item
    source = read_grasp(item, also=('id', *question.ignored))
    name = item.named_items().get('id')
    task, has = question.task, f'it has {", ".join(source.tasks) or "none"}'
    if isinstance(task, str):
        if task not in source.tasks:
            item.fail(f'must have the task {task!r}, {has}')
        task = source.tasks[task]
    elif task is None:
        if len(source.tasks) != 1:
            item.fail(f'must have exactly one task, {has}: give --task "fx fy fz tx ty tz" for '
                      'all rows, or --task NAME for one of their own')
        task, = source.tasks.values()
    load = source.external_wrench if question.external_wrench is None else question.external_wrench
    return _Asked(row, _text_of(name), source.grasp, task, load)


def _text_of(item: SourceItem | None) -> str | None:
    if not isinstance(item, JsonItem):
        return None
    if not isinstance(item.value, (str, int, float)):
        item.fail('must be a text or a number')
    return str(item.value)


def _wrench_answers(asked: list[_Asked], question: Question) -> list[dict[str, Any]]:
    if not asked:
        return []
    tasks = np.array([one.task.wrench for one in asked if isinstance(one.task, TaskWrench)])
    loads = np.array([NO_LOAD if one.load is None else one.load for one in asked])
    found = evaluate_many([one.grasp for one in asked], tasks, loads, question.barrier_weight,
                          forces=question.forces)
    answers = []
    for i, one in enumerate(asked):
        answer = {'row': one.row, 'id': one.id, 'status': Outcome(int(found.status[i])).name,
                  'alpha': float(found.alpha[i])}
        if found.status[i] != Outcome.UNPROVED:
            answer['alpha_upper'] = float(found.alpha_upper[i])
        if found.forces is not None and found.feasible[i]:
            answer['forces'] = found.forces[i, :len(one.grasp)].tolist()
        answers.append(answer)
    return answers


def _single_answer(one: _Asked, question: Question) -> dict[str, Any]:
    """Evaluate a cone, a polytope or an ellipsoid; of the latter two alpha is the smallest."""
    answer: dict[str, Any] = {'row': one.row, 'id': one.id, 'alpha': 0.0}
    try:
        solution = evaluate(one.grasp, one.task, one.load, question.barrier_weight)
    except SolverError:
        return {**answer, 'status': Outcome.UNPROVED.name}
    answer['status'] = solution.status.name
    if isinstance(solution, PolytopeSolution):
        feasible = bool(len(solution.forces))
        weakest = int(solution.alphas.argmin())
        answer['quality'] = solution.quality
        upper = solution.solutions[weakest].alpha_upper
        alpha, forces = solution.alpha_min, solution.forces[weakest] if feasible else None
    else:
        feasible, upper = solution.feasible, solution.alpha_upper
        alpha, forces = solution.alpha, solution.forces
    if feasible:
        answer.update(alpha=alpha, alpha_upper=upper)
    if feasible and question.forces and forces is not None:
        answer['forces'] = forces.tolist()
    return answer

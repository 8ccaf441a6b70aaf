# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The replay of a bag from end to end: read, answer in batches, write, sum up."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from grasp_quality.node_settings import Settings
from grasp_quality_cli.bag_answers import answered
from grasp_quality_cli.bag_inputs import BagInputs, NO_TASK, Sample, SOURCES
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_source import BagSource, NoBagError
from grasp_quality_cli.bag_summary import Summary
from grasp_quality_cli.bag_tables import Tables
from grasp_quality_cli.grasp_file import Task
from grasp_quality_cli.task_text import ArgumentError
import numpy as np
from numpy.typing import NDArray

BATCH = 256  # samples answered at a time


@dataclass(frozen=True, eq=False)
class Question:
    """
    What is asked of a bag.

    Attributes
    ----------
    settings : Settings
        Parameters of the node.
    node : str
        Its full name, before the names of its topics.
    task : TaskWrench, TaskCone, TaskPolytope or TaskEllipsoid, or None
        None: as recorded.
    load : (6,) array [N, N m] or None
        External wrench; None: as recorded.

    """

    settings: Settings
    node: str
    task: Task | None
    load: NDArray[np.float64] | None


def contact_source(source: BagSource, node: str) -> str:
    """Name the contact_source that the bag holds; pose_array where it holds both."""
    topics = {name: f'{node.rstrip("/")}/{topic}' for name, (topic, _) in SOURCES.items()}
    for name, topic in topics.items():
        if _messages(source, topic):
            return name
    _refuse_without(source, node, *topics.values())
    return 'pose_array'


def require_contacts(source: BagSource, question: Question) -> None:
    """Raise NoBagError where a whole bag holds no message of the contact source that is asked."""
    topic = f'{question.node.rstrip("/")}/{SOURCES[question.settings.contact_source][0]}'
    if not _messages(source, topic):
        _refuse_without(source, question.node, topic)


def _messages(source: BagSource, topic: str) -> int:
    return sum(count for (name, _), count in source.counts.items() if name == topic)


def _refuse_without(source: BagSource, node: str, *topics: str) -> None:
    if source.total(lambda _: True) is None:  # of a damaged bag only the end tells
        return
    there = sorted({name for (name, _), count in source.counts.items() if count})
    raise NoBagError(
        f'{source.path}: holds no contacts of a node {node}, no messages on '
        f'{" or ".join(topics)}: was the driver running? --node names another; the bag holds '
        f'{"messages on " + ", ".join(there) if there else "no messages at all"}')


def replay(source: BagSource, question: Question, tables: Tables, problems: Problems,
           advance: Callable[[int], None]) -> Summary:
    """
    Replay a bag.

    Parameters
    ----------
    source : BagSource
        What is read.
    question : Question
        What is asked of it.
    tables : Tables
        Where the answers go.
    problems : Problems
        Where the rest goes.
    advance : function of int
        Told how many messages were read since it was told last.

    Raises
    ------
    ArgumentError
        When there is no task.

    """
    inputs = BagInputs(question.settings, question.node, question.task, question.load, problems)
    _check_task(source, question, inputs)
    summary, samples, read = Summary(), list[Sample](), 0
    for record in source.records(inputs.wants):
        read += 1
        sample = inputs.take(record)
        if sample is not None:
            samples.append(sample)
        if len(samples) == BATCH:
            _answer(samples, question, tables, problems, summary)
            samples = []
        if read == BATCH:
            advance(read)
            read = 0
    if samples:
        _answer(samples, question, tables, problems, summary)
    advance(read)
    for text in source.damage:
        problems.add('damage', '', text)
    return summary


def _check_task(source: BagSource, question: Question, inputs: BagInputs) -> None:
    inputs.set_task_wrench(question.settings.task_wrench)
    topic = f'{question.node.rstrip("/")}/task_wrench'
    known = source.total(lambda _: True) is not None  # of a damaged bag only the end tells
    if question.task is None and not question.settings.task_wrench and known and not any(
            name == topic for name, _ in source.counts):
        raise ArgumentError(NO_TASK.format(node=question.node.rstrip('/')))


def _answer(samples: list[Sample], question: Question, tables: Tables, problems: Problems,
            summary: Summary) -> None:
    rows = answered(samples, question.settings.barrier_weight)
    topic = SOURCES[question.settings.contact_source][0]
    for row in rows:
        if row.code <= 0:
            problems.add(row.code.name, topic, row.message, row.sample.time_ns)
    tables.write(rows)
    summary.add(rows)

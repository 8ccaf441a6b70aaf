# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Answers as tables: answers (a row a sample) and forces (a row a contact), Parquet or CSV.

Written batch by batch. Columns are in docs/recorded_data.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
import math
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from grasp_quality_cli.bag_answers import Answered
import pyarrow as pa
import pyarrow.csv as pa_csv
import pyarrow.parquet as pa_parquet

FORMATS = ('parquet', 'csv')
NUMBER = pa.float64()
ANSWERS = pa.schema([
    ('time_ns', pa.int64()), ('stamp_ns', pa.int64()), ('code', pa.string()),
    ('message', pa.string()), ('contacts', pa.int32()), ('alpha', NUMBER),
    ('alpha_upper', NUMBER), ('friction_margin', NUMBER), ('measured_slip_margin', NUMBER)])
OPTIMAL = ('t1', 't2', 'n', 'm_n')
FORCES = pa.schema([
    ('time_ns', pa.int64()), ('contact', pa.string()), ('finger', pa.string()),
    *((name, NUMBER) for name in OPTIMAL), ('cone_usage', NUMBER),
    *((f'measured_{name}', NUMBER) for name in OPTIMAL)])


class Tables:
    """Both tables in a folder; a context manager around their files."""

    def __init__(self, folder: Path, form: str) -> None:
        self.paths = [folder / f'{name}.{form}' for name in ('answers', 'forces')]
        self._stack = ExitStack()
        make = pa_parquet.ParquetWriter if form == 'parquet' else pa_csv.CSVWriter
        self._writers = [self._stack.enter_context(make(str(path), schema))
                         for path, schema in zip(self.paths, (ANSWERS, FORCES))]

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, exc: BaseException | None,
                 trace: TracebackType | None) -> None:
        """Close the files."""
        self._stack.close()

    def write(self, batch: Sequence[Answered]) -> None:
        """Append a batch."""
        for writer, schema, rows in zip(
                self._writers, (ANSWERS, FORCES), (map(_answer, batch), _forces(batch))):
            columns = list(zip(*rows)) or [()] * len(schema)
            writer.write_batch(pa.record_batch(
                [pa.array(column, field.type) for column, field in zip(columns, schema)],
                schema=schema))


def _answer(row: Answered) -> tuple[Any, ...]:
    scene = row.sample.scene
    return (row.sample.time_ns, row.sample.stamp_ns, row.code.name, row.message,
            0 if scene is None else len(scene.grasp), row.alpha, row.alpha_upper,
            row.friction_margin, row.measured_margin)


def _forces(batch: Sequence[Answered]) -> list[tuple[Any, ...]]:
    rows: list[tuple[Any, ...]] = []
    for row in batch:
        scene = row.sample.scene
        if scene is None:
            continue
        optimal = row.forces.tolist() or [(None,) * 4] * len(scene.grasp)
        usage = row.cone_usage.tolist() or [None] * len(scene.grasp)
        for i, (name, finger) in enumerate(zip(scene.grasp.names, scene.grasp.contacts.fingers)):
            measured = scene.forces[i]
            rows.append((row.sample.time_ns, name, finger, *optimal[i], usage[i],
                         *((None,) * 4 if measured is None else map(_finite, measured))))
    return rows


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A dataset of grasps, chunk by chunk: lines of JSON (.jsonl) or the rows of a Parquet file.

Only the chunk at hand is in memory. Chunks of the same file are always cut in the same places, so
that a study can go on where it was ended; what stands in a row is read where it is scored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO

from grasp_quality_cli.json_source import JsonItem, parse_line
from grasp_quality_cli.source_item import FileError, ROW, SourceItem
import pyarrow as pa
import pyarrow.parquet as pq

LONGEST_LINE = 1 << 24  # bytes; a file that is no lines shall not fill the memory
SUFFIXES = ('.jsonl', '.ndjson', '.parquet')


@dataclass(frozen=True, eq=False)
class Chunk:
    """
    Rows that are scored together.

    Attributes
    ----------
    index : int
        From 0, in the order of the file.
    first_row : int
        Line (JSON) or row (Parquet) of the first one, from 1.
    rows : list of bytes, or RecordBatch
        Lines as they stand in the file (one longer than ``LONGEST_LINE`` is cut there), or rows.
    weight : int
        Bytes or rows, in the unit of ``Dataset.weight``.

    """

    index: int
    first_row: int
    rows: Any
    weight: int

    def __len__(self) -> int:
        """Count lines or rows, blank ones too."""
        return len(self.rows)

    def items(self, file: str) -> Iterator[tuple[int, SourceItem | FileError]]:
        """Yield the number of each row that is not blank with its fields, or what is wrong."""
        if isinstance(self.rows, list):
            for row, line in enumerate(self.rows, self.first_row):
                if line.strip():
                    yield row, _item_of_line(file, row, line)
            return
        for row, value in enumerate(self.rows.to_pylist(), self.first_row):
            yield row, JsonItem(file, ROW, row, value)


def _item_of_line(file: str, row: int, line: bytes) -> SourceItem | FileError:
    if len(line) > LONGEST_LINE:
        return FileError(f'{file}:{row}: is longer than {LONGEST_LINE} bytes: give one grasp a '
                         'line (JSON lines), not a list of them')
    try:
        return parse_line(file, row, line)
    except FileError as exc:
        return exc


@dataclass(frozen=True)
class Dataset:
    """
    A file of grasps.

    Attributes
    ----------
    path : Path
    weight : int
        Size, in bytes (JSON lines) or rows (Parquet): what progress is a share of.

    """

    path: Path
    weight: int

    @classmethod
    def of(cls, path: Path) -> Dataset:
        """
        Look at a file.

        Raises
        ------
        FileError
            When it is none, or of no kind that is known.

        """
        if path.suffix.lower() not in SUFFIXES:
            raise FileError(f'{path}: must end in one of {", ".join(SUFFIXES)}: JSON lines or '
                            'Parquet, see docs/study.md')
        try:
            size = path.stat().st_size
            if not path.is_file():
                raise FileError(f'{path}: must be a regular file, as a study that was ended reads '
                                'it again: write what comes out of a pipe or device to one first')
            return cls(path, pq.read_metadata(path).num_rows if cls._is_table(path) else size)
        except OSError as exc:
            raise FileError(f'{path}: cannot be read: {exc.strerror or exc}') from exc
        except pa.ArrowException as exc:
            raise FileError(f'{path}: is not a Parquet file: {exc}') from exc

    @staticmethod
    def _is_table(path: Path) -> bool:
        return path.suffix.lower() == '.parquet'

    def chunks(self, rows: int) -> Iterator[Chunk]:
        """Yield chunks of at most so many rows each."""
        if self._is_table(self.path):
            yield from _table_chunks(self.path, rows)
            return
        with open(self.path, 'rb') as file:
            lines, index = _lines(file), 0
            while part := list(islice(lines, rows)):
                yield Chunk(index, 1 + index * rows, part, sum(map(len, part)))
                index += 1


def _table_chunks(path: Path, rows: int) -> Iterator[Chunk]:
    first = 1
    with pq.ParquetFile(path, pre_buffer=False) as table:
        for index, batch in enumerate(table.iter_batches(batch_size=rows)):
            yield Chunk(index, first, batch, len(batch))
            first += len(batch)


def _lines(file: BinaryIO) -> Iterator[bytes]:
    """Yield lines; of one that is too long the first ``LONGEST_LINE`` bytes and one more."""
    while line := file.readline(LONGEST_LINE + 1):
        yield line
        while len(line) > LONGEST_LINE and not line.endswith(b'\n'):
            line = file.readline(LONGEST_LINE + 1) or b'\n'

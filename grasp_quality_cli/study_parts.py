# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a study has done so far, on disk: one file a chunk, put together at the end.

Beside the output stands a folder ``<output>.parts``. A chunk's answers appear there under their
name only when they are complete and on the disk, so that a study that was killed at any moment
goes on with what is missing. A lock, which ends with its process, keeps a second one away.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
import fcntl
import json
import os
from pathlib import Path
import shutil
from typing import Any

from grasp_quality_cli.study_error import StudyError
from grasp_quality_cli.study_rows import Chunk
from grasp_quality_cli.study_score import BAD_ROW, SCHEMA
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

PLAN = 'study.json'
LINES = b'lines'
SUMMARY = b'grasp_quality_study'
FEASIBLE = ('OPTIMAL', 'OPTIMAL_NO_INTERIOR')


class Parts:
    """
    The folder of parts of one study.

    Parameters
    ----------
    output : Path
        Parquet file that will hold the answers.
    plan : mapping
        What decides the answers and the cutting into chunks; JSON values.

    """

    def __init__(self, output: Path, plan: Mapping[str, Any]) -> None:
        self.output = output
        self.plan = dict(plan)
        self.folder = output.with_name(output.name + '.parts')
        self.bad_rows = output.with_name(output.name + '.bad_rows.jsonl')

    @contextmanager
    def opened(self, overwrite: bool = False) -> Iterator[None]:
        """
        Hold the folder for this process.

        Parameters
        ----------
        overwrite : bool
            Whether to remove what is there, to begin anew.

        Raises
        ------
        StudyError
            When another process holds it, or it belongs to another study.

        """
        self.folder.mkdir(parents=True, exist_ok=True)
        with open(self.folder / 'lock', 'ab') as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as exc:
                raise StudyError(f'another study is writing to {self.output}: wait for it, or '
                                 'choose another --output') from exc
            if overwrite:
                self._clear()
            plan = self.folder / PLAN
            if not plan.exists():
                self._write(plan, json.dumps(self.plan, indent=2).encode())
            self._check(json.loads(plan.read_bytes()), 'that was begun')
            yield

    def finished(self) -> dict[str, Any] | None:
        """
        Return the summary when the output is there already and answers this very study.

        Raises
        ------
        StudyError
            When it is there and answers another one.

        """
        if not self.output.exists():
            return None
        try:
            metadata = pq.read_schema(self.output).metadata or {}
        except (OSError, pa.ArrowException) as exc:
            raise StudyError(f'{self.output} is there and no study: choose another --output, or '
                             f'give --overwrite ({exc})') from exc
        stored = json.loads(metadata.get(SUMMARY, b'{"plan": {}}'))
        self._check(stored['plan'], 'that is finished')
        shutil.rmtree(self.folder, ignore_errors=True)  # killed between the last two steps
        return dict(stored['summary'])

    def _clear(self) -> None:
        for path in (self.output, self.bad_rows, *self.folder.glob('part-*'), self.folder / PLAN):
            path.unlink(missing_ok=True)

    def _check(self, found: Mapping[str, Any], which: str) -> None:
        differing = [k for k in self.plan if found.get(k) != self.plan[k]]
        if differing:
            changes = ', '.join(
                f'{k} was {found.get(k)!r} and is {self.plan[k]!r}' for k in differing)
            raise StudyError(f'{self.output} belongs to another study {which}: {changes}; choose '
                             'another --output, or give --overwrite to begin anew')

    def has(self, index: int) -> bool:
        """Tell whether a chunk is done."""
        return self._path(index).exists()

    def counted(self, index: int) -> tuple[int, int]:
        """Count all and bad rows of a chunk that is done."""
        status = pq.read_table(self._path(index), columns=['status'])['status']
        return len(status), pc.sum(pc.equal(status, BAD_ROW)).as_py() or 0

    def put(self, chunk: Chunk, answers: Any) -> None:
        """Keep the answers of a chunk; they are on the disk when this returns."""
        lines = json.dumps([chunk.first_row, len(chunk)]).encode()
        sink = pa.BufferOutputStream()
        pq.write_table(answers.replace_schema_metadata({LINES: lines}), sink)
        self._write(self._path(chunk.index), sink.getvalue())

    def _path(self, index: int) -> Path:
        return self.folder / f'part-{index:08d}.parquet'

    def _write(self, path: Path, content: Any) -> None:
        draft = path.with_suffix('.draft')
        with open(draft, 'wb') as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(draft, path)

    def merge(self, chunks: int, forces: bool) -> dict[str, Any]:
        """
        Put all parts together, in the order of the dataset; return the summary.

        Raises
        ------
        StudyError
            When parts are missing or do not fit together.

        """
        summary = self._summary(chunks)
        dropped = {'reason'} if forces else {'reason', 'forces'}
        schema = pa.schema([f for f in SCHEMA if f.name not in dropped]).with_metadata({
            SUMMARY: json.dumps({'plan': self.plan, 'summary': summary}).encode()})
        draft, bad_draft = (p.with_name(p.name + '.draft') for p in (self.output, self.bad_rows))
        with pq.ParquetWriter(draft, schema) as writer, open(bad_draft, 'w') as bad:
            for table in self._tables(chunks):
                is_bad = pc.equal(table['status'], BAD_ROW)
                for row in table.filter(is_bad).select(['row', 'reason']).to_pylist():
                    bad.write(json.dumps(row) + '\n')
                good = table.filter(pc.invert(is_bad)).select(schema.names)
                writer.write_table(good.replace_schema_metadata(schema.metadata))
        if summary['bad_rows']:
            os.replace(bad_draft, self.bad_rows)
        else:
            bad_draft.unlink()
            self.bad_rows.unlink(missing_ok=True)
        with open(draft, 'rb') as file:
            os.fsync(file.fileno())
        os.replace(draft, self.output)
        shutil.rmtree(self.folder)
        return summary

    def _tables(self, chunks: int) -> Iterator[Any]:
        for index in range(chunks):
            yield pq.read_table(self._path(index))

    def _summary(self, chunks: int) -> dict[str, Any]:
        """Count everything, and see that the parts cover the dataset without a gap."""
        counts: dict[str, int] = {}
        line, total, best, best_row = 1, 0.0, None, None
        for index, table in enumerate(self._tables(chunks)):
            first, lines = json.loads(table.schema.metadata[LINES])
            if first != line:
                raise StudyError(f'part {index} in {self.folder} begins with row {first} instead '
                                 f'of {line}: give --overwrite to begin anew')
            line += lines
            for name, count in zip(*map(pa.Array.to_pylist, table['status'].combine_chunks()
                                        .value_counts().flatten())):
                counts[name] = counts.get(name, 0) + count
            alphas = table.filter(pc.is_in(table['status'], pa.array(FEASIBLE)))
            if len(alphas):
                total += pc.sum(alphas['alpha']).as_py()
                at = pc.index(alphas['alpha'], pc.max(alphas['alpha'])).as_py()
                if best is None or alphas['alpha'][at].as_py() > best:
                    best, best_row = alphas['alpha'][at].as_py(), alphas['row'][at].as_py()
        feasible = sum(counts.get(name, 0) for name in FEASIBLE)
        scored = sum(counts.values()) - counts.get(BAD_ROW, 0)
        return {
            'rows': sum(counts.values()), 'scored': scored, 'feasible': feasible,
            'infeasible': counts.get('INFEASIBLE', 0), 'unproved': counts.get('UNPROVED', 0),
            'bad_rows': counts.get(BAD_ROW, 0),
            'alpha_mean': total / feasible if feasible else None, 'alpha_max': best,
            'best_row': best_row, 'output': str(self.output),
            'bad_rows_file': str(self.bad_rows) if counts.get(BAD_ROW) else None}

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of a study on disk: whole or not there, in order, and never those of another one."""

import json

from grasp_quality_cli.study_error import StudyError
from grasp_quality_cli.study_parts import Parts
from grasp_quality_cli.study_rows import Dataset
from grasp_quality_cli.study_score import Question, score
from grasp_quality_cli.task_text import chosen_task
import pyarrow.parquet as pq
import pytest
from study_data import answers, pinch, TASK, write_lines

PLAN = {'format': 1, 'task': 'up'}


@pytest.fixture
def chunks(tmp_path):
    """Return scored chunks: 12 rows, three at once, of which rows 5 and 6 are bad."""
    rows = [pinch(0.1 * i) if i not in (5, 6) else 'bad' for i in range(1, 13)]
    path = write_lines(tmp_path / 'd.jsonl', rows)
    question = Question('d', chosen_task(TASK, {}))
    return [(chunk, score(chunk, question)) for chunk in Dataset.of(path).chunks(3)]


@pytest.fixture
def parts(tmp_path):
    return Parts(tmp_path / 'out.parquet', PLAN)


def test_parts_are_put_together_in_the_order_of_the_rows(parts, chunks):
    with parts.opened():
        for chunk, found in reversed(chunks):
            parts.put(chunk, found)
        summary = parts.merge(len(chunks), forces=False)
    assert [a['row'] for a in answers(parts.output)] == [1, 2, 3, 4, 7, 8, 9, 10, 11, 12]
    bad = [json.loads(line) for line in parts.bad_rows.read_text().splitlines()]
    assert [b['row'] for b in bad] == [5, 6] and bad[0]['reason'].startswith('d:5: is not JSON')
    assert (summary['rows'], summary['scored'], summary['bad_rows']) == (12, 10, 2)
    assert (summary['feasible'], summary['best_row']) == (10, 12)
    assert summary['alpha_max'] == pytest.approx(12.0, rel=1e-6)
    assert summary['alpha_mean'] == pytest.approx(sum((1, 2, 3, 4, *range(7, 13))) / 10, rel=1e-6)
    assert not parts.folder.exists()


def test_a_finished_study_is_known_again(parts, chunks):
    assert parts.finished() is None
    with parts.opened():
        for chunk, found in chunks:
            parts.put(chunk, found)
        summary = parts.merge(len(chunks), forces=False)
    assert Parts(parts.output, PLAN).finished() == summary
    with pytest.raises(StudyError, match="that is finished: task was 'up' and is 'x'"):
        Parts(parts.output, {**PLAN, 'task': 'x'}).finished()


def test_a_file_that_is_no_study_is_left_alone(parts, tmp_path):
    parts.output.write_text('mine')
    with pytest.raises(StudyError, match='is there and no study'):
        parts.finished()
    assert parts.output.read_text() == 'mine'


def test_what_was_half_written_is_not_there(parts, chunks):
    """A process that is killed while it writes leaves a draft, which counts for nothing."""
    with parts.opened():
        parts.put(*chunks[0])
        (parts.folder / 'part-00000001.draft').write_bytes(b'half a part')
        assert parts.has(0) and not parts.has(1)
        assert parts.counted(0) == (3, 0)
        parts.put(*chunks[1])
        assert parts.counted(1) == (3, 2)


def test_a_gap_is_found_before_anything_is_lost(parts, chunks):
    with parts.opened():
        for chunk, found in chunks[1:]:
            parts.put(chunk, found)
        (parts.folder / 'part-00000001.parquet').rename(parts.folder / 'part-00000000.parquet')
        with pytest.raises(StudyError, match='begins with row 4 instead of 1'):
            parts.merge(1, forces=False)
    assert not parts.output.exists()


def test_parts_of_another_study_are_not_mixed_in(parts, chunks):
    with parts.opened():
        parts.put(*chunks[0])
    other = Parts(parts.output, {**PLAN, 'task': 'down'})
    with pytest.raises(StudyError, match="begun: task was 'up' and is 'down'"), other.opened():
        pass
    with other.opened(overwrite=True):
        assert not other.has(0)


def test_two_at_once_are_kept_apart(parts):
    with parts.opened(), pytest.raises(StudyError, match='another study is writing'), \
            Parts(parts.output, PLAN).opened(overwrite=True):
        pass
    with parts.opened():  # and the lock is free again
        pass


def test_forces_are_kept_on_request(parts, chunks, tmp_path):
    path = write_lines(tmp_path / 'e.jsonl', [pinch(0.5)])
    chunk, = Dataset.of(path).chunks(3)
    with parts.opened():
        parts.put(chunk, score(chunk, Question('e', chosen_task(TASK, {}), forces=True)))
        parts.merge(1, forces=True)
    assert 'forces' in pq.read_schema(parts.output).names
    assert [f[2] for f in answers(parts.output)[0]['forces']] == pytest.approx([10.0, 10.0])

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Datasets in chunks: every row once, in its place, whatever the size of the chunks."""

from grasp_quality_cli import study_rows
from grasp_quality_cli.source_item import FileError
from grasp_quality_cli.study_rows import Dataset
import pytest
from study_data import pinch, write_lines, write_table


@pytest.fixture(params=['lines', 'table'])
def dataset(request, tmp_path):
    """Return a dataset of 25 rows that know their number."""
    rows = [pinch(0.5, id=str(i)) for i in range(1, 26)]
    if request.param == 'lines':
        return Dataset.of(write_lines(tmp_path / 'd.jsonl', rows))
    return Dataset.of(write_table(tmp_path / 'd.parquet', rows, group=10))


@pytest.mark.parametrize('size', [1, 4, 10, 24, 25, 26])
def test_chunks_tile_the_dataset(dataset, size):
    chunks = list(dataset.chunks(size))
    assert [c.index for c in chunks] == list(range(len(chunks)))
    assert all(1 <= len(c) <= size for c in chunks)
    assert sum(c.weight for c in chunks) == dataset.weight
    found = [(row, item.named_items()['id'].text())
             for c in chunks for row, item in c.items('d')]
    assert found == [(i, str(i)) for i in range(1, 26)]
    first = 1
    for chunk in chunks:
        assert chunk.first_row == first
        first += len(chunk)


def test_chunks_are_cut_in_the_same_places_again(dataset):
    again = [[(c.first_row, len(c)) for c in dataset.chunks(7)] for _ in range(2)]
    assert again[0] == again[1]


def test_blank_lines_are_no_rows_but_lines(tmp_path):
    path = write_lines(tmp_path / 'd.jsonl', ['{"a": 1}', '', '  ', '{"a": 2}'])
    chunk, = Dataset.of(path).chunks(10)
    assert [row for row, _ in chunk.items('d')] == [1, 4]


def test_a_last_line_without_an_end_counts(tmp_path):
    path = tmp_path / 'd.jsonl'
    path.write_text('{"a": 1}\n{"a": 2}')
    chunk, = Dataset.of(path).chunks(10)
    assert [item.value for _, item in chunk.items('d')] == [{'a': 1}, {'a': 2}]


@pytest.mark.parametrize('length', [19, 20, 21, 39, 40, 41, 100])
def test_a_line_too_long_is_one_bad_row_and_does_not_shift_the_others(
        tmp_path, monkeypatch, length):
    monkeypatch.setattr(study_rows, 'LONGEST_LINE', 20)
    path = write_lines(tmp_path / 'd.jsonl', ['{"a": 1}', 'x' * length, '{"a": 3}'])
    chunk, = Dataset.of(path).chunks(10)
    items = dict(chunk.items('d'))
    assert sorted(items) == [1, 2, 3] and items[3].value == {'a': 3}
    assert isinstance(items[2], FileError)
    assert ('is longer than 20 bytes' in str(items[2])) == (length >= 20)


@pytest.mark.parametrize('name, content, words', [
    ('d.csv', b'', 'must end in one of .jsonl, .ndjson, .parquet'),
    ('d.parquet', b'no table', 'is not a Parquet file'), ('d.jsonl', None, 'cannot be read'),
    ('d.parquet', None, 'cannot be read')])
def test_a_file_that_is_no_dataset_is_refused(tmp_path, name, content, words):
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(FileError, match=words):
        Dataset.of(path)

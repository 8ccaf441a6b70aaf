# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of datasets: read like grasp files, and refused with file, line and field."""

from grasp_quality_cli.grasp_file import read_grasp, read_grasp_file
from grasp_quality_cli.json_source import JsonItem, parse_line
from grasp_quality_cli.source_item import FileError
import numpy as np
import pytest
from study_data import pinch
import yaml


def test_a_grasp_file_on_one_line_is_the_same_grasp(examples):
    path = examples / 'three_finger.yaml'
    row = yaml.safe_load(path.read_text())
    ours, file = read_grasp(JsonItem('a', 'file', 1, row)), read_grasp_file(path)
    assert ours.grasp.names == file.grasp.names and ours.grasp.bound == file.grasp.bound
    for name in ('positions', 'rotations', 'max_normal_forces', 'scales'):
        assert np.array_equal(getattr(ours.grasp, name), getattr(file.grasp, name))
    assert ours.external_wrench.tolist() == file.external_wrench.tolist()
    assert list(ours.tasks) == list(file.tasks)


def test_null_counts_as_not_there():
    row = pinch(0.5, bound=None, external_wrench=None, defaults=None)
    for contact in row['contacts']:
        contact.update(finger=None, model=None, rotation=None, quaternion=None)
    found = read_grasp(JsonItem('a', 'file', 1, row))
    assert found.grasp.bound == 'linf' and found.external_wrench is None


@pytest.mark.parametrize('line, words', [
    (b'{"contacts": [', 'is not JSON: '), (b'\xff\xfe', 'is not JSON: '),
    (b'[' * 200_000, 'is not JSON: it is nested too deeply'),
    (b'{"a": 1, "b": 2, "a": 3}', "is not JSON: field 'a' is given twice")])
def test_a_line_that_is_no_json_is_told_with_its_number(line, words):
    with pytest.raises(FileError, match=f'^rows.jsonl:7: {words}'):
        parse_line('rows.jsonl', 7, line)


@pytest.mark.parametrize('line, words', [
    (b'3', 'row must be a mapping, got 3'), (b'{}', 'row must have the field contacts'),
    (b'{"contacts": {}}', 'contacts must be a list, got {}'),
    (b'{"contacts": [{"position": [0, 0]}]}', 'must have exactly one of normal'),
    (b'{"contacts": [{"position": [0, 0], "normal": [1, 0, 0]}]}',
     r'contacts\[0\].position must hold 3 numbers'),
    (b'{"contacts": [{"position": [0, 0, "1"], "normal": [1, 0, 0]}]}',
     r"contacts\[0\].position\[2\] must be a finite number, got '1'"),
    (b'{"contacts": [{"position": [0, 0, true], "normal": [1, 0, 0]}]}', 'got True'),
    (b'{"contacts": [{"position": [0, 0, NaN], "normal": [1, 0, 0]}]}', 'got nan'),
    (b'{"contacts": [{"position": [0, 0, 1' + b'0' * 400 + b'], "normal": [1, 0, 0]}]}',
     r'must be a finite number, got 10{59} \.\.\.'),
    (b'{"contacts": [{"position": [0, 0, 1], "normal": [0, 0, 0]}]}', 'normal must not be zero'),
    (b'{"contacts": [{"position": [0, 0, 1], "normal": [1, 0, 0], "model": 3}]}',
     'model must be a text, got 3'),
    (b'{"contacts": [], "weight": 1}', 'weight is not known here'),
    (b'{"contacts": []}', 'at least one contact')])
def test_a_row_that_breaks_a_rule_is_told_with_line_and_field(line, words):
    with pytest.raises(FileError, match=words) as caught:
        read_grasp(parse_line('rows.jsonl', 12, line))
    assert str(caught.value).startswith('rows.jsonl:12: ')


def test_fields_to_ignore_are_passed_over():
    item = JsonItem('a', 'file', 1, pinch(0.5, weight=3, id='x'))
    assert len(read_grasp(item, also=('id', 'weight')).grasp) == 2

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Files, rows, texts and parameters that nobody should write: refused in words, or answered."""

import json
import math

from benchmarks.fuzz import bags
from grasp_quality import GraspQualityError
from grasp_quality.node_parameters import TABLE, Type
from grasp_quality.node_settings import Settings
from grasp_quality_cli.grasp_file import read_grasp
from grasp_quality_cli.json_source import parse_line
from grasp_quality_cli.main import main
from grasp_quality_cli.node_settings import read_settings
from grasp_quality_cli.source_item import FileError
from grasp_quality_cli.study_rows import Dataset
from grasp_quality_cli.task_text import chosen_task
from hypothesis import given, settings, strategies as st
import pyarrow as pa
import pyarrow.parquet
import pytest

settings.load_profile('the same every time')
GRASP = """
bound: linf
defaults: {model: PCWF, friction: 0.5, max_normal_force: 10.0}
contacts:
- {name: a, position: [-0.02, 0.0, 0.0], normal: [1, 0, 0]}
- {name: b, position: [0.02, 0.0, 0.0], quaternion: [0.0, -0.7071067811865476, 0.0, 0.7071067811865476]}
external_wrench: [0, 0, -1, 0, 0, 0]
tasks:
  lift: {wrench: [0, 0, 1, 0, 0, 0]}
  cone: {cone: {axis: [0, 0, 1, 0, 0, 0], lateral_x: [1, 0, 0, 0, 0, 0], lateral_y: [0, 1, 0, 0, 0, 0],
                half_angle: 0.3, surface_samples: 8}}
"""  # noqa: E501
SPOILERS = ('[' * 600, '{a: ' * 600, '"\\UFFFFFFFF"', '"\\U00110000"', '"\\ud800"', '"\\0"',
            '1e999', '.nan', '-.inf', '1e300', '1e-300', '0x10', '1_0', '[]', '{}', '~', '&a [*a]',
            '*a', '!!python/object:os.system {}', '? [a]', '<<: *b', '"[/red]"', '"a\\nb"', '\t',
            '---', '\ufeff', '\x85', "'", '"', '}', ']', '1' * 5000, 'surface_samples: 1e300')
NUMBERS = (math.nan, math.inf, -math.inf, 1e300, -1e300, 1e-300, 5e-324, 0.0, -0.0, -1.0, 1.0,
           1e6, 1e12, 2 ** 63, -2 ** 63, 10 ** 400, True, None, '', 'PCWF', 'l1', '\ud800', [],
           [1.0] * 6, [1e300] * 6, [math.nan] * 6, ['a', 'a'], ['a', ''], {}, 0, 1, 100)


@st.composite
def spoilt(draw, text):
    """Draw a text with some of its parts replaced, cut or doubled."""
    for _ in range(draw(st.integers(1, 3))):
        at = draw(st.integers(0, len(text)))
        end = min(len(text), at + draw(st.integers(0, 30)))
        text = text[:at] + draw(st.sampled_from(SPOILERS) | st.text(max_size=5)) + text[end:]
    return text


@settings(max_examples=40)
@given(spoilt(GRASP), st.booleans())
def test_a_spoilt_grasp_file_is_refused_by_name_and_line(tmp_path_factory, text, as_json):
    path = tmp_path_factory.getbasetemp() / 'grasp.yaml'
    path.write_text(text, encoding='utf-8', errors='surrogatepass')
    arguments = ['evaluate', str(path), '--task', 'cone', *(['--json'] if as_json else [])]
    assert main(arguments) in (0, 1, 2, 3)


@pytest.mark.parametrize('spoiler', SPOILERS)
@pytest.mark.parametrize('where', ['a, position', 'lift', '0.5', '[1, 0, 0]'])
def test_every_spoiler_in_the_middle_of_a_file(tmp_path, capsys, spoiler, where):
    path = tmp_path / 'grasp.yaml'
    path.write_text(GRASP.replace(where, spoiler, 1), encoding='utf-8')
    code = main(['evaluate', str(path), '--task', '0 0 1 0 0 0'])
    complaint = capsys.readouterr().err
    assert code in (0, 1, 3) or (code == 2 and complaint.startswith(f'error: {path}'))


ROW = {'contacts': [{'position': [-0.02, 0, 0], 'normal': [1, 0, 0], 'name': 'a'},
                    {'position': [0.02, 0, 0], 'normal': [-1, 0, 0], 'friction': 0.5}],
       'bound': 'l1', 'external_wrench': [0, 0, 0, 0, 0, 0]}
json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=4)
    | st.sampled_from(NUMBERS), lambda inner: st.lists(inner, max_size=6) | st.dictionaries(
        st.sampled_from(('position', 'normal', 'name', 'friction', 'wrench', 'x')), inner,
        max_size=4), max_leaves=12)


@settings(max_examples=80)
@given(st.sampled_from(('contacts', 'bound', 'external_wrench', 'position', 'normal', 'name',
                        'friction', 'max_normal_force', 'model', 'extra')), json_values)
def test_a_spoilt_row_is_refused_or_is_a_grasp(field, value):
    row = json.loads(json.dumps(ROW))
    (row if field in row else row['contacts'][0])[field] = value
    try:
        grasp = read_grasp(parse_line('rows.jsonl', 7, json.dumps(row).encode())).grasp
    except FileError as exc:
        assert str(exc).startswith('rows.jsonl:7: ')
    else:
        assert len(grasp) and str(grasp.names).encode()


@settings(max_examples=60)
@given(st.binary(max_size=60) | spoilt(json.dumps(ROW)).map(lambda t: t.encode(errors='replace')))
def test_a_line_of_any_bytes_is_refused_or_read(line):
    try:
        read_grasp(parse_line('rows.jsonl', 7, line))
    except FileError as exc:
        assert str(exc).startswith('rows.jsonl:7: ')


def test_a_spoilt_table_is_refused_or_read(tmp_path):
    path = tmp_path / 'rows.parquet'
    pyarrow.parquet.write_table(pa.Table.from_pylist([ROW] * 3), path)
    whole = path.read_bytes()
    random = bags.Random(0)
    for _ in range(60):
        path.write_bytes(bags.spoil_bytes(whole, random))
        try:
            for chunk in Dataset.of(path).chunks(2):
                for _, item in chunk.items('rows.parquet'):
                    read_grasp(item)
        except (GraspQualityError, OSError, pa.ArrowException) as exc:
            assert str(exc)


@settings(max_examples=80)
@given(spoilt('0 0 1 0 0 0') | st.text(max_size=20))
def test_any_task_text_is_refused_or_a_task(text):
    try:
        chosen_task(text, {})
    except GraspQualityError as exc:
        assert str(exc)


@pytest.mark.parametrize('name', TABLE)
def test_every_value_of_every_parameter_is_refused_with_a_reason_or_taken(name):
    kind, _, limits, _ = TABLE[name]
    for value in NUMBERS:
        if kind is Type.DOUBLE and isinstance(value, float) and not (
                limits[0] <= value <= limits[1]):
            continue  # what the range of the parameter refuses before us
        values = tuple(value) if isinstance(value, list) else value
        try:
            taken = Settings(**{name: values})
        except (ValueError, TypeError) as exc:
            assert str(exc)
        else:
            assert getattr(taken, name) == values or values != values


@settings(max_examples=100)
@given(st.sampled_from(list(TABLE)), spoilt('0.5') | st.sampled_from(NUMBERS).map(repr))
def test_any_assignment_on_the_command_line_is_refused_or_taken(name, text):
    try:
        read_settings(None, [f'{name}={text}'], '/grasp_quality')
    except GraspQualityError as exc:
        assert name in str(exc).replace(' ', '_') or '--set' in str(exc)


def test_a_spoilt_bag_ends_with_a_list_of_problems(tmp_path):
    assert not bags.run(range(1, 41), tmp_path)

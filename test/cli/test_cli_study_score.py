# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A chunk's answers: as many as rows, each that of the row by itself."""

from grasp_quality import evaluate, TaskWrench
from grasp_quality_cli.grasp_file import read_grasp
from grasp_quality_cli.json_source import JsonItem
from grasp_quality_cli.study_rows import Dataset
from grasp_quality_cli.study_score import BAD_ROW, Question, SCHEMA, score
import numpy as np
import pytest
from study_data import pinch, write_lines, write_table
from tolerances import SOLVER

ACROSS = TaskWrench([0, 0, 2, 0, 0, 0])


def scored(tmp_path, rows, task=ACROSS, table=False, **question):
    path = write_table(tmp_path / 'd.parquet', rows) if table else write_lines(
        tmp_path / 'd.jsonl', rows)
    chunk, = Dataset.of(path).chunks(1000)
    answers = score(chunk, Question('d', task, **question))
    assert answers.schema == SCHEMA
    return answers.to_pylist()


@pytest.mark.parametrize('table', [False, True])
def test_every_row_has_its_closed_form(tmp_path, table):
    frictions = np.linspace(0.1, 0.9, 30)
    answers = scored(tmp_path, [pinch(mu) for mu in frictions], table=table)
    assert [a['row'] for a in answers] == list(range(1, 31))
    assert [a['alpha'] for a in answers] == pytest.approx(10.0 * frictions, rel=SOLVER)
    for answer in answers:
        assert answer['status'] == 'OPTIMAL' and answer['reason'] is None
        assert answer['alpha'] <= answer['alpha_upper'] <= answer['alpha'] * (1 + SOLVER)
        assert answer['forces'] is None and answer['quality'] is None


def test_rows_of_different_contact_counts_bounds_and_loads(tmp_path, examples):
    import yaml
    ball = yaml.safe_load((examples / 'three_finger.yaml').read_text())
    rows = [pinch(0.5), ball, pinch(0.5, bound='l1'),
            pinch(0.5, external_wrench=[0, 3, -4, 0, 0, 0])]
    answers = scored(tmp_path, rows, forces=True)
    for row, answer in zip(rows, answers):
        source = read_grasp(JsonItem('d', 'file', 1, row))
        alone = evaluate(source.grasp, ACROSS, source.external_wrench)
        assert answer['alpha'] == pytest.approx(alone.alpha, rel=SOLVER)
        load = np.zeros(6) if source.external_wrench is None else source.external_wrench
        total = source.grasp.wrench(np.array(answer['forces'])) + load
        assert total == pytest.approx(answer['alpha'] * ACROSS.wrench, abs=1e-5)


def test_bad_rows_are_answers_too_and_spoil_nothing(tmp_path):
    rows = ['no json', pinch(0.5), pinch(-1.0), '', pinch(0.3, id=7), {'contacts': 3}]
    answers = scored(tmp_path, rows)
    assert [(a['row'], a['status']) for a in answers] == [
        (1, BAD_ROW), (2, 'OPTIMAL'), (3, BAD_ROW), (5, 'OPTIMAL'), (6, BAD_ROW)]
    assert answers[3]['id'] == '7' and answers[3]['alpha'] == pytest.approx(3.0, rel=SOLVER)
    assert answers[2]['reason'].startswith('d:3: contacts[0].friction cannot be used')


def test_infeasible_is_an_answer_with_alpha_zero(tmp_path):
    answer, = scored(tmp_path, [pinch(0.5, external_wrench=[0, 0, -20, 0, 0, 0])])
    assert (answer['status'], answer['alpha'], answer['alpha_upper']) == ('INFEASIBLE', 0.0, 0.0)


def test_one_load_for_all_replaces_that_of_the_rows(tmp_path):
    load = np.array([0.0, 0.0, -4.0, 0.0, 0.0, 0.0])
    rows = [pinch(0.5), pinch(0.5, external_wrench=[0, 0, 3, 0, 0, 0])]
    answers = scored(tmp_path, rows, external_wrench=load)
    assert [a['alpha'] for a in answers] == pytest.approx([3.0, 3.0], rel=SOLVER)


def test_tasks_of_the_rows(tmp_path):
    """Alpha of a cone is alpha_z, of a polytope the smallest; quality is the weighted sum."""
    kinds = {
        'up': {'wrench': [0, 0, 2, 0, 0, 0]},
        'both': {'polytope': {'wrenches': [[0, 0, 2, 0, 0, 0], [0, 5, 0, 0, 0, 0]]}},
        'cone': {'cone': {'axis': [0, 0, 2, 0, 0, 0], 'lateral_x': [1, 0, 0, 0, 0, 0],
                          'lateral_y': [0, 1, 0, 0, 0, 0], 'half_angle': 0.0}},
        'round': {'ellipsoid': {'axes': [[0, 0, 2, 0, 0, 0], [0, 5, 0, 0, 0, 0]]}}}
    rows = [pinch(0.5, tasks={name: task}) for name, task in kinds.items()]
    answers = scored(tmp_path, rows, task=None, forces=True)
    assert [a['alpha'] for a in answers] == pytest.approx([5.0, 2.0, 5.0, 2.0], rel=SOLVER)
    assert [a['quality'] for a in answers] == [
        None, pytest.approx(3.5, rel=SOLVER), None, pytest.approx(3.5, rel=SOLVER)]
    assert all(len(a['forces']) == 2 for a in answers)


def test_a_task_by_name_and_rows_that_lack_it(tmp_path):
    rows = [pinch(0.5, tasks={'up': {'wrench': [0, 0, 2, 0, 0, 0]},
                              'down': {'wrench': [0, 0, -4, 0, 0, 0]}}), pinch(0.5)]
    by_name = scored(tmp_path, rows, task='down')
    assert by_name[0]['alpha'] == pytest.approx(2.5, rel=SOLVER)
    assert "must have the task 'down', it has none" in by_name[1]['reason']
    only = scored(tmp_path, rows, task=None)
    assert [a['status'] for a in only] == [BAD_ROW, BAD_ROW]
    for number, has in (1, 'up, down'), (2, 'none'):
        assert only[number - 1]['reason'].startswith(
            f'd:{number}: row must have exactly one task, it has {has}: give --task')
    assert 'grasp file' not in str(only)


def test_a_barrier_weight_buys_margin(tmp_path):
    """Closed form for caps of 1: 2 (sqrt(mu^2 + eps^2) - eps), eps in the unit of alpha."""
    answer, = scored(tmp_path, [pinch(0.5, cap=1.0)], TaskWrench([0, 0, 1, 0, 0, 0]),
                     barrier_weight=0.05)
    assert answer['alpha'] == pytest.approx(2 * (np.hypot(0.5, 0.05) - 0.05), rel=SOLVER)
    assert answer['alpha_upper'] == pytest.approx(1.0, rel=SOLVER)

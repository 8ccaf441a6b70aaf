# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality evaluate``: the answers of the core, their exit codes, and wrong arguments."""

import json

from grasp_quality import __version__, evaluate
from grasp_quality_cli.answer_table import limits, rounded
from grasp_quality_cli.grasp_file import read_grasp_file
import numpy as np
import pytest
from tolerances import SOLVER


def test_pinch_has_its_closed_form(run, examples):
    """Two fingers with mu = 0.5 and caps of 10 N hold 2 mu 10 N = five times 2 N."""
    code, printed, _ = run('evaluate', examples / 'pinch.yaml', '--task', 'lift', '--json')
    row = json.loads(printed)
    assert code == 0 and row['status'] == 'OPTIMAL'
    assert row['alpha'] == pytest.approx(5.0, rel=SOLVER)
    assert [force['force'][2] for force in row['forces']] == pytest.approx([10.0] * 2, rel=SOLVER)
    assert row['limiting_reason'] == 'slip'


def test_contacts_that_limit_alike_are_told_together(run, examples):
    """Neither finger alone can raise the lift, so that no advice may name one of them."""
    code, printed, _ = run('evaluate', examples / 'pinch.yaml')
    assert code == 0 and 'left and right alike, by slip' in printed and 'help' not in printed
    row = json.loads(run('evaluate', examples / 'pinch.yaml', '--json')[1])
    assert row['limited_by'] == {'left': 'slip', 'right': 'slip'}
    assert limits({'a': 'cap'}) == 'a, by its cap'
    assert limits({'a': 'slip', 'b': 'cap', 'c': 'slip'}) == (
        'a (by slip), b (by its cap) and c (by slip) alike')


def test_a_task_that_the_contacts_cannot_produce_is_told_as_zero(run, examples):
    code, printed, _ = run('evaluate', examples / 'pinch.yaml', '--task', '0 0 0 1 0 0')
    words = ' '.join(printed.split())
    assert code == 0 and "0 (to the solver's accuracy): the contacts cannot produce" in words
    assert 'e-' not in words and 'limited by' not in words and 'load' not in words
    row = json.loads(run(
        'evaluate', examples / 'pinch.yaml', '--task', '0 0 0 1 0 0', '--json')[1])
    assert row['powerless'] and row['pinned'] and row['limited_by'] == {}


def test_a_load_that_is_not_held_alone_is_told(run, examples):
    """Friction carries 10 N of 12 N, so that the task has to push 2 N along, or up to 22 N."""
    code, printed, _ = run('evaluate', examples / 'pinch.yaml', '--task', '0 0 -2 0 0 0',
                           '--external-wrench', '0 0 -12 0 0 0')
    words = ' '.join(printed.split())
    assert code == 0 and 'the load alone is not held' in words and 'between 1 and 11' in words


@pytest.mark.parametrize('task', ['lift', '0 0 2 0 0 0', '0,0,2,0,0,0', None])
def test_ways_to_name_a_task(run, examples, task):
    arguments = ['--task', task] if task else []
    code, printed, _ = run('evaluate', examples / 'pinch.yaml', '--json', *arguments)
    assert code == 0 and json.loads(printed)['alpha'] == pytest.approx(5.0, rel=SOLVER)


def test_task_from_a_file(run, examples, tmp_path):
    path = tmp_path / 'task.yaml'
    path.write_text('wrench: [0, 0, -4, 0, 0, 0]')
    code, printed, _ = run('evaluate', examples / 'pinch.yaml', '--task', path, '--json')
    assert code == 0 and json.loads(printed)['alpha'] == pytest.approx(2.5, rel=SOLVER)


@pytest.mark.parametrize('name', ['carry', 'twist', 'push', 'shake', 'swing'])
def test_every_kind_of_task_is_answered_as_by_the_core(run, examples, name):
    path = examples / 'three_finger.yaml'
    source = read_grasp_file(path)
    answer = evaluate(source.grasp, source.tasks[name], source.external_wrench)
    code, printed, _ = run('evaluate', path, '--task', name, '--json')
    row = json.loads(printed)
    assert code == 0
    key = 'quality' if 'answers' in row else 'alpha'
    assert row[key] == pytest.approx(getattr(answer, key), rel=SOLVER)
    code, printed, _ = run('evaluate', path, '--task', name)
    assert code == 0 and 'thumb' in printed and 'friction margin' in printed


def test_a_load_of_the_command_line_replaces_that_of_the_file(run, examples):
    path = examples / 'three_finger.yaml'
    _, heavy, _ = run('evaluate', path, '--task', 'carry', '--json')
    _, free, _ = run('evaluate', path, '--task', 'carry', '--json', '--external-wrench',
                     '0 0 0 0 0 0')
    # the load is the task with a minus sign: it costs exactly one
    assert json.loads(free)['alpha'] == pytest.approx(json.loads(heavy)['alpha'] + 1.0, rel=SOLVER)


def test_infeasible_is_an_answer_with_its_own_code(run, examples):
    arguments = ('evaluate', examples / 'pinch.yaml', '--task', 'lift', '--external-wrench',
                 '0 0 -50 0 0 0')
    code, printed, _ = run(*arguments)
    assert code == 1 and 'INFEASIBLE' in printed
    code, printed, _ = run(*arguments, '--json')
    row = json.loads(printed)
    assert code == 1 and row['alpha'] == 0.0 and row['forces'] == []


def test_barrier_weight_buys_margin(run, examples):
    path = examples / 'pinch.yaml'
    rows = [json.loads(run('evaluate', path, '--json', '--barrier-weight', weight)[1])
            for weight in (0.0, 0.5)]
    assert rows[0]['alpha'] > rows[1]['alpha'] > 0.0
    assert rows[0]['friction_margin'] < rows[1]['friction_margin']


@pytest.mark.parametrize('task, words', [
    ('drop', 'the grasp file has lift'), ('1 2 3', 'six finite numbers'),
    ('0 0 inf 0 0 0', 'finite'), ('none.yaml', 'cannot be read'),
    ('0 0 0 0 0 0', 'must not be zero')])
def test_wrong_tasks(run, examples, task, words):
    code, printed, complaint = run('evaluate', examples / 'pinch.yaml', '--task', task)
    assert code == 2 and not printed
    assert complaint.startswith('error: ') and words in complaint


def test_a_file_with_several_tasks_asks_which(run, examples):
    code, _, complaint = run('evaluate', examples / 'three_finger.yaml')
    assert code == 2 and 'carry, twist, push, shake, swing' in complaint


def test_the_version(run):
    assert run('--version') == (0, f'grasp-quality {__version__}\n', '')


@pytest.mark.parametrize('columns', ['40', '80', None])
@pytest.mark.parametrize('task', ['carry', 'twist', 'shake'])
def test_no_number_and_no_header_is_cut(run, examples, monkeypatch, columns, task):
    if columns is None:
        monkeypatch.delenv('COLUMNS', raising=False)
    else:
        monkeypatch.setenv('COLUMNS', columns)
    _, printed, _ = run('evaluate', examples / 'three_finger.yaml', '--task', task, '--json')
    row = json.loads(printed)
    _, printed, _ = run('evaluate', examples / 'three_finger.yaml', '--task', task)
    assert '\N{HORIZONTAL ELLIPSIS}' not in printed
    assert {'t1', 't2', 'normal', 'moment', 'cone', 'cap', 'used', '[N', 'm]'} <= set(
        printed.split())
    lines = [line.replace('\N{BOX DRAWINGS LIGHT VERTICAL}', ' ').split()
             for line in printed.splitlines()]
    shown = [float(number) for line in lines if line[:1] and line[0] in (
        'thumb', 'index', 'middle') for number in line[1:5]]
    forces = [number for one in row.get('answers', [row]) for contact in one['forces']
              for number in contact['force']]
    # up to half of the fourth digit of 8 N
    assert shown == pytest.approx(forces, abs=5.1e-4)


@pytest.mark.parametrize('size', [1e-6, 1.0, 1e6])
def test_what_is_printed_has_four_digits_of_the_largest(size):
    shown = rounded(size * np.array([[1.23456, -3e-5, 4.0, 0.0], [-0.0004, 0.2, 8.0, 1e-9]]))
    assert shown == pytest.approx(
        size * np.array([[1.235, 0.0, 4.0, 0.0], [0.0, 0.2, 8.0, 0.0]]), rel=1e-12)
    assert not np.signbit(shown[shown == 0.0]).any()


def test_wrong_use_says_how(run):
    code, _, complaint = run('evaluate')
    assert code == 2 and 'Missing argument' in complaint
    code, printed, _ = run('evaluate', '--help')
    assert code == 0 and '--task' in printed and 'Exit codes' in printed

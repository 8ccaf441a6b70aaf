# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality study`` as it is used: killed and gone on with, and what it tells."""

from concurrent.futures import ThreadPoolExecutor
import json
import os
import pty
import shutil
import signal
import subprocess

from grasp_quality_cli.study_workers import work_off
import psutil
import pyarrow.parquet as pq
import pytest
from study_data import (
    answers, BAD, check_whole, command, COUNT, finish, frictions, parts_of, pinch, process, TASK,
    until, write_dataset, write_lines, write_table)
from tolerances import SOLVER


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp('study')


@pytest.fixture(scope='module')
def dataset(folder):
    return write_dataset(folder / 'grasps.jsonl')


def test_killed_again_and_again_it_loses_nothing_and_leaves_nobody_behind(dataset, folder):
    output = folder / 'killed.parquet'
    there = 0
    for _ in range(2):
        log = folder / 'killed.log'
        with process(command(dataset, output, '--workers', '2'), log) as running:
            until(lambda: len(parts_of(output)) >= there + 3, 'three more parts', log)
            workers = psutil.Process(running.pid).children(recursive=True)
            assert len(workers) >= 2
            os.kill(running.pid, signal.SIGKILL)
        until(lambda: not any(w.is_running() and w.status() != psutil.STATUS_ZOMBIE
                              for w in workers), 'the workers to end')
        assert not output.exists()
        there = len(parts_of(output))
    summary, _ = finish(command(dataset, output, '--workers', '2'))
    assert summary['rows_before'] >= 20 * (there - 1)
    assert summary['rows_now'] + summary['rows_before'] == summary['rows'] == COUNT
    assert (summary['scored'], summary['bad_rows']) == (COUNT - 3, 3)
    check_whole(output)
    again, _ = finish(command(dataset, output, '--workers', '2'))
    assert again['rows_now'] == 0 and again['seconds'] is None


def test_bad_rows_are_told_with_their_line(dataset, folder):
    summary, said = finish(command(dataset, folder / 'told.parquet', '--workers', '1'))
    for row in BAD:
        assert f'bad row: {dataset}:{row}: is not JSON' in said
    assert summary['bad_rows_file'] == str(folder / 'told.parquet.bad_rows.jsonl')
    check_whole(folder / 'told.parquet')


def test_a_terminal_sees_a_bar_and_a_pipe_does_not(dataset, folder):
    ours, theirs = pty.openpty()
    output = folder / 'bar.parquet'
    program = [str(part) for part in command(dataset, output, '--workers', '1')]
    with subprocess.Popen(program, stderr=theirs, stdout=subprocess.PIPE) as running:
        os.close(theirs)
        shown = b''
        while part := _read(ours):
            shown += part
        running.stdout.read()
    os.close(ours)
    assert b'800 rows, 3 bad' in shown and b'100%' in shown
    assert '100%' not in finish(command(dataset, output, '--overwrite', '--workers', '1'))[1]


def _read(terminal):
    try:
        return os.read(terminal, 65536)
    except OSError:  # how Linux says that nobody writes any longer
        return b''


def test_parquet_in_gives_what_lines_give(folder, run):
    rows = [pinch(mu, id=f'g{i}') for i, mu in enumerate(frictions(60), 1)]
    tables = []
    for dataset in (write_lines(folder / 'few.jsonl', rows),
                    write_table(folder / 'few.parquet', rows, group=25)):
        output = folder / f'{dataset.suffix[1:]}.out.parquet'
        code, out, err = run('study', dataset, '-o', output, '--task', TASK, '--workers', 2,
                             '--chunk-rows', 20)
        assert code == 0 and '60, of which 60 scored' in out, err
        tables.append(pq.read_table(output))
    assert tables[0].equals(tables[1])


def test_no_more_jobs_are_taken_than_the_window_has_room_for():
    """Jobs stand for chunks: taken from the dataset, and not yet on the disk."""
    taken, kept, most = 0, 0, 0

    def jobs():
        nonlocal taken, most
        for job in range(200):
            taken += 1
            most = max(most, taken - kept)
            yield job

    def keep(job, result):
        nonlocal kept
        assert result == job + 1
        kept += 1

    with ThreadPoolExecutor(2) as pool:
        work_off(jobs(), lambda job: pool.submit(lambda: job + 1), 4, keep)
    assert kept == taken == 200 and most <= 4


@pytest.mark.parametrize('arguments, words', [
    (['--task', '0 0 2'], '--task must be six finite numbers'),
    (['--task', TASK, '--external-wrench', '1'], '--external-wrench must be six'),
    (['--task', 'missing.yaml'], 'missing.yaml: cannot be read')])
def test_a_wrong_option_is_told_before_anything_is_done(dataset, folder, run, arguments, words):
    output = folder / 'wrong.parquet'
    code, _, err = run('study', dataset, '-o', output, *arguments)
    assert code == 2 and words in err
    assert not parts_of(output) and not output.exists()


def test_another_question_does_not_take_the_place_of_the_first(folder, run):
    dataset = write_lines(folder / 'one.jsonl', [pinch(0.5)])
    output = folder / 'one.parquet'
    assert run('study', dataset, '-o', output, '--task', TASK, '--workers', 1)[0] == 0
    code, _, err = run('study', dataset, '-o', output, '--task', '0 0 1 0 0 0')
    assert code == 2 and 'give --overwrite' in err
    code, _, _ = run('study', dataset, '-o', output, '--task', '0 0 1 0 0 0', '--overwrite',
                     '--workers', 1)
    assert code == 0 and answers(output)[0]['alpha'] == pytest.approx(10.0, rel=SOLVER)


def test_no_folder_no_study(dataset, folder, run):
    code, _, err = run('study', dataset, '-o', folder / 'no' / 'where.parquet', '--task', TASK)
    assert code == 2 and 'there is no folder' in err


def test_help_says_how_to_begin(run):
    code, out, _ = run('study', '--help')
    assert code == 0
    for words in ('Example', 'goes on where it was', '--scheduler', '--chunk-rows', '.jsonl'):
        assert words in out


def test_the_example_of_the_documents(folder, run, examples):
    dataset = folder / 'grasps.example.jsonl'
    shutil.copy(examples / 'grasps.jsonl', dataset)
    code, out, _ = run('study', dataset, '-o', folder / 'example.parquet', '--task', TASK,
                       '--workers', 1, '--json')
    summary = json.loads(out)
    assert code == 1 and (summary['scored'], summary['bad_rows']) == (7, 1)

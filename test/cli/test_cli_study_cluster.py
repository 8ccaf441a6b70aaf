# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality study`` on a real Dask cluster of this machine that loses its parts."""

from contextlib import ExitStack
import json
import sys

import pytest
from study_data import (
    check_whole, command, DEADLINE_S, finish, parts_of, process, TASK, until, write_dataset)


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp('study')


@pytest.fixture(scope='module')
def dataset(folder):
    return write_dataset(folder / 'grasps.jsonl')


@pytest.fixture
def cluster(tmp_path):
    """Start a Dask scheduler and two workers; return (address, scheduler, workers)."""
    file, log = tmp_path / 'scheduler.json', tmp_path / 'scheduler.log'
    dask = [sys.executable, '-m', 'distributed.cli.dask_scheduler', '--host', '127.0.0.1',
            '--port', '0', '--no-dashboard', '--scheduler-file', file]
    with ExitStack() as stack:
        scheduler = stack.enter_context(process(dask, log))
        address = until(lambda: _address(file), 'the scheduler', log)
        logs = [tmp_path / f'worker_{i}.log' for i in range(2)]
        workers = [stack.enter_context(process(
            [sys.executable, '-m', 'distributed.cli.dask_worker', address, '--nthreads', '1',
             '--no-nanny', '--no-dashboard', '--local-directory', log.with_suffix('')], log))
            for log in logs]
        for log in logs:
            until(lambda: 'Registered to' in log.read_text(), 'a worker', log)
        yield address, scheduler, workers


def _address(file):
    try:
        return json.loads(file.read_text())['address']
    except (FileNotFoundError, ValueError):
        return None


def test_a_cluster_that_loses_a_worker_loses_nothing(dataset, folder, cluster):
    address, _, workers = cluster
    output, log = folder / 'cluster.parquet', folder / 'cluster.log'
    with process(command(dataset, output, '--scheduler', address), log) as running:
        until(lambda: len(parts_of(output)) >= 5, 'five parts', log)
        workers[0].kill()
        assert running.wait(DEADLINE_S) == 1, log.read_text()
    check_whole(output)
    assert '"rows_now": 800' in log.read_text()


def test_without_its_scheduler_it_stops_and_goes_on_anywhere(dataset, folder, cluster):
    address, scheduler, _ = cluster
    output, log = folder / 'lost.parquet', folder / 'lost.log'
    with process(command(dataset, output, '--scheduler', address), log) as running:
        until(lambda: len(parts_of(output)) >= 3, 'three parts', log)
        scheduler.kill()
        assert running.wait(DEADLINE_S) == 4, log.read_text()
    assert f'the Dask cluster at {address} was lost' in log.read_text()
    assert 'Traceback' not in log.read_text()
    summary, _ = finish(command(dataset, output, '--workers', '2'))
    assert summary['rows_before'] >= 60
    check_whole(output)


def test_a_scheduler_that_is_not_there_is_told(dataset, folder, run, monkeypatch):
    monkeypatch.setattr('grasp_quality_cli.study_workers.CONNECT_S', 1)
    code, _, err = run('study', dataset, '-o', folder / 'none.parquet', '--task', TASK,
                       '--scheduler', 'tcp://127.0.0.1:9')
    assert code == 2 and 'no Dask scheduler answers at tcp://127.0.0.1:9' in err

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Datasets with known answers, and processes that a test starts and ends."""

from contextlib import contextmanager
import ctypes
import json
import signal
import subprocess
import sys
import time

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from tolerances import SOLVER

DEADLINE_S = 120.0
PR_SET_PDEATHSIG = 1  # linux/prctl.h
TASK = '0 0 2 0 0 0'
COUNT = 800
BAD = (17, 18, 700)  # lines that are no rows
PROGRAM = [sys.executable, '-m', 'grasp_quality_cli.main', 'study']


def pinch(friction, cap=10.0, **fields):
    """Return a row of two fingers that pinch: alpha is friction times cap for 2 N across."""
    return {'contacts': [
        {'name': name, 'position': [x, 0, 0], 'normal': [-x, 0, 0], 'friction': friction,
         'max_normal_force': cap} for name, x in (('left', -0.02), ('right', 0.02))], **fields}


def frictions(count):
    """Return a friction coefficient for each row."""
    return [0.1 + 0.001 * (i % 700) for i in range(count)]


def write_lines(path, rows):
    """Write rows as JSON lines; a text stands as it is."""
    path.write_text(''.join(
        (row if isinstance(row, str) else json.dumps(row)) + '\n' for row in rows))
    return path


def write_table(path, rows, group=1000):
    """Write rows as Parquet."""
    pq.write_table(pa.Table.from_pylist(rows), path, row_group_size=group)
    return path


def answers(path):
    """Read an output as a list of rows."""
    return pq.read_table(path).to_pylist()


def end_with_parent():
    """Ask the kernel to end this process with the test run."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


@contextmanager
def process(command, log):
    """Run a command beside the test; kill it behind it."""
    with open(log, 'wb') as output:
        running = subprocess.Popen(
            [str(part) for part in command], stdout=output, stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL, start_new_session=True, preexec_fn=end_with_parent)
    try:
        yield running
    finally:
        if running.poll() is None:
            running.kill()
        running.wait()


def until(condition, what, log=None):
    """Wait for a condition and return what it gives."""
    deadline = time.monotonic() + DEADLINE_S
    while not (result := condition()):
        said = log.read_text() if log else ''
        assert time.monotonic() < deadline, f'waited {DEADLINE_S} s for {what}: {said}'
        time.sleep(0.01)
    return result


def command(dataset, output, *more):
    """Build the command of a study in chunks of 20 rows."""
    return [*PROGRAM, dataset, '-o', output, '--task', TASK, '--chunk-rows', '20', '--json', *more]


def check_whole(output):
    """Assert that good rows have their closed form, once and in order, and bad ones are told."""
    found = answers(output)
    expected = [i for i in range(1, COUNT + 1) if i not in BAD]
    assert [a['row'] for a in found] == expected
    assert [a['id'] for a in found] == [f'g{i}' for i in expected]
    alphas = frictions(COUNT)
    assert [a['alpha'] for a in found] == pytest.approx(
        [10.0 * alphas[i - 1] for i in expected], rel=SOLVER)
    bad = output.with_name(output.name + '.bad_rows.jsonl').read_text().splitlines()
    assert [json.loads(line)['row'] for line in bad] == list(BAD)
    assert not output.with_name(output.name + '.parts').exists()


def parts_of(output):
    """List the parts that are done."""
    return list(output.with_name(output.name + '.parts').glob('part-*.parquet'))


def finish(command):
    """Run a command to its end; return its summary."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 1, done.stderr  # there are bad rows
    return json.loads(done.stdout), done.stderr


def write_dataset(path):
    """Write 800 rows, three of them bad."""
    rows = [pinch(mu, id=f'g{i}') for i, mu in enumerate(frictions(COUNT), 1)]
    for row in BAD:
        rows[row - 1] = f'bad row {row}'
    return write_lines(path, rows)

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

DEADLINE_S = 120.0
PR_SET_PDEATHSIG = 1  # linux/prctl.h
TASK = '0 0 2 0 0 0'
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

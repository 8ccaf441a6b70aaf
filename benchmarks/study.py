# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality study``: rows a second on this machine, and that memory does not grow."""

import json
import os
from pathlib import Path
import subprocess
import sys
import tempfile
import time

from benchmarks import document
import numpy as np

ROWS = (5_000, 20_000)
CONTACTS = 5
TASK = '0 0 2 0 0 0'


def measure():
    """Return the section as Markdown."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for count in ROWS:
            dataset = write_dataset(Path(folder) / f'{count}.jsonl', count)
            for workers in sorted({1, len(os.sched_getaffinity(0))}):
                seconds, summary, peak = timed(dataset, workers)
                rows.append([f'{count:,}', f'{dataset.stat().st_size / 1e6:.1f}', workers,
                             f'{seconds:.1f}', f'{count / seconds:,.0f}', f'{peak / 1024:.0f}',
                             summary['unproved']])
    return '\n'.join([
        '## Studies', '', document.machine(),
        f'`grasp-quality study` on JSON lines, {CONTACTS} contacts a row, from start to end of '
        'the command. Peak memory is that of its largest process.', '',
        document.table(['rows', 'file [MB]', 'workers', 'time [s]', 'rows a second',
                        'peak memory [MB]', 'unproved'], rows)])


def write_dataset(path, count):
    """Write random grasps of a ball."""
    rng = np.random.default_rng(0)
    with open(path, 'w') as file:
        for i in range(count):
            points = rng.normal(size=(CONTACTS, 3))
            points *= 0.03 / np.linalg.norm(points, axis=1, keepdims=True)
            contacts = [{'position': p.tolist(), 'normal': (-p).tolist()} for p in points]
            file.write(json.dumps({'id': i, 'contacts': contacts, 'defaults': {
                'friction': 0.5, 'max_normal_force': 10.0}}) + '\n')
    return path


def timed(dataset, workers):
    """Return the time [s] of a study, its summary, and its peak memory [KB]."""
    output = dataset.with_suffix(f'.{workers}.parquet')
    program = [sys.executable, '-m', 'grasp_quality_cli.main', 'study', dataset, '-o', output,
               '--task', TASK, '--workers', str(workers), '--json']
    begin = time.perf_counter()
    with subprocess.Popen([str(part) for part in program], stdout=subprocess.PIPE) as running:
        printed = running.stdout.read()
        _, code, usage = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(code)
    if running.returncode:
        raise RuntimeError(f'the study ended with code {running.returncode}')
    return time.perf_counter() - begin, json.loads(printed), usage.ru_maxrss

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
How fast ``grasp-quality bag`` is, and how much memory it takes: figures of docs/recorded_data.md.

    python -m benchmarks.recorded_data rate FOLDER
    python -m benchmarks.recorded_data memory FOLDER --megabytes 100 1000

The bags are made in FOLDER first, which needs their size as free space.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import subprocess
import sys
import tempfile
import time

from benchmarks.recorded_bag import write_hand
from grasp_quality import TaskWrench
from grasp_quality.node_parameters import Settings
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_replay import Question, replay
from grasp_quality_cli.bag_source import BagSource
from grasp_quality_cli.bag_tables import Tables

TASK = '0 0 2 0 0 0'
CONTACTS = 8
WARM_UP, SAMPLES = 300, 20_000
FILLER = 40_000  # bytes beside each sample, as of a camera


def once(bag: Path) -> float:
    """Replay a bag, with its tables written; return the samples a second."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = BagSource(bag)
        question = Question(Settings(), '/grasp_quality',
                            TaskWrench([float(v) for v in TASK.split()]), None)
        begun = time.perf_counter()
        with Problems(folder / 'problems.csv') as problems, Tables(folder, 'parquet') as tables:
            summary = replay(source, question, tables, problems, lambda count: None)
        return summary.samples / (time.perf_counter() - begun)


def rate(folder: Path) -> None:
    """Print samples a second; run under ``taskset -c 0`` for one core."""
    print('| bag | messages a sample | samples a second |\n| --- | --- | --- |')
    for storage in ('mcap', 'db3'):
        for measured in (False, True):
            bag = folder / f'rate_{storage}_{measured}'
            if not bag.exists():
                write_hand(bag, SAMPLES, CONTACTS, storage, measured)
                write_hand(folder / f'warm_{storage}_{measured}', WARM_UP, CONTACTS, storage,
                           measured)
            once(folder / f'warm_{storage}_{measured}')
            messages = 1 + CONTACTS * measured
            print(f'| {storage} | {messages} | {once(bag):,.0f} |', flush=True)


def memory(folder: Path, megabytes: list[int]) -> None:
    """Print the peak memory of whole runs of the program, one bag after the other."""
    print('| bag | size [MB] | samples | peak memory [MB] | time [s] |\n'
          '| --- | --- | --- | --- | --- |')
    for storage in ('mcap', 'db3'):
        for size in megabytes:
            bag = folder / f'memory_{storage}_{size}'
            samples = int(size * 1e6 / (FILLER + 1500))
            if not bag.exists():
                write_hand(bag, samples, CONTACTS, storage, True, FILLER)
            begun = time.perf_counter()
            program = (
                'import resource, sys; from grasp_quality_cli.main import main; code = main(); '
                'print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr); '
                'sys.exit(code)')
            done = subprocess.run(
                [sys.executable, '-c', program, 'bag', str(bag), '--task', TASK, '-o',
                 str(folder / 'out')], check=True, capture_output=True, text=True)
            peak = int(done.stderr.split()[-1]) / 1000
            real = sum(f.stat().st_size for f in bag.iterdir()) / 1e6
            print(f'| {storage} | {real:,.0f} | {samples:,} | {peak:,.0f} | '
                  f'{time.perf_counter() - begun:.0f} |', flush=True)


def main() -> None:
    """Read the command line and measure."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').strip().splitlines()[0])
    parser.add_argument('what', choices=('rate', 'memory'))
    parser.add_argument('folder', type=Path)
    parser.add_argument('--megabytes', type=int, nargs='+', default=[100, 1000])
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.what == 'rate':
        rate(options.folder)
    else:
        memory(options.folder, options.megabytes)


if __name__ == '__main__':
    main()

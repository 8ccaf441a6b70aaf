# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
``make fuzz``: a million spoilt questions to the node's own code, judged and cross-checked.

``python -m benchmarks.fuzz --replay FILE`` asks one kept question again.
"""

import argparse
from concurrent.futures import as_completed, ProcessPoolExecutor
import multiprocessing
import os
from pathlib import Path
import sys
import time

from benchmarks.fuzz.runs import replay, run, Tally

QUESTIONS = 1_000_000
CHECK_EVERY = 300
CHUNK = 2_000
SHOWN = 20
FOLDER = Path('build/fuzz')


def main() -> int:
    """Run; return 1 when an answer was wrong."""
    parser = argparse.ArgumentParser(prog='python -m benchmarks.fuzz', description=__doc__)
    parser.add_argument('--questions', type=int, default=QUESTIONS)
    parser.add_argument('--seed', type=int, default=0, help='of the first question')
    parser.add_argument('--workers', type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument('--check-every', type=int, default=CHECK_EVERY,
                        help='one answered question in so many goes to another solver; 0: none')
    parser.add_argument('--folder', type=Path, default=FOLDER,
                        help='where questions with a wrong answer are written')
    parser.add_argument('--replay', type=Path, nargs='+', metavar='FILE')
    arguments = parser.parse_args()
    if arguments.replay:
        wrong = [(path, text) for path in arguments.replay for text in replay(path)]
        for path, text in wrong:
            print(f'{path}: {text}')
        print(f'{len(arguments.replay)} kept questions, {len(wrong)} violations')
        return int(bool(wrong))
    started = time.monotonic()
    tally = _run(arguments)
    print(table(tally, time.monotonic() - started))
    for seed, text in sorted(tally.violations)[:SHOWN]:
        print(f'seed {seed}: {text}'[:400])
    if tally.violations:
        print(f'{len(tally.violations)} violations; to ask one again: python -m benchmarks.fuzz '
              f'--replay {arguments.folder}/<kind>_<seed>.json')
    return int(bool(tally.violations))


def _run(arguments: argparse.Namespace) -> Tally:
    begin, end = arguments.seed, arguments.seed + arguments.questions
    parts = [range(first, min(first + CHUNK, end)) for first in range(begin, end, CHUNK)]
    total = Tally()
    with ProcessPoolExecutor(arguments.workers, multiprocessing.get_context('spawn')) as pool:
        jobs = [pool.submit(run, part, arguments.check_every, arguments.folder) for part in parts]
        for count, job in enumerate(as_completed(jobs), 1):
            total.add(job.result())
            if count % max(1, len(parts) // 20) == 0:
                print(f'{total.questions:,} questions, {len(total.violations)} violations',
                      file=sys.stderr, flush=True)
    return total


def table(tally: Tally, seconds: float) -> str:
    """Return the figures as Markdown."""
    rows = [('questions', tally.questions), ('messages', tally.messages),
            ('of these through serialization', tally.on_wire),
            ('questions that reached a solver', tally.solved),
            *sorted(tally.codes.items(), key=lambda item: -item[1]),
            *((f'cross-checks: {name}', count) for name, count in sorted(tally.checks.items())),
            ('violations', len(tally.violations))]
    whole = max(tally.questions, 1)
    lines = ['| what | count | share |', '|---|---|---|']
    lines += [f'| {name} | {count:,} | {100.0 * count / whole:.1f} % |' if name in (
        'questions that reached a solver', *tally.codes) else f'| {name} | {count:,} | |'
        for name, count in rows]
    return '\n'.join([*lines, f'{seconds:.0f} s'])


if __name__ == '__main__':
    sys.exit(main())

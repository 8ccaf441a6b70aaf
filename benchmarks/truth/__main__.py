# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Pull on simulated grasps, compare with alpha, write docs/truth.md, and fail on a broken bound.

With ``--dry`` the document is left alone; ``--cases`` and ``--seed`` choose other cases.
"""

import argparse
from pathlib import Path
import sys
import time

from benchmarks import document
from benchmarks.truth import report
from benchmarks.truth.cases import COUNT, SEED
from benchmarks.truth.gates import all_gates
from benchmarks.truth.picture import draw
from benchmarks.truth.trials import DIRECTIONS, run

DOCUMENT = Path(__file__).parents[2] / 'docs' / 'truth.md'
PICTURE = DOCUMENT.parent / 'images' / 'truth.png'
WAYS = {('ball', 'PCWF'): DIRECTIONS, ('cube', 'PCWF'): DIRECTIONS, ('cylinder', 'PCWF'): 8,
        ('ball', 'SFCE'): 8, ('cube', 'SFCE'): 8}


def main() -> int:
    """Run everything that the command line asks for; return the exit code."""
    parser = argparse.ArgumentParser(description='Figures of docs/truth.md.')
    parser.add_argument('--dry', action='store_true', help='print only')
    parser.add_argument('--cases', type=int, default=COUNT)
    parser.add_argument('--seed', type=int, default=SEED)
    arguments = parser.parse_args()
    begin = time.monotonic()
    results = run(arguments.cases, arguments.seed, WAYS)
    gates = all_gates(results)
    text = '\n\n'.join([
        report.circumstances(results, arguments.seed, time.monotonic() - begin),
        report.verdict_table(gates), report.ratio_table(results), 'The five that are off by most:',
        report.worst_table(results)])
    print(text, flush=True)
    if not arguments.dry:
        document.write('truth', text, DOCUMENT)
        draw(results, PICTURE)
    broken = [gate.what for gate in gates if not gate.kept]
    for what in broken:
        print(f'bound broken: {what}', file=sys.stderr)
    return 1 if broken else 0


if __name__ == '__main__':
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""First answers of new processes, without and with the machine code in numba's cache; memory."""

import os
from pathlib import Path
import subprocess
import sys
import tempfile

from benchmarks import document

ROOT = Path(__file__).parents[1]
FIRST = """
import time
begin = time.perf_counter()
from grasp_quality import Contact, evaluate, evaluate_many, Grasp, TaskWrench, wrench_map
imported = time.perf_counter() - begin
grasp = Grasp([Contact((-1, 0, 0), (1, 0, 0)), Contact((1, 0, 0), (-1, 0, 0))])
evaluate(grasp, TaskWrench([0, 1, 0, 0, 0, 0]))
answered = time.perf_counter() - begin
wrench_map(grasp, [[0, 1, 0, 0, 0, 0]])
evaluate_many([grasp], [0, 1, 0, 0, 0, 0])
print(imported, answered, time.perf_counter() - begin)
"""
MEMORY = """
import gc
from pathlib import Path
import numpy as np
from benchmarks.solvers import problem
from grasp_quality import wrench_map
def kilobytes(name):
    for line in Path('/proc/self/status').read_text().splitlines():
        if line.startswith(name + ':'):
            return int(line.split()[1])
grasp, tasks = problem(8)
wrench_map(grasp, tasks[:300], forces=True)
for forces in (False, True):
    gc.collect()
    Path('/proc/self/clear_refs').write_text('5')  # the peak counts from here
    before = kilobytes('VmRSS')
    answer = wrench_map(grasp, tasks, forces=forces)
    print((kilobytes('VmHWM') - before) / 1024)
    del answer
"""
REPETITIONS = 5


def run(code, cache):
    """Run code in a process of its own, with numba's cache in that folder; return its numbers."""
    environment = {**os.environ, 'NUMBA_CACHE_DIR': cache,
                   'PYTHONPATH': f'{ROOT}:{os.environ.get("PYTHONPATH", "")}'}
    done = subprocess.run([sys.executable, '-c', code], env=environment, cwd=ROOT, check=True,
                          capture_output=True, text=True)
    return [float(number) for number in done.stdout.split()]


def measure():
    """Return the section as Markdown."""
    machine = document.machine()
    with tempfile.TemporaryDirectory() as cache:
        first = run(FIRST, cache)
        again = sorted((run(FIRST, cache) for _ in range(REPETITIONS)),
                       key=lambda times: times[1])[REPETITIONS // 2]
        memory = run(MEMORY, cache)

    def row(name, times):
        return [name, *(f'{seconds:.2f}' for seconds in times)]

    return '\n'.join([
        '## First answers and memory', '', machine,
        f'From the first line of a new process on; the later process is the median of '
        f'{REPETITIONS}. Asked for: below 1 s to the first answer once the machine code is '
        'cached.', '',
        document.table(
            ['process', 'import [s]', 'first answer of `evaluate` [s]',
             'of `wrench_map` and `evaluate_many` too [s]'],
            [row('first on a machine, compiles', first), row('later ones', again)]), '',
        f'A map of 2,592 directions at 8 contacts takes {memory[0]:.1f} MB on top of the process, '
        f'{memory[1]:.1f} MB with forces (peak of the resident set; asked for: below 20 MB).'])

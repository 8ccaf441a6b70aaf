# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Long runs with faults: ``make soak``, or ``python -m benchmarks.soak --seconds 120``.

8 contacts at 200 Hz, two client processes and an auditor, and every few seconds a fault drawn at
random from a seed (``soak_faults``); with ``--calm`` no faults. Prints what was answered, lost and
remembered, and ends with code 1 when a promise of docs/reliability.md is broken. What is promised
does not depend on the speed of the machine; delays are counted in calm times only, a second away
from all faults.

Memory may grow by less than 1 MB from the first minute on when calm. With faults it is the second
half of the run that may not add 1 MB, once every kind of fault has been: what is done for the
first times loads code and takes memory that is kept for the next.
"""

import argparse
from collections import Counter
import os
from pathlib import Path
import sys
import tempfile
import time

from benchmarks import document
from benchmarks.soak_faults import Faults
from benchmarks.witness import inside, resident_mb, Witness
from callers import start_callers
from harness import start_audit, start_node
from msg_adapters.results import code_name
import numpy as np
from rig import start_feed, TASK
from transports import dropped, lost_words

NAMESPACE = '/soak'
RATE_HZ = 200.0
MAX_AGE_S = 0.1
SETTLED_S = 60.0     # memory is compared with what it was then; with faults, later
MEASURED_S = 30.0    # at least, from then on
MOST_GROWTH_MB = 1.0
MEMORY = ('memory of its own', 'pages of files', 'shared memory', 'resident memory')
CALM_S = 1.0         # after a fault, before delays count
EVERY_S = 6.0        # from the end of a fault to the next


class Soak:
    """The processes of a run, and what is measured of them."""

    def __init__(self, allowance_s):
        self.logs = Path(tempfile.mkdtemp())
        self._number = 0
        self.node = self.new_node()
        self.audit = start_audit(
            self.logs / 'audit.txt', NAMESPACE, age_allowance=allowance_s)
        self.audit.until_it_says('listening')
        self.witness = Witness(NAMESPACE, MAX_AGE_S, allowance_s)
        self.feed = self.new_feed()
        self.callers = [self.new_callers(), self.new_callers()]
        self.begin = time.monotonic()
        self.resident = []  # (s, MB of each kind)
        self.settled = None  # [s]
        self.lost = 0       # datagrams, outside of faults

    def log(self, what):
        """Return a new file for what a process prints."""
        self._number += 1
        return self.logs / f'{self._number}_{what}.txt'

    def new_node(self):
        """Start the node and wait until it is active."""
        node = start_node(self.log('node'), NAMESPACE, max_contact_age=MAX_AGE_S,
                          task_wrench=TASK)
        node.until_it_says('active')
        return node

    def new_feed(self, *options):
        """Start a publisher of contacts."""
        return start_feed(self.log('feed'), NAMESPACE, '--grasp', 'EIGHT', '--rate',
                          str(RATE_HZ), *options)

    def new_callers(self):
        """Start a process of clients, which give a question up after 5 s."""
        return start_callers(
            self.log('callers'), NAMESPACE, '--clients', '2', '--number', str(10 * self._number),
            '--patience', '5', '--pause', '0.05')

    def elapsed(self):
        """Return how long the run has lasted [s]."""
        return time.monotonic() - self.begin

    def watch(self, seconds):
        """Listen for a while."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            self.witness.watch(min(left, 0.2))
            if self.elapsed() > len(self.resident):
                self.resident.append((self.elapsed(), resident_mb(self.node.popen.pid)))

    def calm(self, seconds):
        """Watch with no fault; return the window [ns], and count what sockets had no room for."""
        self.watch(CALM_S)
        before, begin_ns = dropped(self.node.popen.pid), time.time_ns()
        self.watch(max(0.0, seconds - CALM_S))
        self.lost += dropped(self.node.popen.pid) - before
        return begin_ns, time.time_ns()


def memory(soak):
    """
    Return it when it was settled, after every minute, at the end: medians of 5 samples [MB].

    Rows are these times, columns the kinds of ``resident_mb`` and their sum.
    """
    times = np.array([seconds for seconds, _ in soak.resident])
    sizes = np.array([[*size, size.sum()] for _, size in soak.resident])
    minutes = np.arange(SETTLED_S, times[-1] - 30.0, 60.0)
    return np.array([np.median(sizes[times <= end][-5:], axis=0)
                     for end in (soak.settled, *minutes, times[-1])])


def run(seconds, seed, allowance_s, is_calm):
    """Run for a while; return the soak, its faults and the calm windows."""
    soak = Soak(allowance_s)
    faults = Faults(soak, seed, may_restart=lambda: soak.elapsed() < 0.5 * SETTLED_S)
    windows = [soak.calm(5.0)]
    while soak.settled is None or soak.elapsed() < max(seconds, soak.settled + MEASURED_S):
        if not is_calm:
            faults.one()
        windows.append(soak.calm(EVERY_S))
        if soak.settled is None and soak.elapsed() > SETTLED_S and (
                is_calm or (faults.each_has_been and soak.elapsed() > 0.5 * seconds)):
            soak.settled = soak.elapsed()
    soak.feed.end()
    soak.watch(3 * MAX_AGE_S)
    return soak, faults, windows


def main():
    """Run, print the table, and return 1 when a promise is broken."""
    parser = argparse.ArgumentParser(description='A long run with random faults.')
    parser.add_argument('--seconds', type=float, default=600.0)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--age-allowance', type=float, default=0.05, help=(
        'how much older than max_contact_age contacts may be when forces are sent [s]: more on a '
        'machine that stops its processes'))
    parser.add_argument('--calm', action='store_true', help='without faults')
    asked = parser.parse_args()
    machine = document.machine()
    soak, faults, windows = run(
        asked.seconds, asked.seed, asked.age_allowance, asked.calm)
    resident = memory(soak)
    growth = resident[-1] - resident[0]
    grown = float(growth[-1])
    counts = [process.counts() for process in soak.callers]
    soak.witness.client.close()
    node_log, codes = soak.node.log(), [soak.node.end(), soak.audit.end()]
    broken = [*soak.witness.broken, *faults.broken]
    broken += [f'memory grew by {grown:.2f} MB'] * (grown >= MOST_GROWTH_MB)
    broken += [f'{c["answered"]} answers and {c["lost"]} given up of {c["asked"]} questions'
               for c in counts if c['answered'] + c['lost'] != c['asked'] or not c['fewest']]
    broken += [line for line in soak.audit.log().splitlines() if 'VIOLATION' in line][:5]
    broken += [f'exit codes of node and audit: {codes}'] * any(codes)
    broken += [f'the log of the node says {words!r}' for words in ('internal error', 'Traceback')
               if words in node_log]
    print(f'{asked.seconds:g} s, seed {asked.seed}; {machine}\n')
    print(document.table(['', ''], [
        *rows(soak, windows),
        ('faults', ', '.join(
            f'{n} x {name}' for name, n in sorted(faults.done.items())) or 'none'),
        *((f'{kind} after each minute, at the end [MB]',
           ', '.join(f'{size:.2f}' for size in sizes))
          for kind, sizes in zip(MEMORY, resident[1:].T)),
        (f'growth of these since {soak.settled:.0f} s [MB]',
         ', '.join(f'{size:.2f}' for size in growth)),
        ('audit', soak.audit.log().splitlines()[-1])]))
    for text in broken[:20]:
        print(f'BROKEN: {text}')
    if broken:
        print(f'logs: {soak.logs}')
    return int(bool(broken))


def rows(soak, windows):
    """Make the lines of the table about samples and answers."""
    witness = soak.witness
    sent, answered = witness.counts(windows)
    delays = witness.delays_ms(windows)
    late = int((delays > 1e3 / RATE_HZ).sum())
    failures = Counter(code_name(code) for code, sent_ns in witness.failures
                       if inside(sent_ns, windows))
    return [
        ('samples sent in all, answered', ', '.join(map(str, witness.counts([(0, 2 ** 63)])))),
        ('samples sent in calm times', sent),
        ('of these answered', answered),
        ('of these replaced by a newer one', sent - answered - soak.lost),
        ('of these lost by the middleware', lost_words(soak.lost)),
        ('failures in calm times', ', '.join(
            f'{n} x {name}' for name, n in sorted(failures.items())) or '0'),
        ('contacts to quality, median / p99 / p99.9 / most [ms]',
         ' / '.join(f'{v:.2f}' for v in np.percentile(delays, [50, 99, 99.9, 100]))),
        (f'answered later than a period of {1e3 / RATE_HZ:g} ms', late)]


if __name__ == '__main__':
    os.environ['ROS_LOG_DIR'] = tempfile.mkdtemp()
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
More than the node can answer: ``python -m benchmarks.load``.

32 contacts at 1 kHz and eight client processes that ask all the time, an auditor beside them.
Prints what got through, how fast and with how much memory, and ends with code 1 when a promise of
docs/reliability.md is broken: an answer that is old or goes back, a question without an answer, a
violation.
"""

import argparse
from pathlib import Path
import sys
import tempfile
import time

from benchmarks import document
from benchmarks.witness import resident_mb, Witness
from callers import start_callers
from grasp_quality_msgs.msg import ResultCode
from harness import start_audit, start_node
import numpy as np
from rig import start_feed, TASK
from transports import dropped, lost_words

CONTACTS, RATE_HZ, CLIENTS = 32, 1000, 8
MAX_AGE_S, ALLOWANCE_S = 0.1, 0.05
NAMESPACE = '/load'


def main():
    """Load the node; return 1 when a promise is broken."""
    parser = argparse.ArgumentParser(description='A node under more load than it can answer.')
    parser.add_argument('--seconds', type=float, default=60.0)
    seconds = parser.parse_args().seconds
    logs = Path(tempfile.mkdtemp())
    machine = document.machine()
    node = start_node(logs / 'node.txt', NAMESPACE, max_contact_age=MAX_AGE_S, task_wrench=TASK)
    audit = start_audit(logs / 'audit.txt', NAMESPACE)
    node.until_it_says('active')
    audit.until_it_says('listening')
    witness = Witness(NAMESPACE, MAX_AGE_S, ALLOWANCE_S)
    feed = start_feed(logs / 'feed.txt', NAMESPACE, '--ring', str(CONTACTS), '--rate',
                      str(RATE_HZ))
    callers = [start_callers(logs / f'caller_{i}.txt', NAMESPACE, '--number', str(i))
               for i in range(CLIENTS)]
    begin_ns, begin = time.time_ns(), time.monotonic()
    lost, resident = dropped(node.popen.pid), []
    while time.monotonic() < begin + seconds:
        witness.watch(0.2)
        if time.monotonic() > begin + len(resident):
            resident.append(resident_mb(node.popen.pid).sum())
    windows = [(begin_ns, time.time_ns())]
    lost = dropped(node.popen.pid) - lost
    feed.end()
    counts = [process.counts() for process in callers]
    ended_ns = time.time_ns()
    witness.until(
        lambda: any(code == ResultCode.STALE_CONTACTS and sent_ns > ended_ns
                    for code, sent_ns in witness.failures), 'STALE_CONTACTS')
    backlog = {stamp for stamp, sent_ns in witness.answers if sent_ns > ended_ns}
    witness.client.close()
    codes = [node.end(), audit.end()]
    delays = witness.delays_ms(windows)
    sent, answered = witness.counts(windows)
    took = np.array([count['ms'] for count in counts])
    broken = [*witness.broken,
              *(f'a client got {c["answered"]} answers to {c["asked"]} questions' for c in counts
                if c['lost'] or c['answered'] != c['asked'])]
    broken += [f'{len(backlog)} samples were answered after contacts had ended'] * bool(backlog)
    broken += [f'exit codes of node and audit: {codes}'] * any(codes)
    quarter = len(resident) // 4
    print(f'{CONTACTS} contacts at {RATE_HZ} Hz and {CLIENTS} client processes for {seconds:g} s; '
          f'{machine}\n')
    print(document.table(['', ''], [
        ('samples sent a second', f'{sent / seconds:.0f}'),
        ('answered a second', f'{answered / seconds:.0f}'),
        ('lost by the middleware', lost_words(lost)),
        ('contacts to quality, median / p99 / p99.9 [ms]',
         ' / '.join(f'{v:.2f}' for v in np.percentile(delays, [50, 99, 99.9]))),
        ('questions answered a second', f'{sum(c["answered"] for c in counts) / seconds:.0f}'),
        ('question to answer, median / p99 / p99.9 / longest of the slowest client [ms]',
         ' / '.join(f'{v:.1f}' for v in took.max(axis=0))),
        ('resident memory, second to last quarter [MB]',
         f'{np.median(resident[quarter:2 * quarter]):.2f} to '
         f'{np.median(resident[-quarter:]):.2f}'),
        ('answered after contacts had ended', len(backlog)),
        ('audit', audit.log().splitlines()[-1])]))
    for text in broken[:20]:
        print(f'BROKEN: {text}')
    return int(bool(broken))


if __name__ == '__main__':
    sys.exit(main())

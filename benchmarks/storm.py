# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a node remembers of processes that were killed: ``python -m benchmarks.storm``.

Publishers and clients come, talk to the node and are killed (SIGKILL); beside it, the same for a
process that only echoes (``node_echo``). Prints the resident memory by kind, which
has to come to rest: what is kept of every process would go on growing. Compare with
``TEST_TRANSPORTS=default``.
"""

import argparse
import os
from pathlib import Path
import sys
import tempfile
import time

from benchmarks import document
from benchmarks.witness import resident_mb, ROOT
from callers import start_callers
from harness import Process, start_node
from rig import kill, start_feed, TASK
import transports

SETTLED_S = 3.0
LEASE_S = 30.0  # Fast DDS forgets a silent participant after 20 s
EVERY = 10      # processes, from one line to the next


def storm(node, namespace, count, logs, *, clients):
    """Kill so many publishers and clients; return (name of the line, *memory [MB])."""
    pid = node.popen.pid
    node.until_it_says('active')
    feed = start_feed(logs / 'feed.txt', namespace, '--grasp', 'EIGHT', '--rate', '100')
    time.sleep(SETTLED_S)
    rows = [('before', *resident_mb(pid))]
    for i in range(count // 2):
        publisher = start_feed(logs / f'feed_{i}.txt', namespace, '--grasp', 'EIGHT')
        caller = start_callers(logs / f'caller_{i}.txt', namespace, '--clients', str(clients),
                               '--pause', '0.05')
        kill(publisher)
        kill(caller)
        if (2 * i + 2) % EVERY == 0:
            rows.append((f'{2 * i + 2} killed', *resident_mb(pid)))
    time.sleep(LEASE_S)
    rows.append((f'{LEASE_S:g} s later', *resident_mb(pid)))
    feed.end()
    node.end()
    return rows


def main():
    """Measure both and print the tables."""
    parser = argparse.ArgumentParser(description='Memory of a node whose clients are killed.')
    parser.add_argument('--processes', type=int, default=60)
    count = parser.parse_args().processes
    machine = document.machine()
    logs = Path(tempfile.mkdtemp())
    print(f'{transports.words()}; {machine}')
    for name, namespace, clients, start in (
            ('the node', '/storm', 3, lambda: start_node(
                logs / 'node.txt', '/storm', max_contact_age='0.1', task_wrench=TASK)),
            ('an echo in rclpy', '/echo', 1, lambda: Process(
                [sys.executable, '-m', 'benchmarks.node_echo', '/echo'], logs / 'echo.txt',
                cwd=ROOT))):
        rows = storm(start(), namespace, count, logs, clients=clients)
        print(f'\n{name}\n')
        print(document.table(
            ['', 'its own [MB]', 'pages of files [MB]', 'shared [MB]'],
            [(words, *(f'{size:.2f}' for size in sizes)) for words, *sizes in rows]))
    return 0


if __name__ == '__main__':
    os.environ['ROS_LOG_DIR'] = tempfile.mkdtemp()
    sys.exit(main())

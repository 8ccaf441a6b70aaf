# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The node from outside: round trips by service and by topic, and the live loop at 200 Hz.

Node and client are processes of their own, with 8 contacts (``transports``). The same client
measures a process that only echoes (``node_echo``), for scale.
"""

from contextlib import contextmanager
from dataclasses import dataclass
import os
from pathlib import Path
import sys
import tempfile
import time

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / 'test' / 'node'))

from benchmarks import document  # noqa: E402
from geometry_msgs.msg import PoseArray  # noqa: E402
from grasp_quality_msgs.msg import GraspQuality, ResultCode  # noqa: E402
from grasp_quality_msgs.srv import EvaluateTaskWrench  # noqa: E402
from grasps import EIGHT, pose_array, wrench  # noqa: E402
from harness import BEST_EFFORT, Client, Process, start_node  # noqa: E402
from msg_adapters.stamps import seconds, stamp_ns  # noqa: E402
import numpy as np  # noqa: E402
import transports  # noqa: E402

SAMPLES, WARM_UP = 2000, 200
RATE_HZ, LIVE_S = 200.0, 60.0
LOST_S = 1.0  # an answer that takes longer counts as lost
TASK = '[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]'


@dataclass
class RoundTrips:
    """Times [ms] of one kind of round trip, and what of each the node spent on solving."""

    total: np.ndarray
    solving: np.ndarray
    lost: int = 0

    def row(self, name):
        """Return the cells of a line of the table."""
        median, p99 = np.median(self.total), np.percentile(self.total, 99)
        solving = np.median(self.solving)
        return (name, f'{median:.3f}', f'{p99:.3f}', f'{solving:.3f}',
                f'{100 * solving / median:.0f} %', len(self.total), self.lost)


@contextmanager
def running(process, namespace):
    """Wait for a process, give a client for it, end both."""
    try:
        process.until_it_says('active')
        client = Client(namespace)
        try:
            yield client
        finally:
            client.close()
    finally:
        process.end()


def log_file():
    """Return a path for what a process prints."""
    return Path(tempfile.mkdtemp()) / 'log.txt'


def service_round_trips(client):
    """Ask about the latest contacts, one question after the other."""
    contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    caller = client.node.create_client(
        EvaluateTaskWrench, f'{client.target}/evaluate_task_wrench')
    client.until(caller.service_is_ready, 'the service')
    request = EvaluateTaskWrench.Request(task_wrench=wrench(fz=1.0))
    contacts.publish(pose_array(EIGHT, client.now()))
    total, solving = [], []
    while len(total) < SAMPLES + WARM_UP:
        begin = time.perf_counter()
        future = caller.call_async(request)
        while not future.done():
            client.spin_once(LOST_S)
        total.append(time.perf_counter() - begin)
        solving.append(seconds(future.result().solve_time))
        if not len(future.result().forces.forces) == len(EIGHT):
            raise RuntimeError(f'no answer: {future.result().result}')
    return RoundTrips(1e3 * np.array(total[WARM_UP:]), 1e3 * np.array(solving[WARM_UP:]))


def topic_round_trips(client):
    """Publish contacts, wait for the quality with their stamp, and so on."""
    contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    heard = client.listen(GraspQuality, 'quality')
    message = pose_array(EIGHT)
    total, solving, lost = [], [], 0
    while len(total) < SAMPLES + WARM_UP:
        message.header.stamp = client.now()
        heard.clear()
        begin = time.perf_counter()
        contacts.publish(message)
        while not any(m.header.stamp == message.header.stamp for m in heard):
            client.spin_once(LOST_S)
            if time.perf_counter() - begin > LOST_S:
                lost += 1
                break
        else:
            total.append(time.perf_counter() - begin)
            solving.append(seconds(heard[-1].solve_time))
    return RoundTrips(1e3 * np.array(total[WARM_UP:]), 1e3 * np.array(solving[WARM_UP:]), lost)


def live_loop(client, pid):
    """Publish contacts at a steady rate, and note every answer."""
    contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    heard = client.listen(GraspQuality, 'quality')
    message = pose_array(EIGHT)
    for _ in range(WARM_UP):
        client.spin_once(1.0 / RATE_HZ)
    heard.clear()
    sent = set()
    begin, used = time.perf_counter(), cpu_s(pid)
    count = int(RATE_HZ * LIVE_S)
    for i in range(count):
        due = begin + i / RATE_HZ
        while (left := due - time.perf_counter()) > 0.0:
            client.spin_once(left)
        message.header.stamp = client.now()
        sent.add(stamp_ns(message.header.stamp))
        contacts.publish(message)
    elapsed, used = time.perf_counter() - begin, cpu_s(pid) - used
    last = time.perf_counter()
    while time.perf_counter() - last < 0.05:  # the silence that follows is no failure yet
        client.spin_once(0.01)
    answers = [m for m in heard if m.result.code == ResultCode.OPTIMAL]
    ages = 1e3 * np.array([seconds(m.contact_age) for m in answers])
    answered = len(sent & {stamp_ns(m.header.stamp) for m in answers})
    return {'sent': count, 'answered': answered, 'failures': len(heard) - len(answers),
            'ages': ages, 'cpu': used / elapsed, 'rate': count / elapsed}


def cpu_s(pid):
    """Return the processor time [s] that a process has used."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def measure():
    """Measure everything; return the lines of the section."""
    machine = document.machine()
    rows = []
    echo = Process([sys.executable, '-m', 'benchmarks.node_echo', '/echo'], log_file(), cwd=ROOT)
    with running(echo, '/echo') as client:
        rows.append(service_round_trips(client).row('service, echo'))
        rows.append(topic_round_trips(client).row('topic, echo'))
    node = start_node(log_file(), '/bench', max_contact_age='600.0')
    with running(node, '/bench') as client:
        rows.append(service_round_trips(client).row('service `evaluate_task_wrench`'))
    node = start_node(log_file(), '/bench', max_contact_age='600.0', task_wrench=TASK)
    with running(node, '/bench') as client:
        rows.append(topic_round_trips(client).row('topic `contact_poses` to `quality`'))
    node = start_node(log_file(), '/bench', task_wrench=TASK)
    with running(node, '/bench') as client:
        live = live_loop(client, node.popen.pid)
    return section(rows, live, machine)


def section(rows, live, machine):
    """Write the section as Markdown."""
    late = int((live['ages'] > 1e3 / RATE_HZ).sum())
    return '\n'.join([
        '## The node', '',
        f'Separate processes, {len(EIGHT)} contacts, {transports.words()}; {machine}', '',
        '"Echo" answers with a message made before: it is what rclpy itself takes. Of the '
        'service, solving is the whole of the handler.', '',
        document.table(['round trip', 'median [ms]', 'p99 [ms]', 'solving [ms]', 'share',
                        'samples', 'lost'], rows), '',
        f'Live loop, contacts at {live["rate"]:.0f} Hz for {LIVE_S:.0f} s: '
        f'{live["answered"]} of {live["sent"]} samples answered '
        f'({100 * live["answered"] / live["sent"]:.2f} %), {live["failures"]} failures; contacts '
        f'at most {live["ages"].max():.2f} ms old when answered (median '
        f'{np.median(live["ages"]):.2f}, p99 {np.percentile(live["ages"], 99):.2f}; {late} older '
        f'than one period of {1e3 / RATE_HZ:.0f} ms); the node used {live["cpu"]:.2f} of a core.'])

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The node as its own process, and a client beside it, in a ROS domain that nobody else uses.

Whoever imports this keeps to this machine, with all the processes that it starts.

Nothing here sleeps in the hope that something has happened: every wait is for a condition, and
fails after ``DEADLINE_S``.
"""

import ctypes
import functools
import os
from pathlib import Path
import random
import signal
import socket
import subprocess
import time

from ament_index_python.packages import get_package_prefix
from msg_adapters import qos
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from transports import keep_to_this_machine

keep_to_this_machine()

DEADLINE_S = 60.0
START_S = 120.0  # the first start after a change compiles the solver
FEED_PERIOD_S = 0.01
PR_SET_PDEATHSIG = 1  # linux/prctl.h
FIRST_PORT = 32768  # a TCP port per domain: who binds it has the domain
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@functools.cache
def claim_domain():
    """Return (ROS domain id, the bound socket that keeps others from it)."""
    for domain in random.sample(range(1, 102), 101):
        claim = socket.socket()
        try:
            claim.bind(('127.0.0.1', FIRST_PORT + domain))
        except OSError:
            claim.close()
            continue
        return domain, claim
    raise RuntimeError('no free ROS domain: end another test run first')


def end_with_parent(parent):
    """Ask the kernel for a SIGTERM when the test run is gone, so that nothing is left behind."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != parent:
        os._exit(1)


class Process:
    """A child in a session of its own, with a log file."""

    def __init__(self, command, log, cwd=None, environment=None):
        self._log = Path(log)
        environment = {
            **os.environ, 'ROS_DOMAIN_ID': str(claim_domain()[0]), **(environment or {})}
        with open(self._log, 'wb') as output:
            self.popen = subprocess.Popen(
                [str(part) for part in command], stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, start_new_session=True, env=environment,
                cwd=cwd, preexec_fn=functools.partial(end_with_parent, os.getpid()))

    def log(self):
        """Return what the process has printed."""
        return self._log.read_text(errors='replace')

    def until_it_says(self, words):
        """Wait for words in the log."""
        deadline = time.monotonic() + START_S
        while words not in self.log():
            assert self.popen.poll() is None, f'ended before it said {words!r}:\n{self.log()}'
            assert time.monotonic() < deadline, f'waited {START_S} s for {words!r}'
            time.sleep(FEED_PERIOD_S)

    def wait(self):
        """Return the exit code; kill it and fail when it does not end."""
        try:
            return self.popen.wait(DEADLINE_S)
        except subprocess.TimeoutExpired:
            self.popen.kill()
            self.popen.wait()
            raise AssertionError(f'still running after {DEADLINE_S} s:\n{self.log()}') from None

    def end(self, number=signal.SIGINT):
        """Send a signal and return the exit code."""
        self.popen.send_signal(number)
        return self.wait()


def start_node(log, namespace, *arguments, environment=None, **parameters):
    """Start grasp_quality_node in a namespace; parameters are overrides as on a command line."""
    prefix = Path(get_package_prefix('grasp_quality'))
    command = [prefix / 'lib' / 'grasp_quality' / 'grasp_quality_node', *arguments,
               '--ros-args', '-r', f'__ns:={namespace}']
    for name, value in parameters.items():
        command += ['-p', f'{name}:={value}']
    return Process(command, log, environment=environment)


def start_audit(log, namespace, **parameters):
    """Start the independent check of all forces that the node in a namespace publishes."""
    prefix = Path(get_package_prefix('grasp_quality_hand'))
    command = [prefix / 'lib' / 'grasp_quality_hand' / 'force_audit', '--ros-args', '-r',
               f'__ns:={namespace}', '-p', f'target:={namespace}/grasp_quality']
    for name, value in parameters.items():
        command += ['-p', f'{name}:={value}']
    return Process(command, log)


class Client:
    """A ROS node with context and executor of its own, that talks to the node in a namespace."""

    def __init__(self, namespace):
        self.target = f'{namespace}/grasp_quality'
        self._context = Context()
        rclpy.init(context=self._context, domain_id=claim_domain()[0])
        self.node = rclpy.create_node('client', namespace=namespace, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._clients = {}
        self._publishers = {}

    def close(self):
        """Leave ROS."""
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)

    def now(self):
        """Return the time as a stamp."""
        return self.node.get_clock().now().to_msg()

    def spin_once(self, timeout_s):
        """Run one callback that is ready, or becomes so in time."""
        self._executor.spin_once(timeout_sec=timeout_s)

    def until(self, condition, what, feed=None):
        """Spin until the condition gives something true, and return it; feed() every 10 ms."""
        deadline = time.monotonic() + DEADLINE_S
        due = 0.0
        while not (result := condition()):
            now = time.monotonic()
            assert now < deadline, f'waited {DEADLINE_S} s for {what}'
            if feed is not None and now >= due:
                feed()
                due = now + FEED_PERIOD_S
            self.spin_once(0.5 * FEED_PERIOD_S)
        return result

    def call(self, kind, name, feed=None, /, **fields):
        """Call ~/name of the node and return its response."""
        client = self._clients.get(name)
        if client is None:
            client = self._clients[name] = self.node.create_client(
                kind, f'{self.target}/{name}', qos_profile=qos.questions())
        self.until(client.service_is_ready, f'service {name}', feed)
        future = client.call_async(kind.Request(**fields))
        self.until(future.done, f'an answer of {name}', feed)
        return future.result()

    def publisher(self, kind, topic, qos=1):
        """Return a publisher to ~/topic of the node, once the node listens."""
        if topic not in self._publishers:
            self._publishers[topic] = self.node.create_publisher(
                kind, f'{self.target}/{topic}', qos)
        publisher = self._publishers[topic]
        self.until(publisher.get_subscription_count, f'the node to listen on {topic}')
        return publisher

    def listen(self, kind, topic, feed=None):
        """Subscribe to ~/topic, or to /topic; return the list that its messages are put in."""
        heard = []
        subscription = self.node.create_subscription(
            kind, topic if topic.startswith('/') else f'{self.target}/{topic}', heard.append, 100)
        self.until(subscription.get_publisher_count, f'a publisher of {topic}', feed)
        return heard

    def fresh(self, heard, condition=lambda message: True, what='a message', feed=None):
        """Forget what was heard and return the next message that meets a condition."""
        heard.clear()
        return self.until(
            lambda: next((m for m in heard if condition(m)), None), what, feed)

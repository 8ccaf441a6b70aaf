# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Child processes of the demo, and a ROS domain of their own for them."""

from contextlib import contextmanager
import ctypes
import functools
import os
from pathlib import Path
import random
import signal
import socket
import subprocess

from ament_index_python.packages import get_package_prefix, PackageNotFoundError

DOMAINS = range(1, 102)                 # those whose ports stay below the ephemeral ones
FIRST_PORT = 32768                      # a TCP port per domain: who binds it has the domain
ENDING = ((signal.SIGINT, 5.0), (signal.SIGTERM, 3.0), (signal.SIGKILL, 5.0))    # and wait [s]
PR_SET_PDEATHSIG = 1                    # linux/prctl.h
LAST_LINES = 8                          # of a log that are shown when its process failed


class DemoFailure(RuntimeError):
    """The demo cannot go on; the message says why and what to do."""


class DemoTimeout(DemoFailure):
    """What the demo waited for did not come in time."""


def claim_domain():
    """
    Take a free ROS domain for this process and its children, on this machine only.

    Returns
    -------
    socket.socket
        Holds the domain until it is closed.

    """
    for domain in random.sample(DOMAINS, len(DOMAINS)):
        claim = socket.socket()
        try:
            claim.bind(('127.0.0.1', FIRST_PORT + domain))
        except OSError:
            claim.close()
            continue
        os.environ.update(discovery_environment(domain))
        return claim
    raise DemoFailure(f'no free ROS domain: every TCP port from {FIRST_PORT + DOMAINS[0]} to '
                      f'{FIRST_PORT + DOMAINS[-1]} is taken; end another run first')


def discovery_environment(domain):
    """Return the environment variables that put a process into the domain, on this machine."""
    return {'ROS_DOMAIN_ID': str(domain), 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}


def executable(package, name):
    """Return the path of an installed executable."""
    try:
        path = Path(get_package_prefix(package)) / 'lib' / package / name
    except PackageNotFoundError:
        raise DemoFailure(f'the package {package} is not in this environment: build the '
                          'workspace and source its install/setup.bash') from None
    if not path.is_file():
        raise DemoFailure(f'{path} does not exist: build the package {package} again')
    return path


@contextmanager
def signals_held():
    """Let SIGINT and SIGTERM wait until the end of the block."""
    received = []
    before = {number: signal.signal(number, lambda number, _: received.append(number))
              for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if received:
            signal.raise_signal(received[0])


def _end_with_parent(parent):
    """Ask the kernel for a SIGTERM when who started this process is killed."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)  # one that comes before the program begins counts
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != parent:
        os._exit(1)  # it was killed before the kernel was asked


class ChildProcess:
    """
    A child in a session of its own, with a log file, ended by its id, or by its parent's death.

    ``started`` holds all children of this process: a signal may come before anybody else knows of
    one.

    """

    started = []

    def __init__(self, name, command, log):
        self.name = name
        self._log = Path(log)
        ask = functools.partial(_end_with_parent, os.getpid())  # takes no lock a thread may hold
        with open(self._log, 'wb') as output, signals_held():
            self._process = subprocess.Popen(
                [str(part) for part in command], stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=ask)  # noqa: PLW1509
            self.started.append(self)

    def check(self):
        """Raise DemoFailure when the process has ended."""
        code = self._process.poll()
        if code is not None:
            lines = self._log.read_text(errors='replace').splitlines()[-LAST_LINES:]
            raise DemoFailure('\n  '.join([f'{self.name} ended with exit code {code}; the end of '
                                           f'{self._log}:', *lines]))

    def end(self):
        """End the process, gently first; return its exit code."""
        for number, patience in ENDING:
            if self._process.poll() is None:
                self._process.send_signal(number)
                try:
                    self._process.wait(patience)
                except subprocess.TimeoutExpired:
                    continue
        return self._process.returncode

    def kill(self):
        """Kill the process, as a crash does."""
        self._process.kill()
        self._process.wait()

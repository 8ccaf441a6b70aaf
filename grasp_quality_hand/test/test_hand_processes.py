# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the demo's child processes and their ROS domain."""

from contextlib import suppress
import os
from pathlib import Path
import signal
import subprocess
import sys
import time

from grasp_quality_hand import demo_processes
from grasp_quality_hand.demo_processes import ChildProcess, claim_domain, DemoFailure
import pytest

DEADLINE_S = 120.0
KILLED_MEANWHILE = """
import os, signal, sys, threading, time
from grasp_quality_hand import demo_processes
ask = demo_processes._end_with_parent

def ask_slowly(parent):
    if sys.argv[1] == 'before':
        time.sleep(2.0)
    ask(parent)
    if sys.argv[1] == 'after':
        time.sleep(2.0)

demo_processes._end_with_parent = ask_slowly
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGKILL)).start()
demo_processes.ChildProcess('child', ['touch', sys.argv[2]], sys.argv[3])
"""  # the child cannot begin until it has asked the kernel to end it, or 2 s later
SLEEP = 'import time; print("ready", flush=True); time.sleep(60)'
HEED = 'import signal; signal.signal(signal.SIGINT, signal.default_int_handler); '


@pytest.fixture
def environment(monkeypatch):
    """Put the environment back afterwards."""
    for name in demo_processes.discovery_environment(0):
        monkeypatch.setenv(name, '0')


@pytest.fixture
def child(tmp_path):
    """Return a function that starts Python code and waits until it has printed something."""
    children = []

    def start(code):
        log = tmp_path / 'log'
        children.append(ChildProcess('the sleeper', [sys.executable, '-c', code], log))
        end = time.monotonic() + DEADLINE_S
        while not log.read_text():
            assert time.monotonic() < end, f'nothing was printed within {DEADLINE_S} s'
            time.sleep(0.01)
        return children[-1]

    yield start
    for each in children:
        each.end()


def test_no_two_runs_share_a_domain(environment):
    claims, domains = [], []
    for _ in range(3):
        claims.append(claim_domain())
        domains.append(os.environ['ROS_DOMAIN_ID'])
    for claim in claims:
        claim.close()
    assert len(set(domains)) == len(claims)


def test_when_no_domain_is_free_it_says_so(environment, monkeypatch):
    monkeypatch.setattr(demo_processes, 'DOMAINS', range(100, 101))
    claim = claim_domain()
    with pytest.raises(DemoFailure, match='no free ROS domain'):
        claim_domain()
    claim.close()


def test_a_child_is_ended_gently(child):
    assert child(HEED + SLEEP).end() == -signal.SIGINT


def test_a_stubborn_child_is_ended_too(child, monkeypatch):
    monkeypatch.setattr(demo_processes, 'ENDING', tuple(
        (number, 0.2) for number, _ in demo_processes.ENDING[:2]) + demo_processes.ENDING[2:])
    ignore = ('import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); '
              'signal.signal(signal.SIGTERM, signal.SIG_IGN); ')
    assert child(ignore + SLEEP).end() == -signal.SIGKILL


def check_for_long(child):
    end = time.monotonic() + DEADLINE_S
    while time.monotonic() < end:
        child.check()
        time.sleep(0.01)


def test_a_child_that_ended_is_reported_with_its_last_words(child):
    dead = child('import sys; print("the reason", flush=True); sys.exit(3)')
    with pytest.raises(DemoFailure, match='exit code') as failure:
        check_for_long(dead)  # it ends by itself: a signal would have words too
    assert 'the reason' in str(failure.value)


def test_a_missing_package_is_named():
    with pytest.raises(DemoFailure, match='no_such_package'):
        demo_processes.executable('no_such_package', 'program')


@pytest.mark.parametrize('when', ['before', 'after'])
def test_a_child_does_not_begin_when_its_parent_is_killed_as_it_is_born(tmp_path, when):
    """By then the handlers of the parent are its own: what they take is lost in the program."""
    begun, mark = tmp_path / 'begun', f'BORN={tmp_path}'
    parent = subprocess.run(
        [sys.executable, '-c', KILLED_MEANWHILE, when, begun, tmp_path / 'log'], check=False,
        stdout=subprocess.DEVNULL, env={**os.environ, 'BORN': str(tmp_path)})
    assert parent.returncode == -signal.SIGKILL
    deadline = time.monotonic() + DEADLINE_S
    while is_alive(mark):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert not begun.exists()


def is_alive(mark):
    """Tell whether a process has this in its environment."""
    for path in Path('/proc').glob('[0-9]*/environ'):
        with suppress(OSError):  # not ours to read, or gone
            if mark.encode() in path.read_bytes().split(b'\0'):
                return True
    return False

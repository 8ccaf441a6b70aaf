# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The demo as its user runs it: it shows all it has to, and leaves no process behind."""

from contextlib import contextmanager
import json
import os
from pathlib import Path
import signal
import subprocess
import time
import urllib.request
import uuid

from grasp_quality_cli.main import main
from grasp_quality_hand.demo_processes import executable
import pytest
from transports import FILE

pytestmark = pytest.mark.alone
DEADLINE = 300.0             # for a run with one object, however busy the machine [s]
PNG = b'\x89PNG\r\n\x1a\n'


class DemoRun:
    """A run of the demo whose processes can be told from all others by a mark."""

    def __init__(self, output, *flags):
        self.output = output
        self._mark = f'DEMO_MARK={uuid.uuid4()}'
        self._said = ''
        name, value = self._mark.split('=')
        command = [executable('grasp_quality_hand', 'demo'), '--output', output, *flags]
        environment = {**os.environ, name: value}
        environment.pop(FILE, None)  # the demo has its own way to keep to this machine
        self.process = subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def processes(self):
        """Return the ids of all processes of this run."""
        found = []
        for path in Path('/proc').glob('[0-9]*/environ'):
            try:
                environment = path.read_bytes()
            except OSError:
                continue    # not ours to read, or gone
            if self._mark.encode() in environment.split(b'\0'):
                found.append(int(path.parent.name))
        return found

    def wait_for_line(self, text):
        """Read what the demo prints until a line holds the text; return that line."""
        for line in self.process.stdout:
            self._said += line
            if text in line:
                return line
        raise AssertionError(f'the demo ended without saying {text!r}; it said:\n{self._said}')

    def end(self):
        """Return exit code and output, once the demo has ended."""
        output, _ = self.process.communicate(timeout=DEADLINE)
        return self.process.returncode, self._said + output


def until(condition):
    """Wait for a condition."""
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


@contextmanager
def demos(folder):
    """Give a function that starts the demo; whatever is left at the end is killed."""
    runs = []

    def start(*flags):
        runs.append(DemoRun(folder / 'demo', *flags))
        return runs[-1]

    yield start
    for run in runs:
        for process in run.processes():
            os.kill(process, signal.SIGKILL)


@pytest.fixture
def demo(tmp_path):
    with demos(tmp_path) as start:
        yield start


@pytest.fixture(scope='module')
def ended(tmp_path_factory):
    """Return (run, exit code, output) of a demo that was kept until its page was there."""
    with demos(tmp_path_factory.mktemp('ended')) as start:
        run = start('--keep', '--objects', 'cube')
        line = run.wait_for_line('The live grasp is at')
        with urllib.request.urlopen(line.split()[-1], timeout=60.0) as page:
            assert page.status == 200 and b'<html' in page.read(10_000).lower()
        assert len(run.processes()) == 4
        run.process.send_signal(signal.SIGINT)
        yield run, *run.end()


def test_demo_prints_and_draws_and_leaves_nothing_behind(ended):
    run, code, output = ended
    assert code == 0 and 'Traceback' not in output, output
    for heading in ('Measured contacts', 'Task wrench', 'Task cone', 'Task polytope',
                    'Contact forces', 'Force map', 'held / predicted'):
        assert heading in output
    for picture in ('cube_grasp.png', 'cube_force_map.png'):
        assert (run.output / picture).read_bytes().startswith(PNG)
    if 'No animation' in output:  # as on a machine too busy for any pull
        assert output.count('not pulled') == output.count('the machine was busy') == 3
    else:
        assert (run.output / 'cube_pull.gif').read_bytes().startswith(b'GIF89a')
    assert run.processes() == []


def test_the_bag_that_the_demo_records_can_be_evaluated(ended, tmp_path, capsys):
    run, code, output = ended
    assert code == 0 and 'Recorded: ' in output, output
    code = main(['bag', str(run.output / 'bag'), '--params', str(run.output / 'parameters.yaml'),
                 '--task', '0 0 1 0 0 0', '-o', str(tmp_path / 'results'), '--json'])
    row = json.loads(capsys.readouterr().out)
    assert code == 0 and row['damage'] == []
    assert row['codes']['OPTIMAL'] > 50 and row['alpha_max'] > 1.0
    assert row['measured_slip_margin_min'] is not None


@pytest.mark.parametrize('number, codes', [
    (signal.SIGINT, (0, 130)), (signal.SIGKILL, (-signal.SIGKILL,))])
def test_no_end_of_the_demo_leaves_anything_behind(demo, number, codes):
    run = demo('--keep')
    run.wait_for_line('starting')
    until(lambda: len(run.processes()) == 4)  # demo, hand, node, recorder
    run.process.send_signal(number)
    code, output = run.end()
    assert code in codes and 'Traceback' not in output
    if number == signal.SIGKILL:  # nobody is left to wait for the others
        until(lambda: not run.processes())
    assert run.processes() == []

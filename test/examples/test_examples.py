# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The examples, run as a user would run them."""

from pathlib import Path
import re
import sys

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, pose_array, wrench
from harness import BEST_EFFORT, Process
import pytest

EXAMPLES = Path(__file__).parents[2] / 'examples'


@pytest.fixture(scope='module')
def node(start):
    return start(max_contact_age='0.5', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]')


@pytest.fixture
def run(tmp_path):
    """Return a function that starts an example in a namespace; all are ended behind the test."""
    begun = []

    def begin(name, namespace, *arguments):
        begun.append(Process(
            [sys.executable, EXAMPLES / name, '--ros-args', '-r', f'__ns:={namespace}',
             *arguments], tmp_path / f'{len(begun)}.txt'))
        return begun[-1]

    yield begin
    for process in begun:
        if process.popen.poll() is None:
            process.end()


def test_evaluate_grasp_prints_the_answer(node, run):
    """Two fingers with mu = 0.5 and caps of 10 N hold five times 2 N."""
    process = run('evaluate_grasp.py', node.namespace)
    assert process.wait() == 0, process.log()
    first, left, right = process.log().splitlines()
    assert first.startswith('alpha = 5.0000 times the weight')
    assert left.startswith('left: +10.000') and '+5.000 N' in left and '100 %' in left
    assert right.startswith('right: -10.000') and '+5.000 N' in right


def test_ask_everything_prints_what_can_be_worked_out_by_hand(node, run):
    """
    Friction 0.5 and caps of 10 N: 10 N along any surface, and 2 of them carry the weight.

    A force r at an angle t to the normals needs 10 N of one finger and 10 N - r cos t of the
    other; without torque each takes half of r sin t, so that r (sin t + cos t) <= 10 N, and the
    least r is 10 N / sqrt(2). The weight of 2 N leaves 8 N of these.
    """
    process = run('ask_everything.py', node.namespace)
    assert process.wait() == 0, process.log()
    lift, hold, cone, sides, remaining, ball, noisy, *text = process.log().splitlines()
    assert lift.startswith('lift: 5.0000 times')
    assert hold.endswith('take 0.2000 of the caps')
    best, straight, worst = numbers_of(cone)[1:]
    assert straight == 5.0 and worst <= straight <= best
    assert sides.startswith('lift, or 1 N to a side: 5.00, 10.00, 10.00, 10.00, 10.00; together')
    least, most = numbers_of(remaining)[:2]
    assert 8.0 / 2 ** 0.5 - 1e-4 < least < 6.0 and 11.9 < most <= 12.0  # upward it helps
    lower, upper = numbers_of(ball)
    assert lower <= 10.0 / 2 ** 0.5 + 1e-4 and 10.0 / 2 ** 0.5 - 1e-4 <= upper <= 1.0102 * lower
    # alpha is 10 min(mu_1, mu_2): 5 % of the lesser of two lie 1.954 deviations below the mean
    assert numbers_of(noisy)[1] == pytest.approx(10.0 * (0.5 - 1.954 * 0.05), abs=0.12)
    assert any('left' in line for line in text)


def numbers_of(line):
    """Return the numbers in a line."""
    return [float(number) for number in re.findall(r'\d+(?:\.\d+)?', line)]


def test_python_only_needs_no_node(run):
    """The same pinch; 2 N need at least 2 N of pressing, and 10 N are the most."""
    process = run('python_only.py', '/nobody')
    assert process.wait() == 0, process.log()
    first, *pressed, text = process.log().splitlines()
    assert first.startswith('alpha = 5.0000 times the weight')
    normals = [float(line.split(' N,')[0].split()[-1]) for line in pressed]
    assert len(normals) == 2 and normals[0] == normals[1] and 2.0 < normals[0] < 10.0
    assert text.startswith('The grasp applies 5 times the task')


def test_evaluate_grasp_says_why_there_is_no_answer(start, run):
    process = run('evaluate_grasp.py', start(autostart='false').namespace)
    assert process.wait() == 1
    assert process.log().startswith('no answer: the node is not active')


def test_follow_forces_is_safe_unless_the_forces_hold(node, run):
    client = node.client
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    process = run('follow_forces.py', node.namespace, '-p', 'max_age:=0.5')

    def feed():
        publisher.publish(pose_array(ANTIPODAL, client.now()))

    seen = 0

    def told(words, feed):
        nonlocal seen
        client.until(lambda: words in process.log()[seen:], words, feed)
        seen += process.log()[seen:].index(words) + len(words)

    told('safe: ', None)
    told('follow: contact_0, contact_1', feed)
    told('safe: ', None)
    told('follow: ', feed)
    client.call(srv.SetTask, 'set_task', feed, kind=1, task_wrench=wrench(fy=1.0),
                external_wrench=wrench(fz=-11.0))
    told('safe: ', feed)
    client.call(srv.SetTask, 'set_task', feed, kind=1, task_wrench=wrench(fy=1.0))
    told('follow: ', feed)
    client.call(srv.SetTask, 'set_task', feed, kind=1, task_wrench=wrench(fy=1.0),
                external_wrench=wrench(fy=11.5))  # alpha has an answer, above 1; holding has none
    told('safe: there are no holding forces', feed)
    answer = client.call(srv.SetTask, 'set_task', feed, kind=1, task_wrench=wrench(fy=1.0))
    assert answer.result.code == ResultCode.OPTIMAL
    told('follow: ', feed)
    assert process.end() == 0, process.log()


def test_follow_forces_is_safe_when_the_node_is_gone(start, run):
    node = start(max_contact_age='5.0', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]')
    client = node.client
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    process = run('follow_forces.py', node.namespace, '-p', 'max_age:=0.5')
    client.until(lambda: 'follow: ' in process.log(), 'following', lambda: publisher.publish(
        pose_array(ANTIPODAL, client.now())))
    seen = len(process.log())
    node.process.popen.kill()
    node.process.popen.wait()
    client.until(lambda: 'safe: the contacts are' in process.log()[seen:], 'safety')

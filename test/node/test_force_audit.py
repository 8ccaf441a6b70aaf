# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The auditor beside a true node, and beside one that replays old forces or alters new ones."""

import copy
import time

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs.msg import ContactForceArray, GraspQuality
from grasps import CIRCLE, pose_array
from harness import BEST_EFFORT, claim_domain, DEADLINE_S, start_audit
from outputs import Outputs
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor

PARAMETERS = {
    'contact_model': 'PCWF', 'friction_coefficient': 0.5, 'torsional_friction_coefficient': 0.005,
    'max_normal_force': 10.0, 'force_bound': 'linf', 'contact_names': ['a', 'b', 'c'],
    'contact_fingers': ['a', 'b', 'c'], 'max_contact_age': 1.0}


class Impostor:
    """A node on the topics and with the parameters of a quality node, saying what it is given."""

    def __init__(self, namespace, **parameters):
        self._context = Context()
        rclpy.init(context=self._context, domain_id=claim_domain()[0])
        self.node = rclpy.create_node('grasp_quality', namespace=namespace, context=self._context)
        for name, value in {**PARAMETERS, **parameters}.items():
            self.node.declare_parameter(name, value)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._publishers = [
            self.node.create_publisher(PoseArray, '~/contact_poses', BEST_EFFORT),
            self.node.create_publisher(GraspQuality, '~/quality', 1),
            self.node.create_publisher(ContactForceArray, '~/contact_forces', 1)]

    def say(self, parts):
        """Publish (poses, quality, forces) and answer who asks for parameters."""
        for publisher, message in zip(self._publishers, parts):
            publisher.publish(message)
        self._executor.spin_once(timeout_sec=0.01)

    def say_until_found(self, audit, parts):
        """Publish what a function returns, again and again, until the auditor objects."""
        deadline = time.monotonic() + DEADLINE_S
        while 'VIOLATION' not in audit.log():
            assert time.monotonic() < deadline and audit.popen.poll() is None, audit.log()
            self.say(parts())

    def close(self):
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)


@pytest.fixture(scope='module')
def truth(start):
    """One true answer: poses, quality and forces."""
    client = start(
        contact_names='[a, b, c]', task_wrench='[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]').client
    poses = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    found = Outputs(client).answer(
        lambda: poses.publish(pose_array(CIRCLE, client.now())), names=['a', 'b', 'c'])
    return pose_array(CIRCLE, found.quality.header.stamp), found.quality, found.forces


@pytest.fixture
def impostor():
    node = Impostor('/impostor')
    yield node
    node.close()


@pytest.fixture
def audit(tmp_path):
    process = start_audit(tmp_path / 'audit.txt', '/impostor')
    process.until_it_says('listening')
    yield process
    if process.popen.poll() is None:
        process.end()


def stamped(parts, node):
    """Return copies of messages that bear the present time."""
    copies, stamp = copy.deepcopy(parts), node.get_clock().now().to_msg()
    for message in copies:
        message.header.stamp = stamp
    return copies


def say_until_judged(impostor, audit, parts, most):
    """Publish messages at the present time until more force sets than that are judged."""
    reports, times = [], 0
    impostor.node.create_subscription(DiagnosticArray, '/diagnostics', reports.append, 10)
    deadline = time.monotonic() + DEADLINE_S
    while not any(int('0' + status.message.split()[0].strip('no')) > most for report in reports
                  for status in report.status if status.hardware_id == '/impostor/grasp_quality'):
        assert time.monotonic() < deadline, audit.log()
        impostor.say(stamped(parts, impostor.node))
        times += 1
    return times


def test_true_forces_pass_whoever_says_them(truth, impostor, audit):
    """They are judged as soon as the auditor knows the parameters: its report tells."""
    say_until_judged(impostor, audit, truth, 0)
    assert audit.end() == 0, audit.log()


def test_true_forces_pass_of_a_node_that_was_started_anew_with_other_parameters(
        truth, impostor, audit):
    """The one before it was asked for its parameters, and does not answer any more."""
    said = say_until_judged(impostor, audit, truth, 0)
    time.sleep(1.0)  # it is asked once a fifth of a second
    renamed = copy.deepcopy(truth)
    for force in renamed[2].forces:
        force.name = 'new_' + force.name
    other = Impostor('/impostor', contact_names=['new_a', 'new_b', 'new_c'])
    try:
        say_until_judged(other, audit, renamed, said)
    finally:
        other.close()
    assert audit.end() == 0, audit.log()


def test_a_wrench_on_the_topic_of_another_contact_is_found(truth, impostor, audit):
    wrench = impostor.node.create_publisher(WrenchStamped, '~/optimal_wrenches/a', 1)

    def crossed():
        parts = stamped(truth, impostor.node)
        message = WrenchStamped(header=copy.deepcopy(parts[0].header))
        message.header.frame_id = 'b'
        wrench.publish(message)
        return parts
    impostor.say_until_found(audit, crossed)
    assert audit.end() == 1
    assert 'optimal_wrenches/a' in audit.log() and "in the frame 'b'" in audit.log()


def test_an_altered_force_is_found(truth, impostor, audit):
    def altered():
        parts = stamped(truth, impostor.node)
        parts[2].forces[1].wrench.force.z *= 1.001
        return parts
    impostor.say_until_found(audit, altered)
    assert audit.end() == 1
    assert 'outside its friction cone' in audit.log() or 'are missing' in audit.log()


def test_old_forces_said_again_are_found(truth, impostor, audit):
    impostor.say_until_found(audit, lambda: truth)
    assert audit.end() == 1
    assert 'after their contacts' in audit.log()


def test_forces_beside_a_failure_are_found(truth, impostor, audit):
    def contradicting():
        parts = stamped(truth, impostor.node)
        parts[1].result.code = -5
        return parts
    impostor.say_until_found(audit, contradicting)
    assert audit.end() == 1
    assert 'not OPTIMAL' in audit.log()


def test_to_have_judged_nothing_is_no_pass(impostor, audit):
    assert audit.end() == 2
    assert 'no force sets judged' in audit.log() and '/impostor/grasp_quality' in audit.log()


def test_forces_of_no_contacts_are_no_pass_when_they_pull(truth, impostor, audit):
    """With a stamp that nothing was sensed at; the true ones go on."""
    def rogue():
        parts = stamped(truth, impostor.node)
        impostor.say(parts)
        forces = copy.deepcopy(parts[2])
        forces.header.stamp.nanosec ^= 1
        for force in forces.forces:
            force.wrench.force.x *= -1e9
            force.wrench.force.y *= -1e9
        return (*parts[:2], forces)
    impostor.say_until_found(audit, rogue)
    assert audit.end() == 1
    assert 'judged without contacts' in audit.log() and 'it pulls' in audit.log()


def test_names_without_end_are_told_once_and_end_nothing(truth, impostor, audit):
    def renamed():
        parts = stamped(truth, impostor.node)
        for force in parts[2].forces:
            force.name = f'{force.name}_{parts[2].header.stamp.nanosec}'
        return parts
    deadline = time.monotonic() + DEADLINE_S
    while 'contact names' not in audit.log():
        assert time.monotonic() < deadline and audit.popen.poll() is None, audit.log()
        impostor.say(renamed())
    for _ in range(100):
        impostor.say(renamed())
    listened = [topic for topic, _ in impostor.node.get_topic_names_and_types()
                if topic.startswith('/impostor/grasp_quality/optimal_wrenches/')]
    assert audit.end() == 1
    assert len(listened) <= 256 and audit.log().count('more than 256 contact names') == 1


def test_a_second_publisher_of_forces_is_told(truth, impostor, audit):
    other = Impostor('/impostor')
    try:
        deadline = time.monotonic() + DEADLINE_S
        reports = []
        impostor.node.create_subscription(DiagnosticArray, '/diagnostics', reports.append, 10)
        while not any('2 publishers' in status.message and status.level != status.OK
                      for report in reports for status in report.status):
            assert time.monotonic() < deadline, audit.log()
            impostor.say(stamped(truth, impostor.node))
    finally:
        other.close()
    audit.end()
    assert '2 publishers of contact_forces at one time' in audit.log()

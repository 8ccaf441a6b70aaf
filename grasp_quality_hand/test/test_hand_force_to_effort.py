# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""force_to_effort as a black box, behind a real quality node that gets killed."""

import math
import signal
import subprocess

from bridge_rig import DEADLINE, EXACT, FOLLOWED, Rig, START
from grasp_quality_hand.demo_processes import executable
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
import numpy as np
import pytest
from std_msgs.msg import Header

pytestmark = pytest.mark.alone  # it lets go of what is older than 0.1 s
HELD = [-0.25, 0.15]    # right, left [N m]


@pytest.fixture(scope='module')
def rig(domain, tmp_path_factory):
    """Return a rig with a quality node and a bridge that follows it."""
    rig = Rig(tmp_path_factory.mktemp('bridge'), domain)
    rig.start_quality()
    with rig.bridging('-p', f'holding_efforts:={HELD}'):
        yield rig


def test_forces_become_efforts_in_the_order_of_the_joints(rig):
    rig.until_commanded(FOLLOWED)
    told = rig.until_told('following the contact forces')
    assert told.level == b'\x00'
    values = {item.key: item.value for item in told.values}
    assert values['phase'] == 'FOLLOWING' and float(values['scale of the forces']) == 1.0


def test_a_killed_force_publisher_is_survived_and_comes_back(rig):
    """Kill -9: the efforts go to the holding ones, and follow again once it is back."""
    rig.until_commanded(FOLLOWED)
    rig.processes['grasp_quality_node'].kill()
    rig.until_commanded(HELD)
    told = rig.until_told('at the holding efforts')
    assert told.level == b'\x01' and 'contact forces are older' in told.message
    rig.start_quality()
    rig.until_commanded(FOLLOWED, deadline=START)


def test_a_node_that_fails_sends_empty_forces_and_the_hand_holds(rig):
    """No contacts any more: the quality node says so, and joint states go on."""
    rig.until_commanded(FOLLOWED)
    feed = rig.feed

    def feed_without_contacts():
        contacts, rig.contacts = rig.contacts, type('Nobody', (), {'publish': lambda *_: None})()
        feed()
        rig.contacts = contacts

    rig.feed = feed_without_contacts
    rig.until_told('are empty')
    rig.until_commanded(HELD)
    rig.feed = feed
    rig.until_commanded(FOLLOWED)


def test_silence_of_the_joints_is_told_as_an_error(rig):
    rig.until_commanded(FOLLOWED)
    rig.status.clear()
    rig.until(lambda: any(s.level == b'\x02' for s in rig.status), feeding=False)
    rig.until_commanded(HELD, feeding=False)
    rig.until_commanded(FOLLOWED)


@pytest.mark.parametrize('spoil, words', [
    (lambda forces: setattr(forces[0].wrench.force, 'x', math.nan), 'bad contact forces'),
    (lambda forces: setattr(forces[0].position, 'y', math.inf), 'bad contact forces'),
    (lambda forces: setattr(forces[1], 'name', 'thumb'), "contacts ['thumb'] have no link")])
def test_forces_that_are_no_use_make_it_hold(rig, spoil, words):
    """Someone else publishes among good forces: those are followed again afterwards."""
    publisher = rig.node.create_publisher(
        ContactForceArray, '/grasp_quality/holding_forces', 1)
    rig.until(publisher.get_subscription_count)

    def publish():
        message = ContactForceArray(header=Header(
            stamp=rig.node.get_clock().now().to_msg(), frame_id='object'))
        message.forces = [ContactForce(name='left'), ContactForce(name='right')]
        spoil(message.forces)
        publisher.publish(message)

    def told():
        publish()
        return next((s for s in rig.status if words in s.message), None)

    rig.status.clear()
    rig.until(told)
    rig.check()
    rig.node.destroy_publisher(publisher)
    rig.until_commanded(FOLLOWED)


def test_joint_states_that_are_no_numbers_are_not_there(rig):
    rig.until_commanded(FOLLOWED)
    rig.positions = [math.nan, 0.0]
    told = rig.until_told('at the holding efforts')
    assert 'joint states are older' in told.message
    rig.positions = [0.0, 0.0]
    rig.until_commanded(FOLLOWED)


def test_the_last_command_before_the_end_is_the_holding_one(rig):
    rig.until_commanded(FOLLOWED)
    process = rig.processes['force_to_effort']
    process.send_signal(signal.SIGTERM)
    rig.until(lambda: process.poll() is not None)
    assert process.returncode == 0
    rig.until(lambda: list(rig.commands[-1].data) == pytest.approx(HELD, abs=EXACT))
    rig.check()


def test_it_begins_again_where_the_hand_is(rig):
    """Silent until it has good forces, and then no jump from the efforts that are measured."""
    rig.commands.clear()
    rig.start_bridge('-p', 'max_effort_rate:=1.0')
    rig.until(lambda: rig.commands, deadline=START)
    assert np.abs(rig.commands[0].data).max() <= 0.06  # of 0.2, from zero
    rig.until_commanded(FOLLOWED)


@pytest.mark.parametrize('parameters, words', [
    ([], 'contact_names must be unique and contact_links'),
    (['contact_names:=[a]', 'contact_links:=[b]', 'joints:=[c]'], 'give the URDF of the hand'),
    (['contact_names:=[a]', 'contact_links:=[b]', 'joints:=[c]',
      'robot_description_file:=/nowhere'], "'/nowhere' cannot be read"),
    (['contact_names:=[a]', 'contact_links:=[b]', 'joints:=[c]', 'robot_description:=<robot/>'],
     'robot_description is no URDF'),
    (['rate:=0.0'], 'rate')])
def test_what_is_wrong_with_parameters_is_said_in_one_line(domain, parameters, words):
    command = [str(executable('grasp_quality_hand', 'force_to_effort')), '--ros-args']
    for parameter in parameters:
        command += ['-p', parameter]
    done = subprocess.run(command, timeout=DEADLINE, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 1
    assert words in done.stderr and 'Traceback' not in done.stderr

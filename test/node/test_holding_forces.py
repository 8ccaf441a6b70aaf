# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Live forces to hold with: they balance the load alone, with margin, or are empty."""

from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs.msg import ContactForceArray, ResultCode
from grasps import ANTIPODAL, check_forces, pose_array, SINGLE, SOLVER, total_wrench, wrench
from harness import BEST_EFFORT
from msg_adapters.stamps import stamp_ns
from outputs import Outputs
import pytest


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='2.0', task_wrench='[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]').client


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client)


@pytest.fixture(scope='module')
def heard(client):
    return client.listen(ContactForceArray, 'holding_forces')


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of contacts."""
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda poses=ANTIPODAL: lambda: publisher.publish(pose_array(poses, client.now()))


def load(client, **forces):
    client.publisher(WrenchStamped, 'external_wrench').publish(
        WrenchStamped(wrench=wrench(**forces)))


def test_they_balance_the_load_and_not_the_task(client, outputs, heard, feed):
    load(client, fz=-3.0)
    held = client.fresh(heard, lambda m: m.forces and abs(
        total_wrench(m)[2] - 3.0) <= SOLVER, 'forces that hold 3 N', feed())
    assert total_wrench(held) == pytest.approx([0, 0, 3.0, 0, 0, 0], abs=SOLVER)
    check_forces(held)
    assert all(item.cone_usage < 0.9 for item in held.forces)
    found = outputs.answer(feed())
    assert total_wrench(found.forces)[1] == pytest.approx(found.quality.alpha, rel=SOLVER)


def test_they_carry_the_stamp_of_their_contacts(client, outputs, heard, feed):
    begin = stamp_ns(client.now())
    held = client.fresh(heard, lambda m: stamp_ns(m.header.stamp) >= begin, 'forces', feed())
    assert held.header.frame_id == 'object' and len(held.forces) == 2


def test_a_load_that_cannot_be_held_has_none(client, outputs, heard, feed):
    """The task has an answer all the same: 1.5 N too much are pulled along it."""
    load(client, fy=11.5)
    client.fresh(heard, lambda m: not m.forces, 'empty forces', feed())
    assert outputs.answer(feed(), lambda q: q.alpha > 10.0).quality.alpha_lower > 1.0
    load(client, fy=0.0)
    client.fresh(heard, lambda m: m.forces, 'forces again', feed())


def test_they_are_empty_when_the_node_has_no_answer(client, outputs, heard, feed):
    load(client, fy=-50.0)
    outputs.failure(ResultCode.INFEASIBLE, feed(SINGLE))
    client.fresh(heard, lambda m: not m.forces, 'empty forces', feed(SINGLE))
    load(client, fy=0.0)
    client.fresh(heard, lambda m: m.forces, 'forces again', feed())


def test_they_need_a_task_whichever_it_is(start):
    """Along y, and about the line through both contacts, which no force of theirs turns."""
    client = start(max_contact_age='2.0').client
    heard = client.listen(ContactForceArray, 'holding_forces')
    contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    tasks = client.publisher(WrenchStamped, 'task_wrench')

    def feed(task=None):
        load(client, fz=-3.0)
        if task is not None:
            tasks.publish(WrenchStamped(wrench=task))
        contacts.publish(pose_array(ANTIPODAL, client.now()))

    outputs = Outputs(client)
    outputs.failure(ResultCode.INVALID_REQUEST, feed)
    client.fresh(heard, lambda m: not m.forces, 'empty forces', feed)
    for task in (wrench(fy=1.0), wrench(tx=1.0)):
        outputs.answer(lambda task=task: feed(task),
                       lambda quality, task=task: quality.task_wrench == task)
        held = client.fresh(
            heard, lambda m: m.forces and abs(total_wrench(m)[2] - 3.0) <= SOLVER,
            'forces that hold 3 N', lambda task=task: feed(task))
        assert total_wrench(held) == pytest.approx([0, 0, 3.0, 0, 0, 0], abs=SOLVER)
        check_forces(held)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that faults are put on; one of them is shared by all tests that leave it as it was."""

from pathlib import Path
import signal
import sys

sys.path.insert(0, str(Path(__file__).parents[1] / 'node'))

from node_fixtures import begun_nodes, ros_log_dir, start  # noqa: E402, F401
import pytest  # noqa: E402


def pytest_collection_modifyitems(items):
    """Keep other tests from running beside these; the soak may, and comes first: it is long."""
    def is_soak(item):
        return item.path.name == 'test_soak.py'

    for item in items:
        if item.path.parent == Path(__file__).parent and not (
                is_soak(item) or item.get_closest_marker('robot')):
            item.add_marker(pytest.mark.alone)
    items.sort(key=is_soak, reverse=True)


@pytest.fixture(scope='session')
def hand(tmp_path_factory, ros_log_dir):  # noqa: F811
    """Return a node with its client, its auditor and all that it says."""
    from outputs import Outputs
    from rig import MAX_AGE_S, Record, TASK

    with begun_nodes(tmp_path_factory) as begin:
        node = begin(max_contact_age=MAX_AGE_S, task_wrench=TASK)
        node.outputs = Outputs(node.client)
        node.record = Record(node.client)
        yield node


@pytest.fixture
def poses(hand):
    """Return a function that makes a feed of some poses, stamped with the present time."""
    from geometry_msgs.msg import PoseArray
    from grasps import pose_array
    from harness import BEST_EFFORT

    publisher = hand.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    hand.record.forget()
    return lambda some: lambda: publisher.publish(pose_array(some, hand.client.now()))


@pytest.fixture
def feeds(hand, tmp_path):
    """Start publishers of contacts for the shared node; those left are ended."""
    from rig import start_feed

    begun = []

    def begin(*options):
        begun.append(start_feed(tmp_path / f'feed_{len(begun)}.txt', hand.namespace, *options))
        return begun[-1]

    hand.record.forget()
    yield begin
    running = [feed for feed in begun if feed.popen.poll() is None]
    for feed in running:
        feed.popen.send_signal(signal.SIGINT)
    for feed in running:
        assert feed.wait() == 0, feed.log()

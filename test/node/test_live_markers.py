# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""~/markers and ~/force_map: what is on the screen is the newest answer, or nothing."""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ForceMap, GraspQuality, ResultCode
from grasps import ANTIPODAL, CIRCLE, pose_array, SOLVER, wrench
from harness import BEST_EFFORT
from msg_adapters.force_map import alphas_of
import numpy as np
import pytest
from visualization_msgs.msg import Marker, MarkerArray

RESOLUTION = 6
FORCE_SCALE = 0.02  # [m/N]


@pytest.fixture(scope='module')
def node(start):
    return start(max_contact_age='1.0', task_wrench='[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]',
                 map_directions=str(2 * RESOLUTION ** 2), marker_force_scale=str(FORCE_SCALE))


@pytest.fixture(scope='module')
def client(node):
    return node.client


@pytest.fixture(scope='module')
def feed(client):
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda poses: lambda: publisher.publish(pose_array(poses, client.now()))


@pytest.fixture(scope='module')
def markers(client, feed):
    return client.listen(MarkerArray, 'markers', feed(CIRCLE))


@pytest.fixture(scope='module')
def maps(client, feed):
    return client.listen(ForceMap, 'force_map', feed(CIRCLE))


def added(message, namespace):
    return [m for m in message.markers if m.ns == namespace and m.action == Marker.ADD]


def drawn(count):
    """Match arrays with so many contacts."""
    return lambda message: len(added(message, 'friction_cones')) == count


def clears(message):
    return message.markers[0].action == Marker.DELETEALL


def test_forces_are_drawn_to_the_scale_of_the_parameter(client, feed, markers):
    message = client.fresh(markers, drawn(3), 'three cones', feed(CIRCLE))
    assert len(added(message, 'optimal_forces')) == 3
    tail, tip = added(message, 'task_force')[0].points
    assert tip.z - tail.z == pytest.approx(FORCE_SCALE * 15.0, rel=SOLVER)
    assert message.markers[-1].header.frame_id == 'object'


def test_the_map_is_that_of_the_service(client, feed, maps, markers):
    message = client.fresh(maps, lambda m: len(m.alphas), 'a map', feed(CIRCLE))
    assert message.resolution == RESOLUTION
    answer = client.call(srv.WrenchMap, 'wrench_map', feed(CIRCLE))
    np.testing.assert_allclose(alphas_of(message), answer.alphas, rtol=SOLVER)
    surface = client.fresh(markers, lambda m: added(m, 'force_map'), 'a surface', feed(CIRCLE))
    top = max(point.z for point in added(surface, 'force_map')[0].points)
    assert top == pytest.approx(
        FORCE_SCALE * max(a * d.force.z for a, d in zip(answer.alphas, answer.directions)),
        rel=SOLVER)


def test_the_map_is_beside_the_load_of_the_task(client, feed, maps):
    client.call(srv.SetTask, 'set_task', feed(CIRCLE), kind=1, task_wrench=wrench(fz=1.0),
                external_wrench=wrench(fz=-6.0))
    loaded = client.call(srv.WrenchMap, 'wrench_map', feed(CIRCLE),
                         external_wrench=wrench(fz=-6.0)).alphas
    client.fresh(maps, lambda m: len(m.alphas) == len(loaded) and np.allclose(
        m.alphas, loaded, rtol=SOLVER), 'the map beside the load', feed(CIRCLE))
    client.call(srv.SetTask, 'set_task', feed(CIRCLE), kind=1, task_wrench=wrench(fz=1.0))


def test_another_set_of_contacts_begins_anew(client, feed, markers):
    client.fresh(markers, drawn(3), 'three cones', feed(CIRCLE))
    first = client.fresh(markers, drawn(2), 'two cones', feed(ANTIPODAL))
    assert clears(first)
    assert not clears(client.fresh(markers, drawn(2), 'two cones again', feed(ANTIPODAL)))


def test_silence_empties_the_screen(client, feed, markers, maps):
    client.fresh(markers, drawn(3), 'three cones', feed(CIRCLE))
    client.fresh(maps, lambda m: len(m.alphas), 'a map', feed(CIRCLE))
    last = client.fresh(markers, clears, 'an empty screen')
    assert len(last.markers) == 1
    assert client.until(lambda: maps[-1:] and not maps[-1].alphas, 'no map') is True
    before = len(markers)
    first = client.fresh(markers, lambda m: not clears(m) or len(m.markers) > 1, 'what comes next',
                         feed(CIRCLE))
    assert before and clears(first)


def test_a_load_beyond_the_grasp_empties_the_screen(client, feed, markers):
    client.fresh(markers, drawn(3), 'three cones', feed(CIRCLE))
    qualities = client.listen(GraspQuality, 'quality')
    markers.clear()  # the answer may come after the screen is empty, which is said once
    client.call(srv.SetTask, 'set_task', feed(CIRCLE), kind=1, task_wrench=wrench(fx=1.0),
                external_wrench=wrench(fz=-15.1))
    emptied = client.until(lambda: next(filter(clears, markers), None), 'an empty screen',
                           feed(CIRCLE))
    assert len(emptied.markers) == 1
    client.until(lambda: any(m.result.code == ResultCode.INFEASIBLE for m in qualities),
                 'INFEASIBLE', feed(CIRCLE))
    markers.clear()
    client.fresh(qualities, feed=feed(CIRCLE))
    assert not any(drawn(3)(message) for message in markers)
    client.call(srv.SetTask, 'set_task', feed(CIRCLE), kind=1, task_wrench=wrench(fz=1.0))


def test_a_node_that_ends_takes_its_picture_with_it(node, client, feed, markers):
    client.fresh(markers, drawn(3), 'three cones', feed(CIRCLE))
    assert node.process.end() == 0
    assert len(client.fresh(markers, clears, 'an empty screen').markers) == 1

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Markers say what the answer says, to scale, and leave nothing of another contact set."""

import dataclasses
import math

from adapter_messages import EXACT
from builtin_interfaces.msg import Duration
from grasp_quality import Contact, ContactModel, evaluate, Grasp, TaskWrench, wrench_map
from grasp_quality.directions import force_grid
from msg_adapters.markers import delete_all, grasp_markers, map_marker, Picture
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

SCALE = 0.003  # [m/N]
TASK = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.2])
HEADER = Header(frame_id='object')


def grasp(model=ContactModel.SFCE):
    return Grasp([
        Contact((x, 0.01, 0.0), normal=(-x / 0.03, 0.0, 0.0), model=model, friction=0.5,
                torsional_friction=0.01, max_normal_force=10.0, name=name)
        for x, name in ((-0.03, 'thumb'), (0.03, 'index'))])


def picture(measured=(None, None), model=ContactModel.SFCE):
    held = grasp(model)
    answer = evaluate(held, TaskWrench(TASK))
    return Picture(
        header=HEADER, grasp=held, optimal=answer.forces, cone_usage=answer.cone_usage,
        measured=measured, alpha=answer.alpha, task=TASK,
        limiting_contact=answer.limiting_contact, metres_per_newton=SCALE,
        lifetime=Duration(sec=1))


def by_namespace(message, namespace, action=Marker.ADD):
    return {m.id: m for m in message.markers if m.ns == namespace and m.action == action}


def ends(marker):
    return [np.array([p.x, p.y, p.z]) for p in marker.points]


def test_optimal_arrows_add_up_to_the_task_arrow():
    shown = picture()
    message = grasp_markers(shown, anew=False)
    arrows = [ends(m) for m in by_namespace(message, 'optimal_forces').values()]
    assert len(arrows) == 2
    for (tail, _), position in zip(arrows, shown.grasp.positions):
        np.testing.assert_allclose(tail, position, atol=EXACT)
    total = sum(tip - tail for tail, tip in arrows)
    tail, tip = ends(by_namespace(message, 'task_force')[0])
    np.testing.assert_allclose(total, tip - tail, atol=1e-9)
    np.testing.assert_allclose(tip - tail, SCALE * shown.alpha * TASK[:3], atol=EXACT)
    tail, tip = ends(by_namespace(message, 'task_torque')[0])
    np.testing.assert_allclose(
        tip - tail, SCALE * shown.alpha * TASK[3:] / shown.grasp.lever_arm, atol=EXACT)


def test_the_head_of_a_cone_has_its_tip_at_the_contact_and_the_angle_of_friction():
    shown = picture()
    cones = by_namespace(grasp_markers(shown, anew=False), 'friction_cones')
    for i, marker in cones.items():
        base, tip = ends(marker)
        np.testing.assert_allclose(tip, shown.grasp.positions[i], atol=EXACT)
        along = (base - tip) / np.linalg.norm(base - tip)
        np.testing.assert_allclose(along, shown.grasp.rotations[i][:, 2], atol=EXACT)
        assert marker.scale.z == pytest.approx(np.linalg.norm(base - tip))
        assert 0.5 * marker.scale.y / marker.scale.z == pytest.approx(0.5)


def test_a_contact_without_friction_has_a_cone_that_is_a_line():
    held = grasp(ContactModel.FPC)
    shown = dataclasses.replace(picture(), grasp=held)
    for marker in by_namespace(grasp_markers(shown, False), 'friction_cones').values():
        assert 0.0 < marker.scale.y < 0.01 * marker.scale.z


def test_measured_forces_are_drawn_where_there_are_any():
    felt = np.array([1.0, -2.0, 5.0, 0.1])
    shown = picture(measured=(None, felt))
    message = grasp_markers(shown, anew=False)
    arrows = by_namespace(message, 'measured_forces')
    assert list(arrows) == [1]
    tail, tip = ends(arrows[1])
    np.testing.assert_allclose(
        tip - tail, SCALE * shown.grasp.rotations[1] @ felt[:3], atol=EXACT)
    assert list(by_namespace(message, 'measured_forces', Marker.DELETE)) == [0]


def test_only_the_limiting_contact_is_highlighted():
    shown = dataclasses.replace(picture(), limiting_contact='index')
    message = grasp_markers(shown, anew=False)
    assert list(by_namespace(message, 'limiting_contact')) == [1]
    texts = [m.text for m in by_namespace(message, 'names').values()]
    assert texts == ['thumb', 'index (limits)']
    none = grasp_markers(dataclasses.replace(shown, limiting_contact=''), anew=False)
    assert not by_namespace(none, 'limiting_contact')


def test_the_scale_is_stated():
    text = by_namespace(grasp_markers(picture(), False), 'legend')[0].text
    assert '3 mm/N' in text and 'mm/(N m)' in text


def test_markers_are_complete_and_replace_each_other():
    message = grasp_markers(picture(), anew=False)
    keys = [(m.ns, m.id) for m in message.markers]
    assert len(set(keys)) == len(keys)
    assert keys == [(m.ns, m.id) for m in grasp_markers(picture((np.ones(4),) * 2), False).markers]
    for marker in message.markers:
        assert marker.header.frame_id == 'object' and marker.lifetime.sec == 1
        if marker.action == Marker.ADD:
            assert marker.pose.orientation.w == 1.0 and marker.scale.z > 0.0
            assert marker.color.a > 0.0
    serialize_message(message)


def test_another_set_of_contacts_begins_with_an_empty_screen():
    actions = [m.action for m in grasp_markers(picture(), anew=True).markers]
    assert actions[0] == Marker.DELETEALL and Marker.DELETEALL not in actions[1:]
    only, = delete_all(HEADER).markers
    assert only.action == Marker.DELETEALL


@pytest.mark.parametrize('resolution', [3, 36])
def test_the_map_is_a_surface_of_alpha_times_direction(resolution):
    directions = force_grid(resolution)
    alphas = wrench_map(grasp(), directions).alpha
    marker, = map_marker(HEADER, resolution, alphas, SCALE, Duration(sec=1)).markers
    assert marker.type == Marker.TRIANGLE_LIST
    assert len(marker.points) % 3 == 0 and len(marker.points) == len(marker.colors)
    vertices = {(p.x, p.y, p.z) for p in marker.points}
    wanted = {tuple(v) for v in (SCALE * alphas[:, None] * directions[:, :3]).tolist()}
    assert vertices <= wanted and len(vertices) == 2 * min(resolution, 18) ** 2
    brightest = max(zip(marker.points, marker.colors), key=lambda pair: pair[1].g)[0]
    assert math.dist((0, 0, 0), (brightest.x, brightest.y, brightest.z)) == pytest.approx(
        max(math.dist((0, 0, 0), v) for v in vertices))

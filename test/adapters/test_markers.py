# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Markers say what the answer says, to scale, and leave nothing of another contact set."""

import dataclasses
import math

from adapter_messages import EXACT
from builtin_interfaces.msg import Duration
from grasp_quality import Contact, ContactModel, evaluate, Grasp, TaskWrench, wrench_map
from grasp_quality.directions import force_grid
from msg_adapters.colours import MEASURED, OPTIMAL, TASK as LILAC, UNKNOWN, usage_colours
from msg_adapters.markers import delete_all, grasp_markers, map_marker, Picture
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

SCALE = 0.003  # [m/N]
TASK = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.2])
HEADER = Header(frame_id='object')


def grasp(model=ContactModel.SFCE, size=1.0):
    return Grasp([
        Contact((size * x, size * 0.01, 0.0), normal=(-x / 0.03, 0.0, 0.0), model=model,
                friction=0.5, torsional_friction=0.01, max_normal_force=10.0, name=name)
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


def rgba(marker):
    return marker.color.r, marker.color.g, marker.color.b, marker.color.a


def place(marker):
    p = marker.pose.position
    return np.array([p.x, p.y, p.z])


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
    assert list(cones) == [0, 1]
    for i, marker in cones.items():
        base, tip = ends(marker)
        np.testing.assert_allclose(tip, shown.grasp.positions[i], atol=EXACT)
        along = (base - tip) / np.linalg.norm(base - tip)
        np.testing.assert_allclose(along, shown.grasp.rotations[i][:, 2], atol=EXACT)
        assert marker.scale.z == pytest.approx(np.linalg.norm(base - tip))
        assert marker.scale.z == pytest.approx(0.4 * shown.grasp.lever_arm)  # docs/viewing.md
        assert 0.5 * marker.scale.y / marker.scale.z == pytest.approx(0.5)


def test_a_contact_without_friction_has_a_cone_that_is_a_line():
    held = grasp(ContactModel.FPC)
    shown = dataclasses.replace(picture(), grasp=held)
    cones = by_namespace(grasp_markers(shown, False), 'friction_cones')
    assert list(cones) == [0, 1]
    for marker in cones.values():
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
    shown = picture()
    text = by_namespace(grasp_markers(shown, False), 'legend')[0].text
    torques = 1e3 * SCALE / shown.grasp.lever_arm
    assert text == (
        f'alpha {shown.alpha:.4g}, arrows 3 mm/N, torques {torques:.3g} mm/(N m)')


def test_markers_are_complete_and_replace_each_other():
    message = grasp_markers(picture(), anew=False)
    keys = [(m.ns, m.id) for m in message.markers]
    assert len(set(keys)) == len(keys)
    assert keys == [(m.ns, m.id) for m in grasp_markers(picture((np.ones(4),) * 2), False).markers]
    for marker in message.markers:
        assert marker.header.frame_id == 'object' and marker.lifetime.sec == 1
        if marker.action == Marker.ADD:
            assert marker.pose.orientation.w == 1.0 and marker.scale.z > 0.0
            assert 0.0 < marker.color.a <= 1.0 and 0.0 <= min(rgba(marker)) <= max(
                rgba(marker)) <= 1.0
    serialize_message(message)


def test_another_set_of_contacts_begins_with_an_empty_screen():
    actions = [m.action for m in grasp_markers(picture(), anew=True).markers]
    assert actions[0] == Marker.DELETEALL and Marker.DELETEALL not in actions[1:]
    only, = delete_all(HEADER).markers
    assert only.action == Marker.DELETEALL and only.header == HEADER


def test_a_scene_twice_as_large_is_drawn_twice_as_large():
    """Forces as they are, arms, torques and metres per newton doubled: every length doubles."""
    small = dataclasses.replace(
        picture((np.array([1.0, -2.0, 5.0, 0.1]),) * 2), limiting_contact='index')
    large = dataclasses.replace(
        small, grasp=grasp(size=2.0), task=TASK * [1, 1, 1, 2, 2, 2], metres_per_newton=2 * SCALE)
    pairs = zip(grasp_markers(small, False).markers, grasp_markers(large, False).markers)
    for first, second in pairs:
        assert (first.ns, first.id, first.type, first.action) == (
            second.ns, second.id, second.type, second.action)
        np.testing.assert_allclose(2.0 * np.array(ends(first)), ends(second), atol=EXACT)
        np.testing.assert_allclose(2.0 * place(first), place(second), atol=EXACT)
        for axis in 'xyz':
            assert getattr(second.scale, axis) == pytest.approx(2.0 * getattr(first.scale, axis))


def test_arrows_are_told_apart_and_their_heads_are_no_longer_than_half_of_them():
    shown = dataclasses.replace(
        picture((np.array([1e-3, 0.0, 2e-3, 0.0]), np.array([1.0, -2.0, 5.0, 0.1]))),
        limiting_contact='index')
    message = grasp_markers(shown, False)
    for namespace, colour in (
            ('optimal_forces', OPTIMAL), ('measured_forces', MEASURED), ('task_force', LILAC),
            ('task_torque', LILAC)):
        arrows = by_namespace(message, namespace)
        assert arrows
        for arrow in arrows.values():
            assert arrow.type == Marker.ARROW
            assert rgba(arrow) == pytest.approx((*colour, 1.0))
            tail, tip = ends(arrow)
            assert arrow.scale.z <= 0.5 * np.linalg.norm(tip - tail) * (1.0 + EXACT)
            assert arrow.scale.x < arrow.scale.y < shown.grasp.lever_arm
    longer = grasp_markers(dataclasses.replace(
        shown, measured=(None, 2.0 * shown.measured[1])), False)
    assert by_namespace(longer, 'measured_forces')[1].scale.z == (
        by_namespace(message, 'measured_forces')[1].scale.z)
    force, torque = (by_namespace(message, f'task_{part}')[0] for part in ('force', 'torque'))
    assert torque.scale.x < force.scale.x and torque.scale.y < force.scale.y
    ball = by_namespace(message, 'limiting_contact')[1]
    assert ball.type == Marker.SPHERE
    np.testing.assert_allclose(place(ball), shown.grasp.positions[1], atol=EXACT)
    assert ball.scale.x == ball.scale.y == ball.scale.z < shown.grasp.lever_arm


def test_arrows_too_short_to_be_seen_are_not_drawn():
    reach = grasp().lever_arm
    pushes = [np.array([0.0, 0.0, share * reach / SCALE, 0.0]) for share in (0.5e-9, 2e-9)]
    message = grasp_markers(picture(tuple(pushes)), False)
    assert list(by_namespace(message, 'measured_forces')) == [1]


def test_names_stand_outside_of_the_object_and_the_legend_above_it():
    shown = picture()
    message = grasp_markers(shown, False)
    names = by_namespace(message, 'names')
    for i, marker in names.items():
        assert marker.type == Marker.TEXT_VIEW_FACING
        away = place(marker) - shown.grasp.positions[i]
        normal = shown.grasp.rotations[i][:, 2]
        reach = shown.grasp.lever_arm
        assert -reach < away @ normal < 0.0
        np.testing.assert_allclose(np.cross(away, normal), 0.0, atol=EXACT)
    above = place(by_namespace(message, 'legend')[0]) - shown.grasp.center
    assert above[2] > shown.grasp.lever_arm and not above[:2].any()


def test_each_cone_has_the_colour_of_its_usage_and_grey_where_there_is_no_answer():
    shown = dataclasses.replace(picture(), cone_usage=np.array([0.1, 0.9]))
    cones = by_namespace(grasp_markers(shown, False), 'friction_cones')
    for i, colour in enumerate(usage_colours(shown.cone_usage)):
        assert rgba(cones[i])[:3] == pytest.approx(colour)
    nothing = dataclasses.replace(shown, optimal=np.zeros((0, 4)), cone_usage=np.zeros(0))
    message = grasp_markers(nothing, False)
    assert not by_namespace(message, 'optimal_forces')
    assert list(by_namespace(message, 'optimal_forces', Marker.DELETE)) == [0, 1]
    for cone in by_namespace(message, 'friction_cones').values():
        assert rgba(cone)[:3] == pytest.approx(UNKNOWN)


@pytest.mark.parametrize('resolution', [3, 36])
def test_the_map_is_a_surface_of_alpha_times_direction(resolution):
    directions = force_grid(resolution)
    alphas = wrench_map(grasp(), directions).alpha
    marker, = map_marker(HEADER, resolution, alphas, SCALE, Duration(sec=1)).markers
    assert (marker.type, marker.ns, marker.header) == (Marker.TRIANGLE_LIST, 'force_map', HEADER)
    assert marker.lifetime.sec == 1 and marker.pose.orientation.w == 1.0
    assert marker.scale.x == marker.scale.y == marker.scale.z == 1.0
    assert 0.0 <= min(rgba(marker)) <= max(rgba(marker)) <= 1.0
    assert len(marker.points) % 3 == 0 and len(marker.points) == len(marker.colors)
    vertices = {(p.x, p.y, p.z) for p in marker.points}
    wanted = {tuple(v) for v in (SCALE * alphas[:, None] * directions[:, :3]).tolist()}
    assert vertices <= wanted and len(vertices) == 2 * min(resolution, 18) ** 2
    brightest = max(zip(marker.points, marker.colors), key=lambda pair: pair[1].g)[0]
    assert math.dist((0, 0, 0), (brightest.x, brightest.y, brightest.z)) == pytest.approx(
        max(math.dist((0, 0, 0), v) for v in vertices))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Positions of the sliders become tasks that the node accepts and that mean what they say."""

from grasp_quality_hand.viewer_tasks import (
    angles, AROUND, AXES, CONE, direction, FORCE, POLYTOPE, PRESETS, set_task_request, SIDES,
    sideways, TaskChoice, TORQUE, WRENCH)
from hypothesis import given, strategies
from msg_adapters.tasks import live_task, load_from
import numpy as np
import pytest

azimuths, elevations = strategies.floats(-180.0, 180.0), strategies.floats(-89.0, 89.0)
EXACT = 1e-12


@given(azimuths, elevations, strategies.floats(1e-3, 1e3))
def test_angles_and_directions_are_each_others_inverse(azimuth, elevation, size):
    vector = direction(azimuth, elevation)
    assert np.linalg.norm(vector) == pytest.approx(1.0, abs=EXACT)
    again = direction(*angles(size * vector))
    np.testing.assert_allclose(again, vector, atol=1e-7)


@given(azimuths, elevations)
def test_sideways_is_perpendicular(azimuth, elevation):
    along = direction(azimuth, elevation)
    frame = np.column_stack([*sideways(along), along])
    np.testing.assert_allclose(frame.T @ frame, np.eye(3), atol=1e-12)


@given(azimuths, elevations, strategies.sampled_from([FORCE, TORQUE]))
def test_a_direction_becomes_a_wrench_of_the_size(azimuth, elevation, quantity):
    choice = TaskChoice(WRENCH, quantity, azimuth, elevation, 2.5)
    task = live_task(set_task_request(choice), None, 10)
    part, other = (task.wrench[:3], task.wrench[3:])[::1 if quantity == FORCE else -1]
    np.testing.assert_allclose(part, 2.5 * direction(azimuth, elevation), atol=EXACT)
    assert not other.any()


def test_a_cone_opens_around_its_axis():
    task = live_task(set_task_request(TaskChoice(CONE, size=3.0, half_angle_deg=30.0)), None, 10)
    assert task.half_angle == pytest.approx(np.pi / 6)
    rows = np.array([task.axis, task.lateral_x, task.lateral_y])
    np.testing.assert_allclose(rows @ rows.T, 9.0 * np.eye(3), atol=EXACT)


@pytest.mark.parametrize('preset, count', [(AROUND, 4), (AXES, 6), (SIDES, 4)])
def test_presets_of_a_polytope(preset, count):
    assert preset in PRESETS
    wrenches = live_task(
        set_task_request(TaskChoice(POLYTOPE, size=2.0, preset=preset)), None, 10).wrenches
    assert len(wrenches) == count and not wrenches[:, 3:].any()
    mean = wrenches[:, :3].mean(axis=0)
    wanted = [0.0, 0.0, 2.0] if preset == AROUND else np.zeros(3)
    np.testing.assert_allclose(mean, wanted, atol=EXACT)


def test_the_load_goes_with_every_task():
    for kind in (WRENCH, CONE, POLYTOPE):
        request = set_task_request(TaskChoice(kind, load=(1.0, -2.0, 3.0)))
        assert load_from(request.external_wrench, None).tolist() == [1.0, -2.0, 3.0, 0, 0, 0]

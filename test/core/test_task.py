# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Tasks: their checks, and what they state."""

import dataclasses

from grasp_quality import InvalidTaskError, TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench
from known_grasps import FX, FY, FZ, TX
import numpy as np
import pytest
from tolerances import EXACT


@pytest.mark.parametrize('make, message', [
    (lambda: TaskWrench(np.zeros(6)), 'task_wrench must not be zero'),
    (lambda: TaskWrench([1, 2, 3]), r'task_wrench must have shape \(6\)'),
    (lambda: TaskWrench(np.full(6, np.nan)), 'task_wrench must be finite'),
    (lambda: TaskWrench('up'), 'task_wrench must be an array'),
    (lambda: TaskCone(np.zeros(6), FY, FZ, 0.5), 'axis must not be zero'),
    (lambda: TaskCone(FX, FY, [0.0], 0.5), r'lateral_y must have shape \(6\)'),
    (lambda: TaskCone(FX, FY, FZ, -0.1), r'half_angle \[rad\] must be at least 0'),
    (lambda: TaskCone(FX, FY, FZ, np.pi / 2), r'half_angle \[rad\] must be less than'),
    (lambda: TaskCone(FX, FY, FZ, np.nan), r'half_angle \[rad\] must be finite'),
    (lambda: TaskCone(FX, FY, FZ, 0.5, surface_samples=-1), 'surface_samples must be a whole'),
    (lambda: TaskCone(FX, FY, FZ, 0.5, surface_samples=1.5), 'surface_samples must be a whole'),
    (lambda: TaskCone(FX, -FX, FZ, 1.0), 'holds the zero wrench, so that alpha_z has no end'),
    (lambda: TaskCone(FX + FY, FX, FY, 1.0), 'holds the zero wrench'),
    (lambda: TaskPolytope(np.zeros((0, 6))), 'task_wrenches must hold at least one wrench'),
    (lambda: TaskPolytope([FX, np.zeros(6)]),
     r'task_wrenches must not be zero, but rows \[1\] are: leave'),
    (lambda: TaskPolytope([FX[:3]]), r'task_wrenches must have shape \(n, 6\)'),
    (lambda: TaskPolytope([FX, FY], [1.0]), r'weights must have shape \(2\)'),
    (lambda: TaskPolytope([FX, FY], [1.0, -1.0]), 'weights must be >= 0'),
    (lambda: TaskPolytope([FX, FY], [0.0, 0.0]), 'weights must be >= 0 with at least one > 0'),
    (lambda: TaskEllipsoid([FX[:3]]), r'axes must have shape \(n, 6\)'),
    (lambda: TaskEllipsoid([np.zeros(6)]), 'axes must not be zero'),
])
def test_error_names_value_and_rule(make, message):
    with pytest.raises(InvalidTaskError, match=message):
        make()


@pytest.mark.parametrize('task', [
    TaskWrench(FX), TaskCone(FX, FY, FZ, 0.5), TaskPolytope([FX, FY]), TaskEllipsoid([FX, FY])])
def test_tasks_are_frozen_and_their_arrays_read_only(task):
    for field in dataclasses.fields(task):
        value = getattr(task, field.name)
        if isinstance(value, np.ndarray):
            assert not value.flags.writeable
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(task, field.name, value)


def test_a_wrench_is_taken_as_given():
    assert TaskWrench([0, 0, 2, 0, 0, 0]).wrench.tolist() == [0, 0, 2, 0, 0, 0]


def test_cone_with_dependent_laterals_is_fine_while_it_does_not_hold_zero():
    assert TaskCone(FX, -FX, FZ, 0.7).half_angle == 0.7
    assert TaskCone(FX, np.zeros(6), np.zeros(6), 1.5).half_angle == 1.5


def test_surface_of_a_cone():
    task = TaskCone(FX, FY, TX, 0.6, surface_samples=8)
    assert task.surface.shape == (8, 6)
    assert task.surface[:, 0] == pytest.approx(np.ones(8), abs=EXACT)
    assert np.hypot(task.surface[:, 1], task.surface[:, 3]) == pytest.approx(
        np.full(8, np.tan(0.6)), abs=EXACT)


def test_weights_of_a_polytope_are_equal_when_left_out():
    assert TaskPolytope([FX, FY, FZ]).weights == pytest.approx(np.full(3, 1 / 3), rel=EXACT)
    assert TaskPolytope([FX, FY], [3, 1]).weights.tolist() == [3.0, 1.0]

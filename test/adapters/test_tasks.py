# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Tasks and loads: as given, in the object frame, and refused by field."""

from collections.abc import Sequence
import math
from types import SimpleNamespace

from adapter_messages import any_float, BAD_NUMBERS, shuffled_axes, wrench
from grasp_quality import GraspQualityError, TaskCone, TaskPolytope, TaskWrench
from grasp_quality_msgs.srv import EvaluateTaskCone, EvaluateTaskPolytope, SetTask
from hypothesis import given, strategies
from msg_adapters.errors import InvalidMessageError
from msg_adapters.tasks import (
    cone_task, live_task, load_from, polytope_task, wrench_rows, wrench_task)
import numpy as np
import pytest

MOVED_X = [0.0, 1.0, 0.0, -3.0, 0.0, 1.0]  # a unit force along x through shuffled_axes()


def cone(**fields):
    return EvaluateTaskCone.Request(**{
        'axis': wrench(fz=2.0), 'lateral_x': wrench(fx=1.0), 'lateral_y': wrench(fy=1.0),
        'half_angle': 0.5, **fields})


def polytope(count=3, **fields):
    return EvaluateTaskPolytope.Request(
        task_wrenches=[wrench(fx=1.0 + i) for i in range(count)], **fields)


def test_wrenches_are_taken_as_given():
    assert wrench_task(wrench(fz=9.81), None).wrench.tolist() == [0, 0, 9.81, 0, 0, 0]
    assert load_from(wrench(fz=-9.81), None).tolist() == [0, 0, -9.81, 0, 0, 0]


def test_other_frames_are_brought_into_the_object_frame():
    move = shuffled_axes()
    assert wrench_task(wrench(fx=1.0), move).wrench.tolist() == MOVED_X
    assert load_from(wrench(fx=1.0), move).tolist() == MOVED_X
    assert cone_task(cone(axis=wrench(fx=1.0)), move, 0).axis.tolist() == MOVED_X
    assert cone_task(cone(), move, 0).lateral_x.tolist() == MOVED_X
    assert cone_task(cone(lateral_y=wrench(fx=1.0)), move, 0).lateral_y.tolist() == MOVED_X
    assert polytope_task(polytope(1), move, 9).wrenches.tolist() == [MOVED_X]


def test_no_load_is_a_load():
    assert not load_from(wrench(), None).any()


@pytest.mark.parametrize('size', [0.0, -0.0, 1e-300])
def test_a_task_without_direction_is_refused(size):
    with pytest.raises(InvalidMessageError, match='^task_wrench must not be zero .below 1e-12.'):
        wrench_task(wrench(fx=size), None)
    with pytest.raises(InvalidMessageError, match='^axis must not be zero'):
        cone_task(cone(axis=wrench(fx=size)), None, 0)
    with pytest.raises(InvalidMessageError, match=r'^directions\[1\] must not be zero'):
        wrench_rows([wrench(fx=1.0), wrench(fx=size)], None, 9, 'directions')


def test_the_smallest_task_is_the_one_that_the_error_names():
    assert wrench_task(wrench(fx=1e-12), None).wrench[0] == 1e-12


@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_bad_number_is_refused_by_field(value):
    with pytest.raises(InvalidMessageError, match='^external_wrench must be finite'):
        load_from(wrench(tx=value), None)
    with pytest.raises(InvalidMessageError, match='^task_wrench must be finite'):
        wrench_task(wrench(tx=value), None)
    with pytest.raises(InvalidMessageError, match=r'^directions\[1\] must be finite'):
        wrench_rows([wrench(fx=1.0), wrench(tx=value)], None, 9, 'directions')


def test_a_cone_keeps_its_parts():
    task = cone_task(cone(), None, 16)
    assert task.axis.tolist() == [0, 0, 2, 0, 0, 0]
    assert task.lateral_y.tolist() == [0, 1, 0, 0, 0, 0]
    assert (task.half_angle, task.surface_samples) == (0.5, 16)


@pytest.mark.parametrize('angle', [-0.1, math.pi / 2, math.nan, math.inf])
def test_a_bad_half_angle_is_refused(angle):
    with pytest.raises(GraspQualityError, match='half_angle .rad. must be'):
        cone_task(cone(half_angle=angle), None, 0)


@pytest.mark.parametrize('field', ['axis', 'lateral_x', 'lateral_y'])
@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_bad_number_of_a_cone_is_refused_by_field(field, value):
    with pytest.raises(InvalidMessageError, match=f'^{field} must be finite'):
        cone_task(cone(**{field: wrench(tz=value)}), None, 0)


def test_weights_are_a_share_each_unless_given():
    assert polytope_task(polytope(4), None, 9).weights.tolist() == [0.25] * 4
    given_ones = polytope_task(polytope(2, weights=[1.0, 3.0]), None, 9)
    assert given_ones.weights.tolist() == [1, 3]


@pytest.mark.parametrize('weights', [[1.0], [1.0] * 4])
def test_a_wrong_number_of_weights_is_refused(weights):
    with pytest.raises(InvalidMessageError, match=(
            f'^weights must .*each of the 3 task_wrenches, got {len(weights)}$')):
        polytope_task(polytope(3, weights=weights), None, 9)


@pytest.mark.parametrize('weights', [[-1.0, 1.0, 1.0], [0.0] * 3, *(
    [1.0, 1.0, value] for value in BAD_NUMBERS)])
def test_a_bad_weight_is_refused(weights):
    with pytest.raises(GraspQualityError, match='weights must be'):
        polytope_task(polytope(3, weights=weights), None, 9)


def test_a_polytope_needs_a_wrench():
    with pytest.raises(InvalidMessageError, match='^task_wrenches must hold at least one'):
        polytope_task(polytope(0), None, 9)


def test_more_than_the_limit_is_refused_with_the_parameter():
    assert len(wrench_rows([wrench(fx=1.0)] * 9, None, 9, 'directions')) == 9
    with pytest.raises(InvalidMessageError, match=(
            r'^directions must .*at most 9 wrenches \(parameter max_request_size\), got 10$')):
        wrench_rows([wrench(fx=1.0)] * 10, None, 9, 'directions')
    with pytest.raises(InvalidMessageError, match='^task_wrenches must hold at most 2 .*got 3$'):
        polytope_task(polytope(3), None, 2)


class Unread(Sequence):
    """So many that nobody may look at a single one."""

    def __len__(self):
        return 1_000_000

    def __getitem__(self, index):
        raise AssertionError('looked at before the count')


@pytest.mark.parametrize('read', [
    lambda: wrench_rows(Unread(), None, 10, 'directions'),
    lambda: polytope_task(SimpleNamespace(task_wrenches=Unread(), weights=[]), None, 10),
    lambda: polytope_task(
        SimpleNamespace(task_wrenches=[wrench(1.0)], weights=Unread()), None, 10)])
def test_too_many_are_refused_by_their_count_alone(read):
    with pytest.raises(InvalidMessageError) as caught:
        read()
    assert len(str(caught.value)) < 150


def test_a_live_task_reads_the_fields_of_its_kind_alone():
    request = SetTask.Request(
        kind=SetTask.Request.WRENCH, task_wrench=wrench(fx=1.0), axis=wrench(fx=math.nan))
    assert isinstance(live_task(request, None, 9), TaskWrench)
    request = SetTask.Request(
        kind=SetTask.Request.CONE, axis=wrench(fz=1.0), lateral_x=wrench(fx=1.0),
        lateral_y=wrench(fy=1.0), half_angle=0.5, task_wrench=wrench(fx=math.nan))
    task = live_task(request, None, 9)
    assert isinstance(task, TaskCone) and task.surface_samples == 0
    request = SetTask.Request(kind=SetTask.Request.POLYTOPE, task_wrenches=[wrench(fx=1.0)])
    task = live_task(request, None, 9)
    assert isinstance(task, TaskPolytope) and task.parallelotope is False
    assert polytope_task(polytope(), None, 9).parallelotope is True


def test_a_live_task_is_brought_into_the_object_frame():
    move = shuffled_axes()
    task = live_task(SetTask.Request(
        kind=SetTask.Request.WRENCH, task_wrench=wrench(fx=1.0)), move, 9)
    assert task.wrench.tolist() == MOVED_X
    task = live_task(SetTask.Request(
        kind=SetTask.Request.CONE, axis=wrench(fx=1.0), lateral_x=wrench(fx=1.0),
        lateral_y=wrench(fy=1.0), half_angle=0.5), move, 9)
    assert task.axis.tolist() == task.lateral_x.tolist() == MOVED_X
    assert task.lateral_y.tolist() != [0, 1, 0, 0, 0, 0]
    task = live_task(SetTask.Request(
        kind=SetTask.Request.POLYTOPE, task_wrenches=[wrench(fx=1.0)]), move, 9)
    assert task.wrenches.tolist() == [MOVED_X]


@pytest.mark.parametrize('kind', [SetTask.Request.KIND_UNSET, 4, 255])
def test_an_unknown_kind_is_refused_with_the_choices(kind):
    with pytest.raises(InvalidMessageError, match=rf'^kind must be 1 .*2 .*3 .*got {kind}$'):
        live_task(SetTask.Request(kind=kind), None, 9)


@given(strategies.tuples(*[any_float] * 8), strategies.booleans())
def test_any_numbers_are_a_finite_task_or_a_clear_error(numbers, moved):
    move = shuffled_axes() if moved else None
    message = wrench(*numbers[:6])
    questions = (
        lambda: wrench_task(message, move).wrench,
        lambda: load_from(message, move),
        lambda: cone_task(cone(axis=message, half_angle=numbers[6]), move, 4).surface,
        lambda: cone_task(cone(lateral_x=message), move, 4).surface,
        lambda: polytope_task(polytope(2, weights=list(numbers[6:])), move, 2).weights)
    for question in questions:
        try:
            assert np.isfinite(question()).all()
        except GraspQualityError:
            pass

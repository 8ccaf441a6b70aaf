# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The worst case in messages: balls and ellipsoids of requests, and answers."""

import math

from adapter_messages import shuffled_axes, wrench
from grasp_quality import ball_radius, Contact, ContactModel, Grasp
from grasp_quality_msgs.msg import ResultCode
from grasp_quality_msgs.srv import BallRadius
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
from msg_adapters.worst_case import ellipsoid_from, fill_ball_radius, NO_PROOF, width_from
import numpy as np
import pytest

Request = BallRadius.Request
GRASP = Grasp([Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), ContactModel.SFCE, 0.5, 0.1, name=name)
               for x, name in ((-1.0, 'left'), (1.0, 'right'))], 'l1')


@pytest.mark.parametrize('fields, axes', [
    ({}, np.eye(6)), ({'torque_length': 0.1}, np.diag([1, 1, 1, 0.1, 0.1, 0.1])),
    ({'subspace': Request.SUBSPACE_FORCE}, np.eye(6)[:3]),
    ({'subspace': Request.SUBSPACE_TORQUE, 'torque_length': 2.0}, 2.0 * np.eye(6)[3:])])
def test_a_ball_is_an_ellipsoid_of_unit_axes(fields, axes):
    assert ellipsoid_from(Request(**fields), None, 10).axes == pytest.approx(axes)


def test_a_ball_in_another_frame_is_about_that_origin():
    moved = Transform(p=np.array([0.0, 0.0, 1.0]))
    axes = ellipsoid_from(Request(subspace=Request.SUBSPACE_FORCE), moved, 10).axes
    assert axes == pytest.approx(np.array([
        [1, 0, 0, 0, 1, 0], [0, 1, 0, -1, 0, 0], [0, 0, 1, 0, 0, 0]]))


def test_given_axes_are_taken():
    request = Request(axes=[wrench(fx=2.0), wrench(tz=0.5)], subspace=7)
    assert ellipsoid_from(request, None, 2).axes == pytest.approx(
        np.array([[2, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0.5]]))
    with pytest.raises(InvalidMessageError, match='^axes must hold at most 1 '):
        ellipsoid_from(request, None, 1)
    with pytest.raises(InvalidMessageError, match=r'^axes\[1\] must not be zero'):
        ellipsoid_from(Request(axes=[wrench(fx=1.0), wrench()]), None, 2)


def test_given_axes_are_brought_into_the_object_frame():
    axes = ellipsoid_from(Request(axes=[wrench(fx=1.0)]), shuffled_axes(), 1).axes
    assert axes.tolist() == [[0.0, 1.0, 0.0, -3.0, 0.0, 1.0]]


@pytest.mark.parametrize('fields, words', [
    ({'subspace': 3}, r'subspace must be one of \[0, 1, 2\] .*got 3$'),
    ({'torque_length': -0.1}, r'torque_length \[m\] must be at least 0, got -0.1$'),
    ({'torque_length': 1e-150}, r'torque_length \[m\] must be 0 .* or at least 1e-12, got 1e-150'),
    ({'torque_length': math.inf}, 'torque_length must be finite'),
    ({'external_wrench': wrench(fx=1.0)}, 'external_wrench must be zero.*evaluate_task_wrench$'),
    ({'external_wrench': wrench(fx=math.nan)}, 'external_wrench must be finite')])
def test_refusals(fields, words):
    with pytest.raises(InvalidMessageError, match=f'^{words}'):
        ellipsoid_from(Request(**fields), None, 10)


def test_the_width_has_a_default():
    assert (width_from(Request()), width_from(Request(relative_width=0.1))) == (0.01, 0.1)
    with pytest.raises(InvalidMessageError, match='^relative_width must be finite'):
        width_from(Request(relative_width=math.nan))


def test_an_answer_is_written_whole():
    found = ball_radius(GRASP)
    response = BallRadius.Response()
    fill_ball_radius(response, found)
    assert (response.result.code, response.result.message) == (ResultCode.OPTIMAL, '')
    assert (response.lower, response.upper, response.reached) == (found.lower, found.upper, True)
    assert abs(response.weakest_wrench.torque.x) == pytest.approx(1.0)
    assert response.limiting_contacts == list(found.limiting_contacts) != []


def test_a_wide_interval_says_so():
    response = BallRadius.Response()
    fill_ball_radius(response, ball_radius(GRASP, relative_width=1e-6, time_limit_s=1e-9))
    assert response.result.code == ResultCode.OPTIMAL and response.result.message == NO_PROOF
    assert not response.reached and response.lower < response.upper

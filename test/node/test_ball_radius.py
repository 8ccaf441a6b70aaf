# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The service ball_radius: closed forms, subspaces, ellipsoids, refusals."""

import math

from grasp_quality_msgs.msg import Contact, ResultCode
from grasp_quality_msgs.srv import BallRadius
from grasps import ANTIPODAL, CIRCLE, contact_array, numbers, wrench
import numpy as np
import pytest

RADIUS = 10.0 * 3.0 * 0.5 / math.sqrt(5.0)  # three fingers of 10 N on a circle of 1 m, mu = 0.5


@pytest.fixture(scope='module')
def client(start):
    return start(solver_time_limit='10.0').client


def ask(client, poses=CIRCLE, **fields):
    contacts = fields.pop('contacts', contact_array(poses))
    return client.call(BallRadius, 'ball_radius', contacts=contacts, **fields)


def test_three_fingers(client):
    answer = ask(client)
    assert answer.result.code == ResultCode.OPTIMAL and answer.result.message == ''
    assert answer.lower <= RADIUS <= answer.upper and answer.reached
    assert answer.upper - answer.lower <= 0.0101 * answer.upper
    assert np.linalg.norm(numbers(answer.weakest_wrench)) == pytest.approx(1.0)
    assert answer.limiting_contacts and set(answer.limiting_contacts) <= {
        'contact_0', 'contact_1', 'contact_2'}


def test_a_narrower_interval(client):
    answer = ask(client, relative_width=1e-3)
    assert answer.lower <= RADIUS <= answer.upper
    assert answer.upper - answer.lower <= 1.01e-3 * answer.upper


def test_soft_fingers_have_their_closed_form(client):
    """Torsion limits an antipodal pair: 2 gamma F about the line between the fingers."""
    soft = contact_array(ANTIPODAL, model=[Contact.MODEL_SFCE] * 2,
                         torsional_friction_coefficient=[0.1] * 2)
    answer = ask(client, contacts=soft, subspace=BallRadius.Request.SUBSPACE_TORQUE)
    assert answer.lower <= 2.0 <= answer.upper and answer.reached
    assert abs(answer.weakest_wrench.torque.x) == pytest.approx(1.0)


def test_a_flat_grasp_has_no_ball_but_one_of_forces(client):
    answer = ask(client, ANTIPODAL)
    assert (answer.result.code, answer.lower, answer.upper) == (ResultCode.OPTIMAL, 0.0, 0.0)
    answer = ask(client, ANTIPODAL, subspace=BallRadius.Request.SUBSPACE_FORCE)
    assert answer.lower <= 10.0 * math.sqrt(0.5) <= answer.upper
    assert not numbers(answer.weakest_wrench)[3:].any()


def test_an_ellipsoid_of_one_axis_is_a_task_both_ways(client):
    answer = ask(client, axes=[wrench(fx=2.0)])
    assert answer.lower <= 5.0 <= answer.upper and answer.reached  # +x holds 10 N, -x more


@pytest.mark.parametrize('fields, words', [
    ({'torque_length': -1.0}, 'torque_length'), ({'torque_length': math.nan}, 'torque_length'),
    ({'subspace': 3}, 'subspace must be one of [0, 1, 2]'),
    ({'relative_width': 1.0}, 'relative_width'), ({'axes': [wrench()]}, 'axes[0]'),
    ({'external_wrench': wrench(fz=-1.0)}, 'external_wrench must be zero')])
def test_a_broken_rule_is_named(client, fields, words):
    answer = ask(client, **fields)
    assert answer.result.code == ResultCode.INVALID_REQUEST and words in answer.result.message
    assert answer == BallRadius.Response(result=answer.result, solve_time=answer.solve_time)

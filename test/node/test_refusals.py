# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Services that cannot answer say why: a code, a field and a rule, and nothing beside it."""

import math

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, wrench
import pytest
from std_msgs.msg import Header

UP = wrench(fz=1.0)
LIMIT = 20  # max_request_size
MICROSECOND = '0.000001'


@pytest.fixture(scope='module')
def client(start):
    return start(max_request_size=LIMIT).client


def contacts(**fields):
    return contact_array(ANTIPODAL, **fields)


def turned(w):
    message = contacts()
    message.contacts[1].pose.orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=w)
    return message


def moved(x):
    message = contacts()
    message.contacts[1].pose.position.x = x
    return message


def task(**fields):
    return srv.EvaluateTaskWrench, {'contacts': contacts(), 'task_wrench': UP, **fields}


def cone(**fields):
    return srv.EvaluateTaskCone, {
        'contacts': contacts(), 'axis': UP, 'lateral_x': wrench(fx=1.0),
        'lateral_y': wrench(fy=1.0), 'half_angle': 0.5, **fields}


def polytope(**fields):
    return srv.EvaluateTaskPolytope, {'contacts': contacts(), 'task_wrenches': [UP, UP], **fields}


def directions(*wrenches, **fields):
    return srv.WrenchMap, {'contacts': contacts(), 'directions': list(wrenches), **fields}


def load(value):
    return srv.MinimumForces, {'contacts': contacts(), 'external_wrench': wrench(fz=value)}


def live(**fields):
    return srv.SetTask, fields


NAMES = {
    srv.EvaluateTaskWrench: 'evaluate_task_wrench', srv.EvaluateTaskCone: 'evaluate_task_cone',
    srv.EvaluateTaskPolytope: 'evaluate_task_polytope', srv.MinimumForces: 'minimum_forces',
    srv.RobustAlpha: 'robust_alpha', srv.WrenchMap: 'wrench_map', srv.SetTask: 'set_task'}


def check_refusal(client, question, code, words):
    """Ask; the answer must be the code and the words, and besides them an empty message."""
    kind, fields = question
    answer = client.call(kind, NAMES[kind], **fields)
    assert answer.result.code == code, answer.result
    assert words in answer.result.message
    assert answer == kind.Response(result=answer.result, solve_time=answer.solve_time)


@pytest.mark.parametrize('question, words', [
    (task(task_wrench=wrench()), 'task_wrench must not be zero'),
    (task(task_wrench=wrench(tz=math.nan)), 'task_wrench must be finite'),
    (task(external_wrench=wrench(fx=-math.inf)), 'external_wrench must be finite'),
    (task(contacts=turned(0.0)), 'contacts[1].pose.orientation must be a quaternion of norm 1'),
    (task(contacts=turned(2.0)), 'contacts[1].pose.orientation must be a quaternion of norm 1'),
    (task(contacts=turned(math.nan)), 'contacts[1].pose.orientation must be'),
    (task(contacts=moved(math.nan)), 'contacts[1].pose.position must be finite'),
    (task(contacts=moved(1e300)), 'contacts[1].pose.position must be finite'),
    (task(contacts=contacts(frame='')), 'header.frame_id of the contacts must not be empty'),
    (task(contacts=contacts(name=['a', 'a'])), 'contacts[1].name must be unique'),
    (task(contacts=contacts(model=[0, 7])), 'contacts[1].model must be one of'),
    (task(contacts=contacts(friction_coefficient=[-0.1, 0.0])),
     'contacts[0].friction_coefficient must be'),
    (task(contacts=contacts(max_normal_force=[1.0, math.inf])),
     'contacts[1].max_normal_force must be finite'),
    (task(contacts=contact_array(ANTIPODAL * 11)), f'at most {LIMIT} (parameter max_request_size'),
    (cone(axis=wrench()), 'axis must not be zero'),
    (cone(half_angle=1.6), 'half_angle [rad] must be less than'),
    (cone(lateral_y=wrench(fx=math.nan)), 'lateral_y must be finite'),
    (polytope(task_wrenches=[]), 'task_wrenches must hold at least one'),
    (polytope(task_wrenches=[UP] * 21), f'task_wrenches must hold at most {LIMIT}'),
    (polytope(weights=[1.0]), 'weights must be empty or hold one number for each of the 2'),
    (polytope(weights=[1.0, -1.0]), 'weights must be >= 0'),
    (polytope(weights=[1.0, math.inf]), 'weights must be finite'),
    (directions(UP, wrench()), 'directions[1] must not be zero'),
    (directions(*[UP] * 21), f'directions must hold at most {LIMIT}'),
    (directions(resolution=4), f'resolution must give at most {LIMIT} directions'),
    (directions(), f'resolution must give at most {LIMIT} directions'),
    (load(math.nan), 'external_wrench must be finite'),
    (live(), 'kind must be 1 (WRENCH), 2 (CONE) or 3 (POLYTOPE), got 0'),
    (live(kind=1), 'task_wrench must not be zero'),
    (live(kind=2, axis=UP, half_angle=math.nan), 'half_angle [rad] must be finite'),
    (live(kind=3, task_wrenches=[UP], weights=[0.0]), 'weights must be >= 0'),
    (live(kind=1, task_wrench=UP, external_wrench=wrench(fy=math.nan)),
     'external_wrench must be finite')])
def test_a_broken_rule_is_named_with_its_field(client, question, words):
    check_refusal(client, question, ResultCode.INVALID_REQUEST, words)


@pytest.mark.parametrize('question', [task, cone, polytope, directions])
def test_another_frame_needs_tf2(client, question):
    """Wrenches in the frame of the hand, contacts in that of the object."""
    asked = question(header=Header(frame_id='palm'))
    check_refusal(client, asked, ResultCode.TRANSFORM_FAILED, "'palm' is not the object frame")


def test_a_stamp_before_the_epoch_is_no_reason_to_fail(client):
    kind, fields = task(contacts=contacts(stamp=Time(sec=-7)), header=Header(stamp=Time(sec=-7)))
    assert client.call(kind, NAMES[kind], **fields).result.code == ResultCode.OPTIMAL


@pytest.mark.parametrize('question', [
    task(contacts=contact_array([])), cone(contacts=contact_array([])),
    polytope(contacts=contact_array([])), directions(UP, contacts=contact_array([])),
    (srv.MinimumForces, {})])
def test_without_any_contacts_there_is_no_answer(client, question):
    check_refusal(client, question, ResultCode.NO_CONTACTS, 'no contacts received yet')


def test_a_request_that_nobody_filled_in_is_answered(client):
    for kind, name in NAMES.items():
        answer = client.call(kind, name)
        assert answer.result.code in (ResultCode.NO_CONTACTS, ResultCode.INVALID_REQUEST)
        assert answer.result.message


def test_a_default_response_is_no_success():
    assert all(kind.Response().result.code == ResultCode.UNDEFINED for kind in NAMES)


def test_a_solver_without_time_says_so(start):
    client = start(solver_time_limit=MICROSECOND).client
    for question in (task(), cone(), polytope(), load(1.0)):
        check_refusal(client, question, ResultCode.TIMED_OUT, 'time limit')


def test_contacts_in_another_frame_than_the_object_need_tf2(start):
    client = start(object_frame='cup').client
    check_refusal(client, task(), ResultCode.TRANSFORM_FAILED, "'object' is not the object frame")
    for frame in ('', 'cup'):
        kind, fields = task(contacts=contacts(frame=frame))
        answer = client.call(kind, NAMES[kind], **fields)
        assert answer.result.code == ResultCode.OPTIMAL
        assert answer.forces.header.frame_id == 'cup'

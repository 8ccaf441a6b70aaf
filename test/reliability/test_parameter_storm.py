# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Hundreds of parameter changes, good and bad, while contacts arrive.

Every answer obeys one whole set of parameters, never a mixture of two; what is refused changes
nothing; and once a change has been answered, every sample from then on obeys it. The auditor
judges all forces by the parameters of their moment beside it.
"""

import math
import time

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT
import numpy as np
import pytest
from rcl_interfaces.msg import Parameter as ParameterMessage, ParameterValue
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter
from rig import MAX_AGE_S

CHANGES = 300
# (mu, cap [N], bound) and the alpha of the antipodal pair: any mixture of them gives another one
SETS = {(0.5, 10.0, 'linf'): 10.0, (0.8, 7.0, 'l1'): 5.6, (0.3, 20.0, 'linf'): 12.0}
FIRST = next(iter(SETS))
BAD = (
    {'friction_coefficient': math.nan}, {'friction_coefficient': -1.0},
    {'friction_coefficient': 1.0, 'force_bound': 'l3'}, {'max_normal_force': 0.0},
    {'friction_coefficient': 2.0, 'max_normal_force': 'much'}, {'contact_model': 'RUBBER'},
    {'max_normal_force': 5.0, 'no_such_parameter': 1.0}, {'max_contact_age': -1.0},
    {'force_bound': 'l2', 'contact_names': ['a']}, {'task_wrench': [math.inf] * 6})


def messages(changes):
    return [Parameter(name, value=value).to_parameter_msg() for name, value in changes.items()]


@pytest.fixture
def put(hand):
    """Change parameters together; the first set is put back behind the test."""
    publisher = hand.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)

    def feed():
        publisher.publish(pose_array(ANTIPODAL, hand.client.now()))

    def together(changes):
        return hand.client.call(
            SetParametersAtomically, 'set_parameters_atomically', feed,
            parameters=messages(changes)).result.successful

    together.feed = feed
    yield together
    assert together(named(FIRST))


def named(values):
    return dict(zip(('friction_coefficient', 'max_normal_force', 'force_bound'), values))


def test_every_answer_obeys_one_set_and_the_newest_once_it_is_answered(hand, poses, put):
    draw = np.random.default_rng(11)
    hand.client.until(hand.record.optimal, 'an answer', poses(ANTIPODAL))
    hand.record.forget()
    changes = [(0, 0, FIRST)]  # (asked [ns], answered [ns], values)
    for _ in range(CHANGES):
        kind = draw.integers(4)
        if kind == 0:
            assert not put(BAD[draw.integers(len(BAD))])
        elif kind == 1:
            unknown = ParameterMessage(name='max_normal_force', value=ParameterValue(type=99))
            answer = hand.client.call(SetParameters, 'set_parameters', put.feed, parameters=[
                unknown, *messages(BAD[draw.integers(2)])])
            assert not any(result.successful for result in answer.results)
        else:
            values = list(SETS)[draw.integers(len(SETS))]
            asked_ns = time.time_ns()
            assert put(named(values))
            changes.append((asked_ns, time.time_ns(), values))
    hand.record.until_answers(20, put.feed)
    replaced_ns = [answered_ns for _, answered_ns, _ in changes[1:]] + [math.inf]
    for message, sent_ns in hand.record.quality:
        assert any(abs(message.alpha - SETS[values]) < 1e-4
                   for (asked_ns, _, values), until_ns in zip(changes, replaced_ns)
                   if asked_ns <= sent_ns <= until_ns)
    assert {m.result.code for m, _ in hand.record.quality} == {ResultCode.OPTIMAL}
    assert len({round(m.alpha, 3) for m in hand.record.optimal()}) == len(SETS)
    hand.record.check(MAX_AGE_S)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever stands in a request: an answer comes, and no number in it is not a number."""

import math

from geometry_msgs.msg import Quaternion
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import Contact, ResultCode
from grasps import CIRCLE, contact_array, wrench
import numpy as np
import pytest

EXTREMES = (0.0, -0.0, 1.0, -1.0, 1e-12, 1e-9, 1e9, 1e12, -1e12, 5e-324, 1e308, math.nan, math.inf)
MODELS = (Contact.MODEL_DEFAULT, Contact.MODEL_FPC, Contact.MODEL_PCWF, Contact.MODEL_SFCE, 9)


def leaves(message):
    """Yield every number in a message."""
    for name in message.get_fields_and_field_types():
        value = getattr(message, name)
        for item in value if hasattr(value, '__len__') and not isinstance(value, str) else [value]:
            if hasattr(item, 'get_fields_and_field_types'):
                yield from leaves(item)
            elif not isinstance(item, str):
                yield item


@pytest.mark.parametrize('seed', range(30))
def test_any_request_is_answered_with_finite_numbers(client, seed):
    rng = np.random.default_rng(seed)
    share = rng.choice([0.02, 0.1, 0.3])  # of extreme numbers

    def number(usual):
        return float(rng.choice(EXTREMES)) if rng.random() < share else usual

    contacts = contact_array(CIRCLE)
    for item in contacts.contacts:
        item.model = int(rng.choice(MODELS)) if rng.random() < share else Contact.MODEL_DEFAULT
        item.friction_coefficient = number(0.5)
        item.torsional_friction_coefficient = number(0.01)
        item.max_normal_force = number(10.0)
        position = item.pose.position
        position.x, position.y, position.z = (number(v) for v in (
            position.x, position.y, position.z))
        if rng.random() < share:
            item.pose.orientation = Quaternion(x=number(0.0), y=number(0.0), z=number(0.0))
    task = wrench(*(number(v) for v in rng.normal(size=6)))
    load = wrench(*(number(0.0) for _ in range(6)))
    for kind, name, fields in (
            (srv.EvaluateTaskWrench, 'evaluate_task_wrench', {'task_wrench': task}),
            (srv.EvaluateTaskCone, 'evaluate_task_cone', {
                'axis': task, 'lateral_x': wrench(number(1.0)), 'lateral_y': wrench(0.0, 1.0),
                'half_angle': number(0.5)}),
            (srv.EvaluateTaskPolytope, 'evaluate_task_polytope', {
                'task_wrenches': [task, wrench(fx=number(1.0))], 'weights': [number(1.0), 2.0]}),
            (srv.MinimumForces, 'minimum_forces', {}),
            (srv.RobustAlpha, 'robust_alpha', {
                'task_wrench': task, 'samples': 20, 'contact_noise': number(0.001),
                'friction_noise': number(0.1), 'load_noise': wrench(fx=number(0.1))}),
            (srv.WrenchMap, 'wrench_map', {'directions': [task, wrench(fz=number(1.0))]})):
        answer = client.call(kind, name, contacts=contacts, external_wrench=load, **fields)
        assert answer.result.code != ResultCode.UNDEFINED
        assert 'internal error' not in answer.result.message, (name, answer.result)
        assert all(math.isfinite(value) for value in leaves(answer)), (name, answer)


@pytest.fixture(scope='module')
def client(start):
    return start(solver_time_limit='0.1').client

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of a running node: changes take effect, bad ones change nothing."""

import math

from geometry_msgs.msg import PoseArray
from grasps import ANTIPODAL, pose_array, SOLVER
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rcl_interfaces.msg import Parameter as ParameterMessage, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters, GetParameters, ListParameters, SetParameters, SetParametersAtomically)
from rclpy.parameter import Parameter

NAMES = {
    'object_frame', 'contact_source', 'contact_names', 'contact_fingers', 'contact_model',
    'friction_coefficient', 'torsional_friction_coefficient', 'max_normal_force', 'force_bound',
    'barrier_weight', 'alpha_reserve', 'force_rate_limit', 'wanted_margin', 'margin_warning',
    'task_wrench', 'min_contact_force', 'max_contact_age', 'max_load_age', 'solver_time_limit',
    'max_request_size', 'map_directions', 'marker_rate', 'marker_force_scale',
    'display_time_share', 'autostart', 'quantile_samples', 'quantile_level', 'contact_noise',
    'normal_noise', 'friction_noise', 'load_noise'}
ALONG_Y = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='2.0', task_wrench=str(ALONG_Y)).client


@pytest.fixture(scope='module')
def alpha(client):
    """Return a function that waits for an alpha of the antipodal pair."""
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    outputs = Outputs(client)
    return lambda value, rel=SOLVER: outputs.answer(
        lambda: publisher.publish(pose_array(ANTIPODAL, client.now())),
        lambda quality: quality.alpha == pytest.approx(value, rel=rel))


def messages(changes):
    return [Parameter(name, value=value).to_parameter_msg() for name, value in changes.items()]


def change(client, **changes):
    return client.call(
        SetParameters, 'set_parameters', parameters=messages(changes)).results


@pytest.fixture
def restored(client):
    """Put everything back behind a test."""
    yield
    results = change(
        client, friction_coefficient=0.5, max_normal_force=10.0, force_bound='linf',
        contact_model='PCWF', torsional_friction_coefficient=0.005, barrier_weight=0.0,
        task_wrench=ALONG_Y, max_contact_age=2.0)
    assert all(result.successful for result in results)


def test_all_parameters_have_descriptions(client):
    listed = client.call(ListParameters, 'list_parameters').result.names
    assert NAMES <= set(listed)
    answer = client.call(DescribeParameters, 'describe_parameters', names=sorted(NAMES))
    for descriptor in answer.descriptors:
        assert len(descriptor.description) > 10
    ranges = {d.name: d.floating_point_range or d.integer_range for d in answer.descriptors}
    assert ranges['friction_coefficient'][0].from_value == 0.0
    assert ranges['max_request_size'][0].from_value == 1


@pytest.mark.parametrize('changes, value', [
    ({'friction_coefficient': 1.0}, 20.0), ({'max_normal_force': 3.0}, 3.0),
    ({'force_bound': 'l1'}, 5.0), ({'force_bound': 'l2'}, 10.0 * math.sqrt(0.5)),
    ({'task_wrench': [0.0, 0.0, 4.0, 0.0, 0.0, 0.0]}, 2.5),
    ({'contact_model': 'SFCE', 'torsional_friction_coefficient': 0.01,
      'task_wrench': [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]}, 0.2)])
def test_a_change_takes_effect_at_once(client, alpha, restored, changes, value):
    alpha(10.0)
    assert all(result.successful for result in change(client, **changes))
    alpha(value)


def test_a_barrier_weight_buys_margin_with_alpha(client, alpha, restored):
    """Closed form: alpha = 2 (sqrt(mu^2 + eps^2) - eps) at caps 1, eps in the unit of alpha."""
    assert alpha(10.0).quality.friction_margin < 1e-5
    assert change(client, barrier_weight=0.5)[0].successful
    found = alpha(20.0 * (math.sqrt(0.25 + 0.05 ** 2) - 0.05), rel=1e-5)
    assert found.quality.friction_margin > 0.05
    assert found.quality.alpha_upper == pytest.approx(10.0, rel=1e-5)


@pytest.mark.parametrize('changes, words', [
    ({'friction_coefficient': -0.1}, 'out of range'),
    ({'friction_coefficient': math.nan}, 'out of range'),
    ({'friction_coefficient': 'high'}, 'DOUBLE'),
    ({'max_normal_force': 0.0}, 'max_normal_force must be greater than 0'),
    ({'max_contact_age': 0.0}, 'max_contact_age'),
    ({'max_load_age': -1.0}, 'out of range'), ({'max_load_age': math.inf}, 'out of range'),
    ({'max_load_age': math.nan}, 'out of range'), ({'max_load_age': 'soon'}, 'DOUBLE'),
    ({'max_load_age': 1e-4}, 'max_load_age must be 0 (loads do not age) or at least 0.001 s'),
    ({'force_bound': 'l3'}, "force_bound must be one of ['l1', 'l2', 'linf', 'finger']"),
    ({'contact_model': 'rubber'}, "contact_model must be one of ['FPC', 'PCWF', 'SFCE']"),
    ({'task_wrench': [0.0] * 6}, 'task_wrench must not be zero'),
    ({'task_wrench': [1.0] * 5}, 'task_wrench must have shape (6)'),
    ({'task_wrench': [math.nan] * 6}, 'task_wrench must be finite'),
    ({'max_request_size': 0}, 'out of range'),
    ({'contact_names': ['a']}, 'read-only'), ({'contact_fingers': ['a']}, 'read-only'),
    ({'contact_source': 'contact_array'}, 'read-only'), ({'autostart': False}, 'read-only')])
def test_a_bad_value_is_refused_with_a_reason_and_changes_nothing(client, alpha, changes, words):
    name, = changes
    before = client.call(GetParameters, 'get_parameters', names=[name]).values
    result, = change(client, **changes)
    assert not result.successful and words in result.reason
    assert client.call(GetParameters, 'get_parameters', names=[name]).values == before
    alpha(10.0)


def test_a_parameter_of_an_unknown_type_is_refused_and_its_client_answered(client, alpha):
    unknown = ParameterMessage(name='friction_coefficient', value=ParameterValue(type=77))
    answer = client.call(SetParameters, 'set_parameters', parameters=[
        *messages({'friction_coefficient': 0.5}), unknown, unknown])
    assert [result.successful for result in answer.results] == [True, False, False]
    assert '77' in answer.results[1].reason
    result = client.call(SetParametersAtomically, 'set_parameters_atomically',
                         parameters=[unknown]).result
    assert not result.successful and '77' in result.reason
    alpha(10.0)


def test_an_unknown_name_is_refused_by_name(client, alpha):
    changes = messages({'friction_coefficient': 0.5, 'friction_coeficient': 1.0, '': 1.0})
    answer = client.call(SetParameters, 'set_parameters', parameters=changes)
    assert [result.successful for result in answer.results] == [True, False, False]
    assert "['friction_coeficient']" in answer.results[1].reason
    result = client.call(
        SetParametersAtomically, 'set_parameters_atomically', parameters=changes).result
    assert not result.successful and "['friction_coeficient', '']" in result.reason
    alpha(10.0)


def test_together_means_all_or_nothing(client, alpha, restored):
    def together(**changes):
        return client.call(SetParametersAtomically, 'set_parameters_atomically',
                           parameters=messages(changes)).result

    assert not together(friction_coefficient=1.0, force_bound='l3').successful
    alpha(10.0)
    assert together(friction_coefficient=1.0, force_bound='l1').successful
    alpha(10.0)
    assert together(friction_coefficient=2.0, force_bound='l1').successful
    alpha(20.0)

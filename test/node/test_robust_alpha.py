# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Alpha under uncertainty: the service and the quantile of the live loop, by closed forms."""

import math
from statistics import NormalDist

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ResultCode
from grasp_quality_msgs.srv import RobustAlpha
from grasps import ANTIPODAL, contact_array, pose_array, SINGLE, SOLVER, wrench
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

LEVEL = 0.05
ALONG_Y = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]
# 20 min(mu_1, mu_2) at mu = 0.5 +- 0.05: P(min > x) = (1 - Phi)^2
TRUE_QUANTILE = 20.0 * (0.5 + 0.05 * NormalDist().inv_cdf(1.0 - math.sqrt(1.0 - LEVEL)))


@pytest.fixture(scope='module')
def client(start):
    return start(max_contact_age='2.0', task_wrench=str(ALONG_Y), solver_time_limit='10.0').client


@pytest.fixture(scope='module')
def feed(client):
    publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    return lambda: publisher.publish(pose_array(ANTIPODAL, client.now()))


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client)


def change(client, **changes):
    parameters = [Parameter(name, value=v).to_parameter_msg() for name, v in changes.items()]
    return client.call(SetParameters, 'set_parameters', parameters=parameters).results


@pytest.fixture
def uncertain(client):
    """Switch the quantile on, and off again behind the test."""
    def switch(**changes):
        assert all(r.successful for r in change(client, **changes)), changes
    yield switch
    switch(quantile_samples=0, quantile_level=LEVEL, contact_noise=0.0, normal_noise=0.0,
           friction_noise=0.0, load_noise=[0.0] * 6, max_contact_age=2.0, task_wrench=ALONG_Y)


def ask(client, poses=ANTIPODAL, **fields):
    return client.call(RobustAlpha, 'robust_alpha', contacts=contact_array(poses),
                       **{'task_wrench': wrench(fy=1.0), **fields})


def test_the_service_finds_the_closed_form_of_the_quantile(client):
    answer = ask(client, friction_noise=0.05, samples=4000, seed=1)
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.alpha_quantile_lower <= answer.alpha_quantile <= answer.alpha_quantile_upper
    # 4,000 samples: half a standard error of the quantile is 0.01
    assert answer.alpha_quantile == pytest.approx(TRUE_QUANTILE, abs=0.15)
    width = answer.alpha_quantile_upper - answer.alpha_quantile_lower
    assert abs(TRUE_QUANTILE - answer.alpha_quantile) <= width < 0.3
    assert (answer.probability, answer.probability_upper) == (1.0, 1.0)
    assert 0.99 < answer.probability_lower < 1.0
    assert answer.samples_used == 4000
    assert (answer.samples_infeasible, answer.samples_unproved) == (0, 0)


def test_without_noise_the_quantile_is_alpha(client):
    answer = ask(client)
    for value in (
            answer.alpha_quantile, answer.alpha_quantile_lower, answer.alpha_quantile_upper):
        assert value == pytest.approx(10.0, rel=SOLVER)
    assert answer.samples_used == 1000


def test_the_probability_is_that_of_friction_that_suffices(client):
    """The task of 10 N needs both mu >= 0.5: a quarter of the samples."""
    answer = ask(client, task_wrench=wrench(fy=10.0), friction_noise=0.05, samples=2000)
    assert answer.probability_lower <= 0.25 + 0.02 and answer.probability_upper >= 0.25 - 0.02
    assert answer.probability == pytest.approx(0.25, abs=0.05)


def test_a_seed_decides_the_answer(client):
    first, again, other = (ask(client, friction_noise=0.05, samples=100, quantile=0.5, seed=seed)
                           for seed in (3, 3, 4))
    assert first.alpha_quantile == again.alpha_quantile != other.alpha_quantile


def test_infeasible_samples_count_as_zero(client):
    """One finger pushes 10 N, the load pulls 10 N give or take; some samples cannot hold it."""
    answer = ask(client, SINGLE, task_wrench=wrench(fx=1.0), external_wrench=wrench(fx=-10.0),
                 load_noise=wrench(fx=1.0), samples=400)
    assert answer.result.code == ResultCode.OPTIMAL
    assert 100 < answer.samples_infeasible < 300 and answer.alpha_quantile == 0.0


def test_when_nothing_is_feasible_the_answer_is_infeasible_and_zero(client):
    answer = ask(client, external_wrench=wrench(fz=-15.0), friction_noise=0.01)
    assert answer.result.code == ResultCode.INFEASIBLE
    assert 'none of the 1000 samples' in answer.result.message
    assert answer == RobustAlpha.Response(result=answer.result, solve_time=answer.solve_time)


@pytest.mark.parametrize('fields, words', [
    ({'task_wrench': wrench()}, 'task_wrench must not be zero'),
    ({'friction_noise': math.nan}, 'friction_noise must be finite'),
    ({'friction_noise': -0.1}, 'friction_noise must be finite, at least 0'),
    ({'contact_noise': 5.0}, 'contact_noise [m] must be finite, at least 0 and at most 1'),
    ({'normal_noise': 45.0}, 'normal_noise [rad]'),
    ({'load_noise': wrench(fx=math.inf)}, 'load_noise must be finite'),
    ({'samples': 5000}, 'samples must be at most 4096 (parameter max_request_size)'),
    ({'samples': 10, 'quantile': 0.9}, 'samples must be at least 36'),
    ({'quantile': 1.0}, 'quantile must be less than 1'),
    ({'quantile': math.nan}, 'quantile must be finite')])
def test_a_broken_rule_is_named(client, fields, words):
    answer = ask(client, **fields)
    assert answer.result.code == ResultCode.INVALID_REQUEST and words in answer.result.message
    assert answer == RobustAlpha.Response(result=answer.result, solve_time=answer.solve_time)


def test_the_live_quantile_is_off_by_default(outputs, feed):
    quality = outputs.answer(feed).quality
    assert not quality.quantile_computed
    assert (quality.alpha_quantile, quality.alpha_quantile_lower) == (0.0, 0.0)


def test_the_live_quantile_follows_its_parameters(client, outputs, feed, uncertain):
    uncertain(quantile_samples=100, friction_noise=0.05)
    first, again = (outputs.answer(feed, lambda q: q.quantile_computed).quality for _ in range(2))
    assert first.alpha == pytest.approx(10.0, rel=SOLVER)
    assert 0.0 < first.alpha_quantile_lower <= first.alpha_quantile < first.alpha
    assert first.alpha_quantile == again.alpha_quantile  # the grasp did not change
    asked = ask(client, friction_noise=0.05, samples=100)
    assert first.alpha_quantile == pytest.approx(asked.alpha_quantile, rel=SOLVER)
    uncertain(friction_noise=0.0)
    quality = outputs.answer(
        feed, lambda q: q.quantile_computed and q.alpha_quantile > first.alpha_quantile).quality
    assert quality.alpha_quantile == pytest.approx(10.0, rel=SOLVER)


def test_a_load_that_may_be_too_much_has_the_quantile_zero(outputs, feed, uncertain):
    uncertain(quantile_samples=100, load_noise=[0.0, 0.0, 20.0, 0.0, 0.0, 0.0])
    quality = outputs.answer(feed, lambda q: q.quantile_computed).quality
    assert quality.alpha > 0.0 and quality.alpha_quantile == 0.0


def test_a_quantile_that_takes_too_long_costs_neither_alpha_nor_forces(outputs, feed, uncertain):
    uncertain(quantile_samples=1_000_000, friction_noise=0.05, max_contact_age=0.5)
    found = outputs.answer(feed, lambda q: 'alpha_quantile was not computed' in q.result.message)
    quality = found.quality
    assert 'time limit' in quality.result.message
    assert quality.alpha == pytest.approx(10.0, rel=SOLVER) and len(found.forces.forces) == 2
    assert not quality.quantile_computed
    assert (quality.alpha_quantile, quality.alpha_quantile_lower) == (0.0, 0.0)
    age = quality.contact_age
    assert age.sec + 1e-9 * age.nanosec <= 0.5


@pytest.mark.parametrize('changes, words', [
    ({'quantile_level': 0.0}, 'quantile_level must be between 0 and 1'),
    ({'quantile_samples': -1}, 'out of range'), ({'contact_noise': 3.0}, 'out of range'),
    ({'normal_noise': -0.1}, 'out of range'), ({'friction_noise': math.nan}, 'out of range'),
    ({'load_noise': [1.0] * 5}, 'load_noise [N, N m] must be a number or 6 numbers'),
    ({'load_noise': [-1.0] * 6}, 'load_noise [N, N m] must be finite, at least 0'),
    ({'quantile_samples': 1}, 'quantile_samples must be 0 (off) or at least 2')])
def test_a_bad_parameter_is_refused(client, changes, words):
    result, = change(client, **changes)
    assert not result.successful and words in result.reason

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Noise of requests as arguments of robust_alpha, and its answer as a message."""

from adapter_messages import BAD_NUMBERS, wrench
from grasp_quality import Contact, Grasp, robust_alpha, TaskWrench
from grasp_quality_msgs.msg import ResultCode
from grasp_quality_msgs.srv import RobustAlpha
from msg_adapters.errors import InvalidMessageError
from msg_adapters.uncertainty import fill_robust_alpha, noise_from, sampling_from
import pytest

PAIR = Grasp([Contact((-1, 0, 0), (1, 0, 0)), Contact((1, 0, 0), (-1, 0, 0))])
ALONG_Y = TaskWrench([0, 1, 0, 0, 0, 0])


def test_every_noise_reaches_the_argument_of_its_name():
    noise = noise_from(RobustAlpha.Request(
        contact_noise=0.001, normal_noise=0.02, friction_noise=0.3,
        load_noise=wrench(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)))
    assert noise['load_noise'].tolist() == [1, 2, 3, 4, 5, 6]
    assert (noise['contact_noise'], noise['normal_noise'], noise['friction_noise']) == (
        0.001, 0.02, 0.3)


@pytest.mark.parametrize('name', ['contact_noise', 'normal_noise', 'friction_noise'])
@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_noise_that_is_no_number_is_refused_by_name(name, value):
    with pytest.raises(InvalidMessageError, match=f'^{name} must be finite'):
        noise_from(RobustAlpha.Request(**{name: value}))


@pytest.mark.parametrize('value', BAD_NUMBERS)
def test_a_load_noise_or_quantile_that_is_no_number_is_refused_by_name(value):
    with pytest.raises(InvalidMessageError, match='^load_noise must be finite'):
        noise_from(RobustAlpha.Request(load_noise=wrench(tz=value)))
    with pytest.raises(InvalidMessageError, match='^quantile must be finite'):
        sampling_from(RobustAlpha.Request(quantile=value), 0.1, 9)


def test_zero_stands_for_the_defaults():
    asked = RobustAlpha.Request()
    assert sampling_from(asked, 0.1, 4096) == {'samples': 1000, 'quantile': 0.1, 'seed': 0}
    assert sampling_from(asked, 0.1, 20)['samples'] == 20
    asked = RobustAlpha.Request(samples=30, quantile=0.5, seed=2 ** 64 - 1)
    assert sampling_from(asked, 0.1, 30) == {
        'samples': 30, 'quantile': 0.5, 'seed': 2 ** 64 - 1}


def test_too_many_samples_are_refused():
    with pytest.raises(InvalidMessageError, match=(
            r'^samples must be at most 29 \(parameter max_request_size\), got 30$')):
        sampling_from(RobustAlpha.Request(samples=30), 0.1, 29)


def test_an_answer_fills_its_fields():
    answer = robust_alpha(PAIR, ALONG_Y, friction_noise=0.05, samples=50, quantile=0.2)
    message = RobustAlpha.Response()
    fill_robust_alpha(message, answer)
    assert message.result.code == ResultCode.OPTIMAL and not message.result.message
    assert message.alpha_quantile == answer.quantile
    assert (message.alpha_quantile_lower, message.alpha_quantile_upper) == (
        answer.quantile_lower, answer.quantile_upper)
    assert (message.probability, message.probability_lower, message.probability_upper) == (
        answer.probability, answer.probability_lower, answer.probability_upper)
    assert (message.samples_used, message.samples_infeasible, message.samples_unproved) == (
        50, 0, 0)


def test_without_a_feasible_sample_there_is_nothing_but_the_code():
    answer = robust_alpha(PAIR, ALONG_Y, [0, 0, -9, 0, 0, 0], samples=5)
    message = RobustAlpha.Response()
    fill_robust_alpha(message, answer)
    assert message.result.code == ResultCode.INFEASIBLE
    assert 'none of the 5 samples' in message.result.message
    assert message == RobustAlpha.Response(result=message.result)

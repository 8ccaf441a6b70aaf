# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Uncertainty: noise of requests to arguments of robust_alpha, and its answer to messages."""

from __future__ import annotations

from typing import Any, TypedDict

from grasp_quality.robust import RobustAlpha as Answer
from grasp_quality.status import Status
from grasp_quality_msgs.srv import RobustAlpha
from msg_adapters.errors import InvalidMessageError
from msg_adapters.number_checks import checked_numbers
from msg_adapters.results import status_result
from msg_adapters.wrenches import wrench_array
import numpy as np
from numpy.typing import NDArray

SAMPLES = 1000  # when the request leaves it open


class Noise(TypedDict):
    """Arguments of robust_alpha that say what is not known exactly."""

    contact_noise: float
    normal_noise: float
    friction_noise: float
    load_noise: NDArray[np.float64]


def noise_from(request: RobustAlpha.Request) -> Noise:
    """
    Read the standard deviations of a RobustAlpha request.

    Raises
    ------
    InvalidMessageError

    """
    def number(name: str) -> float:
        value, = checked_numbers((getattr(request, name),), name)
        return float(value)

    return Noise(
        contact_noise=number('contact_noise'), normal_noise=number('normal_noise'),
        friction_noise=number('friction_noise'),
        load_noise=wrench_array(request.load_noise, 'load_noise'))


def sampling_from(request: RobustAlpha.Request, level: float, limit: int) -> dict[str, Any]:
    """
    Read samples, quantile and seed of a request.

    Parameters
    ----------
    request : RobustAlpha.Request
        0 samples stand for ``SAMPLES``, the quantile 0 for ``level``.
    level : float
        Quantile where the request names none.
    limit : int
        Parameter max_request_size.

    Raises
    ------
    InvalidMessageError

    """
    samples = int(request.samples) or min(SAMPLES, limit)
    if samples > limit:
        raise InvalidMessageError(
            f'samples must be at most {limit} (parameter max_request_size), got {samples}')
    quantile, = checked_numbers((request.quantile,), 'quantile')
    return {'samples': samples, 'quantile': quantile or level, 'seed': int(request.seed)}


def fill_robust_alpha(response: RobustAlpha.Response, answer: Answer) -> None:
    """Write an answer of robust_alpha, asked for one quantile, into a response."""
    count = len(answer.alpha)
    if answer.infeasible == count:
        response.result = status_result(Status.INFEASIBLE, (
            f'none of the {count} samples has contact forces that balance its external wrench'))
        return
    response.result = status_result(Status.OPTIMAL)
    response.alpha_quantile = answer.quantile
    response.alpha_quantile_lower = answer.quantile_lower
    response.alpha_quantile_upper = answer.quantile_upper
    response.probability = answer.probability
    response.probability_lower = answer.probability_lower
    response.probability_upper = answer.probability_upper
    response.samples_used = count
    response.samples_infeasible = answer.infeasible
    response.samples_unproved = answer.unproved

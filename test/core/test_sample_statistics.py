# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Intervals of quantiles and probabilities: textbook values, and how often they hold the truth."""

import math
from statistics import NormalDist

from grasp_quality import InvalidTaskError
from grasp_quality.sample_statistics import (
    fewest_samples, quantile_interval, wilson_interval)
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def binomial_tail(count, share, least):
    """Return P(at least ``least`` of count), summed term by term in exact integers."""
    return sum(math.comb(count, i) * share ** i * (1.0 - share) ** (count - i)
               for i in range(least, count + 1))


@pytest.mark.parametrize('count, level, confidence', [
    (10, 0.5, 0.95), (100, 0.05, 0.95), (100, 0.5, 0.9), (500, 0.01, 0.99), (40, 0.9, 0.8)])
def test_the_interval_is_the_narrowest_with_both_tails_small_enough(count, level, confidence):
    """Samples 1 ... n tell which order statistics were taken."""
    ordered = np.arange(1.0, count + 1.0)
    value, lower, upper = quantile_interval(ordered, level, confidence)
    tail = 0.5 * (1.0 - confidence)
    assert value == math.ceil(count * level - CLOSED_FORM)
    # the lower end is above the quantile when fewer than that many samples are below it
    assert 1.0 - binomial_tail(count, level, int(lower)) <= tail
    assert 1.0 - binomial_tail(count, level, int(lower) + 1) > tail
    assert binomial_tail(count, level, int(upper)) <= tail
    assert binomial_tail(count, level, int(upper) - 1) > tail


def test_the_median_of_ten_lies_between_the_second_and_the_ninth():
    """A value of the tables for the sign test: P(2nd < median < 9th) = 0.9785."""
    assert quantile_interval(np.arange(1.0, 11.0), 0.5, 0.95)[1:] == (2.0, 9.0)


@pytest.mark.parametrize('level', [0.05, 0.5, 0.9])
def test_the_interval_holds_the_true_quantile_as_often_as_it_says(level):
    """1,000 samples of 200 exponentials: -log(1 - q) inside 95 % of them, and not far more."""
    rng, truth = np.random.default_rng(7), -math.log1p(-level)
    inside = 0
    for _ in range(1000):
        _, lower, upper = quantile_interval(np.sort(rng.exponential(size=200)), level, 0.95)
        inside += lower <= truth <= upper
    assert 0.93 <= inside / 1000 <= 0.99


def test_too_few_samples_have_no_lower_end_but_zero_and_no_upper_end_at_all():
    assert fewest_samples(0.05, 0.95) == 2
    assert quantile_interval(np.array([1.0, 2.0]), 0.05, 0.95) == (1.0, 0.0, 2.0)
    fewest = fewest_samples(0.99, 0.95)
    assert 0.99 ** fewest <= 0.025 < 0.99 ** (fewest - 1)
    with pytest.raises(InvalidTaskError, match=f'samples must be at least {fewest} .* got 20'):
        quantile_interval(np.arange(20.0), 0.99, 0.95)


def test_equal_samples_have_an_interval_without_width():
    assert quantile_interval(np.full(100, 2.5), 0.05, 0.95) == (2.5, 2.5, 2.5)


def test_more_samples_narrow_the_interval():
    ordered = [np.linspace(0.0, 1.0, count) for count in (100, 1000, 10_000)]
    widths = [upper - lower for _, lower, upper in (
        quantile_interval(samples, 0.1, 0.95) for samples in ordered)]
    assert widths[0] > 2.0 * widths[1] > 4.0 * widths[2]


@pytest.mark.parametrize('successes', [0, 1, 30, 99, 100])
def test_wilson_solves_its_equation(successes):
    """Both ends are where |share - p| = z sqrt(p (1 - p) / n)."""
    count, confidence = 100, 0.95
    z = NormalDist().inv_cdf(0.975)
    share, lower, upper = wilson_interval(successes, count, confidence)
    assert share == successes / count and lower <= share <= upper
    for p in (lower, upper):
        assert (share - p) ** 2 == pytest.approx(z * z * p * (1.0 - p) / count, abs=CLOSED_FORM)
    assert (lower == 0.0) == (successes == 0) and (upper == 1.0) == (successes == count)


def test_wilson_does_not_believe_in_certainty():
    """With no failure among n the lower end is 1 / (1 + z^2 / n)."""
    z = NormalDist().inv_cdf(0.975)
    assert wilson_interval(50, 50, 0.95)[1] == pytest.approx(1.0 / (1.0 + z * z / 50))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a finite sample says about a distribution: quantiles and probabilities with their intervals.

No shape of the distribution is assumed. The interval of a quantile is made of two order
statistics: how many of n samples fall below the true q-quantile is binomial, whatever the
distribution, so that its tails say between which of the sorted samples the quantile lies. Ties
(all that is infeasible has alpha 0) only make it wider than it has to be. The interval of a
probability is Wilson's, which stays inside [0, 1] and does not shrink to nothing when all samples
agree.
"""

import math
from statistics import NormalDist

from grasp_quality.exceptions import InvalidTaskError
import numpy as np
from numpy.typing import NDArray

LOWEST = 0.0  # of what is sampled here: alpha is never negative


def fewest_samples(level: float, confidence: float) -> int:
    """
    Count the samples from which on a quantile has an upper bound.

    The largest of n samples is above the q-quantile with probability 1 - q^n, which has to leave
    no more than the upper tail. Downwards there always is a bound: alpha is at least 0.

    """
    return max(1, math.ceil(math.log(0.5 * (1.0 - confidence)) / math.log(level)))


def quantile_interval(ordered: NDArray[np.float64], level: float,
                      confidence: float) -> tuple[float, float, float]:
    """
    Estimate a quantile from order statistics.

    Parameters
    ----------
    ordered : (n,) array
        Samples in ascending order, none below 0.
    level : float
        q in (0, 1).
    confidence : float
        Probability, in (0, 1), with which the interval shall hold the true quantile.

    Returns
    -------
    (quantile, lower, upper): the smallest sample that at least a share q of all does not exceed,
    and the order statistics on both sides of it; lower is 0 where the samples are too few for one.

    Raises
    ------
    InvalidTaskError
        When the samples are too few for an upper bound.

    """
    count = len(ordered)
    fewest = fewest_samples(level, confidence)
    if count < fewest:
        raise InvalidTaskError(
            f'samples must be at least {fewest} for an upper bound of the {level:g} quantile at '
            f'confidence {confidence:g}, got {count}: take more samples or a lower quantile')
    tail = 0.5 * (1.0 - confidence)
    below = _binomial_distribution(count, level)
    first = int(np.searchsorted(below, tail))  # 1-based order statistics
    last = min(int(np.searchsorted(below, 1.0 - tail)) + 1, count)
    rank = min(max(math.ceil(count * level), 1), count)
    lower = float(ordered[first - 1]) if first >= 1 else LOWEST
    return float(ordered[rank - 1]), lower, float(ordered[last - 1])


def _binomial_distribution(count: int, share: float) -> NDArray[np.float64]:
    """P(at most i of count) for i = 0 ... count - 1 (count,), each with probability share."""
    i = np.arange(count - 1)
    odds = math.log(share) - math.log1p(-share)
    ratios = np.log((count - i) / (i + 1.0)) + odds  # of one term to the next
    first = count * math.log1p(-share)
    distribution: NDArray[np.float64] = np.cumsum(
        np.exp(first + np.concatenate([[0.0], np.cumsum(ratios)])))
    return distribution


def wilson_interval(successes: int, count: int, confidence: float) -> tuple[float, float, float]:
    """
    Estimate a probability: (share, lower, upper) of ``successes`` out of ``count`` samples.

    Wilson's score interval: all p that a test of the binomial share, with the variance of p
    itself, does not reject.

    """
    z = NormalDist().inv_cdf(0.5 * (1.0 + confidence))
    share, weight = successes / count, z * z / count
    middle = (share + 0.5 * weight) / (1.0 + weight)
    half = z / (1.0 + weight) * math.sqrt(
        share * (1.0 - share) / count + 0.25 * weight / count)
    # at both ends the exact value, which rounding would miss
    lower = 0.0 if successes == 0 else max(0.0, middle - half)
    upper = 1.0 if successes == count else min(1.0, middle + half)
    return share, lower, upper

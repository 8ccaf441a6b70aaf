# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Curves of any length take a fixed amount of memory and lose no peak."""

from grasp_quality_cli.bag_trace import BINS, Trace
from hypothesis import given, settings, strategies
import numpy as np
import pytest


@pytest.mark.parametrize('count', [0, 1, BINS, BINS + 1, 7 * BINS + 3])
@settings(deadline=None, max_examples=20)
@given(seed=strategies.integers(0, 1000))
def test_bins_span_all_samples(count, seed):
    values = np.random.default_rng(seed).normal(size=count)
    trace = Trace()
    for i, value in enumerate(values):
        trace.add(i, value)
    assert len(trace.bins) <= BINS
    assert sum(b[4] for b in trace.bins) == count
    position = 0
    for first, last, least, largest, number in trace.bins:
        inside = values[position:position + number]
        assert (first, last) == (position, position + number - 1)
        assert (least, largest) == (inside.min(), inside.max())
        position += number

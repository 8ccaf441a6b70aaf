# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays that enter the library: checked, copied, read-only."""

from grasp_quality.arrays import checked, checked_number
from grasp_quality.exceptions import InvalidTaskError
import numpy as np
import pytest


def test_checked_copies_and_freezes():
    given = np.ones(3)
    taken = checked(given, (3,), 'name', InvalidTaskError)
    given[0] = 5.0
    assert taken.tolist() == [1.0, 1.0, 1.0] and taken.dtype == np.float64
    with pytest.raises(ValueError, match='read-only'):
        taken[0] = 2.0


@pytest.mark.parametrize('value, message', [
    ('abc', r'name must be an array of \(3\) numbers'),
    ([1.0, 2.0], r'name must have shape \(3\), got \(2,\)'),
    ([[1.0, 2.0, 3.0]], r'name must have shape \(3\)'),
    ([1.0, np.nan, 2.0], 'name must be finite'),
    ([1.0, np.inf, 2.0], 'name must be finite'),
    ([[1.0], [1.0, 2.0], [3.0]], 'name must be an array'),
    (None, 'name must'),
])
def test_checked_names_the_rule(value, message):
    with pytest.raises(InvalidTaskError, match=message):
        checked(value, (3,), 'name', InvalidTaskError)


def test_checked_any_length():
    assert checked(np.ones((7, 6)), (None, 6), 'name', InvalidTaskError).shape == (7, 6)
    with pytest.raises(InvalidTaskError, match=r'name must have shape \(n, 6\)'):
        checked(np.ones((7, 5)), (None, 6), 'name', InvalidTaskError)


@pytest.mark.parametrize('value, limits, message', [
    ('x', {}, 'name must be a number'),
    (None, {}, 'name must be a number'),
    (np.nan, {}, 'name must be finite'),
    (-1.0, {'minimum': 0.0}, 'name must be at least 0, got -1'),
    (0.0, {'above': 0.0}, 'name must be greater than 0, got 0'),
    (2.0, {'below': 2.0}, 'name must be less than 2, got 2'),
])
def test_checked_number_names_the_rule(value, limits, message):
    with pytest.raises(InvalidTaskError, match=message):
        checked_number(value, 'name', InvalidTaskError, **limits)


def test_checked_number_takes_its_limits():
    assert checked_number(0, 'name', InvalidTaskError, minimum=0.0) == 0.0
    assert isinstance(checked_number(np.float32(1.5), 'name', InvalidTaskError), float)

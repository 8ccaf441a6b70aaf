# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays that enter the library: checked, copied, read-only."""

from decimal import Decimal
from fractions import Fraction
import warnings

from grasp_quality.arrays import checked, checked_number
from grasp_quality.exceptions import InvalidTaskError
import numpy as np
import pytest

MASKED = np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False])


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


@pytest.mark.parametrize('value', [
    np.array([1.0, 2.0 + 3.0j, 0.0]), [1.0, 2.0 + 3.0j, 0.0], np.array([1.0, 2.0 + 3.0j, 10**30]),
    np.array([1.0, 2.0 + 3.0j, 0.0], np.complex64), [np.complex64(2.0 + 3.0j), 10**30, 0]])
def test_imaginary_parts_are_not_dropped(value):
    with pytest.raises(InvalidTaskError, match=r'name must be real, got \(2\+3j\): .*\.real'):
        checked(value, (3,), 'name', InvalidTaskError)


@pytest.mark.parametrize('value', [
    MASKED, [1.0, np.ma.masked, 3.0], [MASKED, [1.0, 2.0, 3.0]], ([[1.0]], (MASKED,))])
def test_masked_entries_are_not_taken_for_numbers(value):
    with pytest.raises(InvalidTaskError, match='name must have no masked .* got 1 of .*leave'):
        checked(value, (3,), 'name', InvalidTaskError)


@pytest.mark.parametrize('value', [
    np.array([1.0, 2.0, 3.0], complex), [1, 2.0, 3.0 + 0.0j], np.ma.array([1.0, 2.0, 3.0]),
    [np.float32(1.0), Fraction(2), Decimal(3)], np.array([1, 2, 3], object), ['1', '2', '3']])
def test_what_loses_nothing_as_a_float_is_taken(value):
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        assert checked(value, (3,), 'name', InvalidTaskError).tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize('value, message', [
    (2.0 + 1.0j, r'name must be real, got \(2\+1j\)'),
    (np.complex64(2.0 + 1.0j), r'name must be real, got \(2\+1j\)'),
    (np.ma.masked, 'name must have no masked entries'),
    (MASKED[1:2], 'name must have no masked entries'), ([2.0], 'name must be a number'),
    (np.array([2.0]), 'name must be a number'), (10**400, 'name must be a number')])
def test_a_number_loses_nothing_either(value, message):
    with pytest.raises(InvalidTaskError, match=message):
        checked_number(value, 'name', InvalidTaskError)


@pytest.mark.parametrize('value', [2, np.float32(2.0), np.array(2), 2.0 + 0.0j, Fraction(2)])
def test_one_number_of_any_kind(value):
    assert checked_number(value, 'name', InvalidTaskError) == 2.0

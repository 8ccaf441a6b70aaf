# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of messages: finite, of a size that can be computed with."""

import math

from adapter_messages import any_float
from hypothesis import given, strategies
from msg_adapters.errors import InvalidMessageError
from msg_adapters.number_checks import checked_numbers, LARGEST
import pytest


@given(strategies.lists(any_float, max_size=6))
def test_passes_finite_numbers_and_nothing_else(values):
    usable = all(math.isfinite(v) and abs(v) <= LARGEST for v in values)
    try:
        assert checked_numbers(values, 'numbers') == tuple(values)
        assert usable
    except InvalidMessageError:
        assert not usable


def test_whole_numbers_become_floats():
    numbers = checked_numbers([1, True], 'numbers')
    assert numbers == (1.0, 1.0) and all(type(n) is float for n in numbers)


def test_the_error_names_field_value_and_rule():
    with pytest.raises(InvalidMessageError, match=(
            r'^load\.z must be finite and at most 1e\+12 .*\[0\.0, nan\]$')):
        checked_numbers((0.0, math.nan), 'load.z')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Numbers of messages: finite, and of a size that can be computed with.

Nothing between the sun and an atom is excluded; beyond that products overflow, and an answer would
no longer be a number.
"""

from collections.abc import Iterable
from typing import SupportsFloat

from msg_adapters.errors import InvalidMessageError

LARGEST = 1e12    # of any number in a message, SI units
SMALLEST = 1e-12  # of a force or wrench that is not zero


def checked_numbers(values: Iterable[SupportsFloat], name: str) -> tuple[float, ...]:
    """
    Return numbers of a message as a tuple of floats.

    Raises
    ------
    InvalidMessageError
        When one is not finite, or larger than ``LARGEST``.

    """
    numbers = tuple(float(v) for v in values)
    for number in numbers:
        if not abs(number) <= LARGEST:  # catches nan and inf too
            raise InvalidMessageError(
                f'{name} must be finite and at most {LARGEST:g} in size, got {list(numbers)}')
    return numbers

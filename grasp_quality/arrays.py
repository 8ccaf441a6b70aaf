# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Checked, read-only float64 arrays: how every number enters the library."""

from __future__ import annotations

from typing import SupportsFloat, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Scalar = TypeVar('Scalar', bound=np.generic)
Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
Codes = NDArray[np.int8]

# of any force, torque, coefficient: products of three of them are still numbers
SMALLEST, LARGEST = 1e-50, 1e50
NO_LENGTH = 1e-12  # [m], below an atom: torques over it would be numbers without end
ANY = float(np.finfo(float).max)


def checked(value: ArrayLike, shape: tuple[int | None, ...], name: str,
            error: type[ValueError], largest: float = LARGEST) -> Array:
    """
    Copy a value into a finite, read-only float64 array of the given shape.

    Parameters
    ----------
    value : array_like
        What the caller gave; it is left as it is.
    shape : tuple of int or None
        Expected shape; None stands for any length of that axis.
    name : str
        What the value is called in the error message.
    error : type
        Exception class, a ValueError.
    largest : float
        Of any number, in size.

    Raises
    ------
    error
        When the value is not numeric, has another shape, or is not finite or too large.

    """
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as exc:
        raise error(f'{name} must be an array of {_words(shape)} numbers, got {value!r}') from exc
    fits = array.ndim == len(shape) and all(
        want is None or want == have for want, have in zip(shape, array.shape))
    if not fits:
        raise error(f'{name} must have shape {_words(shape)}, got {array.shape}: {value!r}')
    if not (np.abs(array) <= largest).all():  # nan is not either
        raise error(
            f'{name} must be finite and at most {largest:g} in size, got {array.tolist()}')
    array.flags.writeable = False
    return array


def checked_number(value: SupportsFloat, name: str, error: type[ValueError],
                   minimum: float | None = None, above: float | None = None,
                   below: float | None = None) -> float:
    """
    Return a float of computable size inside the stated range; raise ``error`` when it is not.

    ``minimum`` is inclusive, ``above`` and ``below`` are exclusive.

    """
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError) as exc:
        raise error(f'{name} must be a number, got {value!r}') from exc
    if not abs(number) <= LARGEST:  # nan is not either
        raise error(f'{name} must be finite and at most {LARGEST:g} in size, got {number}')
    if above is not None and number <= above:
        raise error(f'{name} must be greater than {above:g}, got {number:g}')
    if minimum is not None and number < minimum:
        raise error(f'{name} must be at least {minimum:g}, got {number:g}')
    if below is not None and number >= below:
        raise error(f'{name} must be less than {below:g}, got {number:g}')
    return number


def frozen(array: NDArray[Scalar]) -> NDArray[Scalar]:
    """Mark an array of our own as read-only and return it (no copy)."""
    array.flags.writeable = False
    return array


def _words(shape: tuple[int | None, ...]) -> str:
    return '(' + ', '.join('n' if n is None else str(n) for n in shape) + ')'

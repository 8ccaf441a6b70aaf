# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Checked, read-only float64 arrays: how every number enters the library."""

from __future__ import annotations

from typing import Any, SupportsFloat, TypeVar

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
PLAIN = {float, int}  # in lists of them nothing hides
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
        When the value is not numeric, complex, masked, has another shape, or is not finite or
        too large.

    """
    array = floats(value, name, f'an array of {_words(shape)} numbers', error)
    fits = array.ndim == len(shape) and all(
        want is None or want == have for want, have in zip(shape, array.shape))
    if not fits:
        raise error(f'{name} must have shape {_words(shape)}, got {array.shape}: {value!r}')
    if not (np.abs(array) <= largest).all():  # nan is not either
        raise error(
            f'{name} must be finite and at most {largest:g} in size, got {array.tolist()}')
    array.flags.writeable = False
    return array


def floats(value: object, name: str, kind: str, error: type[ValueError]) -> Array:
    """
    Copy numbers into a float64 array, of which numpy alone would drop imaginary parts and masks.

    Parameters
    ----------
    value : array_like or number
        What the caller gave; it is left as it is.
    name : str
        What the value is called in the error message.
    kind : str
        What it must be, in words.
    error : type
        Exception class, a ValueError.

    Raises
    ------
    error
        When the value is not numeric, has an imaginary part that is not zero, or masked entries.

    """
    masked = _masked_part(value)
    if masked is not None:
        count = int(np.ma.getmaskarray(masked).sum())
        raise error(f'{name} must have no masked entries, got {count} of {masked.size}: '
                    'give numbers for all (.filled), or leave them out')
    try:
        array = np.array(value)
        if array.dtype.kind == 'O':
            array = np.array([complex(x) for x in array.flat]).reshape(array.shape)
        if array.dtype.kind != 'c':
            return array.astype(np.float64, copy=False)
    except (TypeError, ValueError, OverflowError) as exc:
        raise error(f'{name} must be {kind}, got {value!r}') from exc
    if array.imag.any():  # nan is one too
        entry = array[array.imag != 0.0][0]
        raise error(f'{name} must be real, got {entry}: give the real part of it (.real) if that '
                    'is what is meant')
    return array.real.astype(np.float64)


def _single(value: SupportsFloat, name: str, error: type[ValueError]) -> float:
    """Return the one number of a value that is no plain one, such as numpy's."""
    array = floats(value, name, 'a number', error)
    if array.ndim:
        raise error(f'{name} must be a number, got {value!r}')
    return float(array)


def _masked_part(value: object) -> np.ma.MaskedArray[Any, Any] | None:
    """Return the first masked array with masked entries in nested lists; None if there is none."""
    if isinstance(value, np.ma.MaskedArray):
        return value if np.ma.is_masked(value) else None
    if isinstance(value, (list, tuple)) and not PLAIN.issuperset(map(type, value)):
        return next((part for part in map(_masked_part, value) if part is not None), None)
    return None


def checked_number(value: SupportsFloat, name: str, error: type[ValueError],
                   minimum: float | None = None, above: float | None = None,
                   below: float | None = None) -> float:
    """
    Return a float of computable size inside the stated range; raise ``error`` when it is not.

    ``minimum`` is inclusive, ``above`` and ``below`` are exclusive.

    """
    try:
        number = float(value) if isinstance(value, (float, int)) else _single(value, name, error)
    except OverflowError as exc:
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

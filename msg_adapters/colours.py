# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Colours of what is drawn, in RViz as in the browser, that colour-blind readers can tell apart.

Usage of a friction cone runs from blue over yellow to vermilion, three hues of Okabe and Ito that
differ in lightness too; alpha runs along viridis, whose lightness rises evenly.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

MEASURED = (0.0, 0.45, 0.70)       # blue
OPTIMAL = (0.84, 0.37, 0.0)        # vermilion
TASK = (0.80, 0.47, 0.65)          # reddish purple
LIMITING = (0.84, 0.37, 0.0)
UNKNOWN = (0.60, 0.60, 0.60)
USAGE = np.array([[0.34, 0.71, 0.91], [0.94, 0.89, 0.26], [0.84, 0.37, 0.0]])
USAGE_AT = np.array([0.0, 0.7, 1.0])
VIRIDIS = np.array([
    [0.267, 0.005, 0.329], [0.283, 0.141, 0.458], [0.254, 0.265, 0.530], [0.207, 0.372, 0.553],
    [0.164, 0.471, 0.558], [0.128, 0.567, 0.551], [0.135, 0.659, 0.518], [0.267, 0.749, 0.441],
    [0.478, 0.821, 0.318], [0.741, 0.873, 0.150], [0.993, 0.906, 0.144]])


def usage_colours(usage: ArrayLike) -> Array:
    """
    Colour shares of friction cones in use.

    Parameters
    ----------
    usage : (k,) array_like [-]
        0 on the axis, 1 about to slip; what lies beyond is coloured like the nearer end.

    Returns
    -------
    (k, 3) array: red, green, blue in [0, 1]

    """
    return _along(USAGE_AT, USAGE, np.asarray(usage, dtype=float))


def alpha_colours(alphas: ArrayLike) -> Array:
    """
    Colour the directions of a map, the darkest 0 and the brightest its largest alpha.

    Parameters
    ----------
    alphas : (N,) array_like [N]
        None of them negative.

    Returns
    -------
    (N, 3) array: red, green, blue in [0, 1]

    """
    values = np.asarray(alphas, dtype=float)
    largest = values.max(initial=0.0)
    shares = values / largest if largest > 0.0 else values
    return _along(np.linspace(0.0, 1.0, len(VIRIDIS)), VIRIDIS, shares)


def _along(positions: Array, stops: Array, values: Array) -> Array:
    return np.column_stack([np.interp(values, positions, stops[:, c]) for c in range(3)])

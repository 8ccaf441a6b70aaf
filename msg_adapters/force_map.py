# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Force maps: alphas over the grid of directions to and from the message ForceMap."""

import array

from grasp_quality_msgs.msg import ForceMap
from msg_adapters.errors import InvalidMessageError
from msg_adapters.marker_geometry import Array
import numpy as np
from std_msgs.msg import Header


def force_map(header: Header, resolution: int = 0, alphas: Array | None = None) -> ForceMap:
    """Build a ForceMap of alphas (2 r^2,) [N]; without them it says that there is none."""
    message = ForceMap(header=header, resolution=resolution)
    if alphas is not None:
        message.alphas = array.array('d', np.ascontiguousarray(alphas).tobytes())
    return message


def alphas_of(message: ForceMap) -> Array:
    """
    Read a ForceMap.

    Returns
    -------
    (2 r^2,) array [N], or (0,) when there is no map

    Raises
    ------
    InvalidMessageError

    """
    alphas = np.array(message.alphas, dtype=float)
    if len(alphas) not in (0, 2 * message.resolution ** 2):
        raise InvalidMessageError(
            f'alphas must be empty or hold 2 resolution^2 = {2 * message.resolution ** 2} '
            f'numbers, got {len(alphas)}')
    if not np.isfinite(alphas).all() or alphas.min(initial=0.0) < 0.0:
        raise InvalidMessageError('alphas must be finite and at least 0')
    return alphas

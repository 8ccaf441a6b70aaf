# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact frames of many normals at once, by the rule of ``contact.frame_from_normal``."""

from grasp_quality.exceptions import InvalidContactError
import numpy as np
from numpy.typing import NDArray


def frames_of_normals(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotations R_object_contact (n, 3, 3) of inward normals (n, 3), as ``Contact`` makes them."""
    largest = np.abs(normals).max(axis=1, keepdims=True)
    if (largest == 0.0).any():
        raise InvalidContactError(
            f'normals must not be zero, but row {int(np.flatnonzero(largest == 0.0)[0])} is')
    n = normals / largest
    n /= np.sqrt((n * n).sum(axis=1, keepdims=True))
    rows = np.arange(len(n))
    least = np.abs(n).argmin(axis=1)
    t1 = -n[rows, least][:, None] * n
    t1[rows, least] += 1.0
    t1 /= np.sqrt((t1 * t1).sum(axis=1, keepdims=True))
    rotations = np.empty((len(n), 3, 3))
    rotations[:, :, 0], rotations[:, :, 2] = t1, n
    rotations[:, 0, 1] = n[:, 1] * t1[:, 2] - n[:, 2] * t1[:, 1]
    rotations[:, 1, 1] = n[:, 2] * t1[:, 0] - n[:, 0] * t1[:, 2]
    rotations[:, 2, 1] = n[:, 0] * t1[:, 1] - n[:, 1] * t1[:, 0]
    return rotations

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The grid of forces around the unit ball."""

from grasp_quality import InvalidTaskError
from grasp_quality.directions import force_grid
import numpy as np
import pytest
from tolerances import EXACT


def test_grid_covers_the_ball_evenly():
    grid = force_grid(6)
    assert grid.shape == (72, 6) and not grid.flags.writeable
    assert np.linalg.norm(grid[:, :3], axis=1) == pytest.approx(np.ones(72), abs=EXACT)
    assert not grid[:, 3:].any()
    assert grid.sum(axis=0) == pytest.approx(np.zeros(6), abs=1e-10)
    assert len(np.unique(grid.round(9), axis=0)) == 72


@pytest.mark.parametrize('resolution', [0, -1, 1.5, '3', None])
def test_error_names_value_and_rule(resolution):
    with pytest.raises(InvalidTaskError, match='resolution must be a whole number >= 1'):
        force_grid(resolution)

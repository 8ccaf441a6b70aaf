# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A map in slices is the map at once."""

from grasp_quality import wrench_map
from grasp_quality.directions import force_grid
from grasp_quality.exceptions import SolverTimeoutError
from grasp_quality.sliced_map import LEAST_SLICE, SlicedMap
from known_grasps import three_finger
import numpy as np
import pytest
from tolerances import SOLVER

RESOLUTION = 6
LOAD = np.array([0.0, 0.0, -0.5, 0.0, 0.0, 0.0])


@pytest.mark.parametrize('load', [None, LOAD])
@pytest.mark.parametrize('budget_s', [1e-9, 1e3])
def test_slices_make_the_whole(load, budget_s):
    grasp = three_finger()
    sliced = SlicedMap(grasp, RESOLUTION, load)
    calls = 1
    while not sliced.advance(budget_s):
        calls += 1
    whole = wrench_map(grasp, force_grid(RESOLUTION), load).alpha
    np.testing.assert_allclose(sliced.alphas, whole, rtol=SOLVER, atol=SOLVER)
    assert sliced.complete and calls > 1


def test_a_short_budget_makes_small_slices_and_a_long_one_large_ones():
    hurried, idle = (SlicedMap(three_finger(), RESOLUTION) for _ in range(2))
    hurried.advance(1e-9)
    idle.advance(1e3)
    assert hurried.slice_size == LEAST_SLICE
    assert idle.slice_size == 2 * 32


def test_what_is_still_to_come_is_zero_and_a_copy_is_given():
    sliced = SlicedMap(three_finger(), RESOLUTION, slice_size=10)
    assert not sliced.advance(1.0)
    first = sliced.alphas
    assert (first[:10] > 0.0).all() and not first[10:].any()
    first[:] = -1.0
    assert (sliced.alphas >= 0.0).all()


def test_a_slice_has_a_time_limit():
    with pytest.raises(SolverTimeoutError):
        SlicedMap(three_finger(), RESOLUTION).advance(1.0, time_limit_s=1e-9)

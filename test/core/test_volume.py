# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The volume of the map: closed forms, laws, and random points against its ends."""

import dataclasses

from benchmarks.random_grasps import random_grasp
from grasp_quality import Grasp, InvalidTaskError, volume, wrench_map
from known_grasps import antipodal, single, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def double_cone(mu, bound):
    """Volume of the pure forces of an antipodal pair: x along it is n_1 - n_2, t <= 2 mu n_2."""
    x = np.linspace(0.0, 1.0, 200_001)
    press = {'linf': 1.0 - x, 'l1': 0.5 * (1.0 - x), 'l2': 0.5 * (np.sqrt(2.0 - x ** 2) - x)}
    return 2.0 * np.trapezoid(np.pi * (2.0 * mu * press[bound]) ** 2, x)


@pytest.mark.parametrize('bound', ['linf', 'l1', 'l2'])
@pytest.mark.parametrize('mu', [0.3, 0.5])
def test_antipodal_pair(bound, mu):
    found = volume(antipodal(mu, bound=bound))
    assert found.lower <= double_cone(mu, bound) <= found.upper
    assert found.reached and found.upper - found.lower <= 0.02 * found.upper


def test_the_double_cone_is_one():
    assert double_cone(0.5, 'linf') == pytest.approx(2.0 / 3.0 * np.pi, rel=CLOSED_FORM)


def test_one_contact_fills_its_cone():
    found = volume(single(0.5, cap=2.0))
    assert found.lower <= np.pi * 0.5 ** 2 * 2.0 ** 3 / 3.0 <= found.upper and found.reached


def test_a_flat_map_has_no_volume():
    found = volume(antipodal(0.5), subspace='torque')
    assert (found.lower, found.upper, found.reached, found.directions) == (0.0, 0.0, True, 0)


@pytest.mark.parametrize('subspace, rows', [('force', slice(0, 3)), ('torque', slice(3, 6))])
@pytest.mark.parametrize('seed', [2, 3])
def test_random_directions_agree(subspace, rows, seed):
    """The volume is 4 pi / 3 times the mean of alpha^3 over the sphere."""
    grasp = random_grasp(np.random.default_rng(seed), 5, 'linf')
    found = volume(grasp, subspace, relative_width=0.05)
    directions = np.random.default_rng(0).normal(size=(4000, 3))
    wrenches = np.zeros((4000, 6))
    wrenches[:, rows] = directions / np.linalg.norm(directions, axis=1)[:, None]
    cubes = 4.0 / 3.0 * np.pi * wrench_map(grasp, wrenches).alpha ** 3
    error = 5.0 * cubes.std() / np.sqrt(len(cubes))
    assert found.lower <= cubes.mean() + error and found.upper >= cubes.mean() - error
    assert found.reached


def test_twice_the_caps_are_eight_times_the_volume():
    grasp = three_finger()
    strong = Grasp([dataclasses.replace(c, normal=None, max_normal_force=2.0)
                    for c in grasp.contacts])
    found, more = volume(grasp), volume(strong)
    assert more.lower <= 8.0 * found.upper and more.upper >= 8.0 * found.lower


def test_a_narrower_interval_lies_in_the_wider_one():
    wide, narrow = (volume(three_finger(), relative_width=w) for w in (0.3, 0.03))
    assert wide.lower <= narrow.lower * (1.0 + CLOSED_FORM)
    assert narrow.upper <= wide.upper * (1.0 + CLOSED_FORM)
    assert wide.directions < narrow.directions


def test_out_of_time_is_an_honest_interval():
    found = volume(three_finger(), time_limit_s=1e-9)
    assert not found.reached and found.lower == 0.0
    assert volume(three_finger()).upper <= found.upper < np.inf


@pytest.mark.parametrize('arguments, words', [
    ({'subspace': 'all'}, "one of .*'force'"), ({'relative_width': 0.0}, 'relative_width')])
def test_refusals(arguments, words):
    with pytest.raises(InvalidTaskError, match=words):
        volume(three_finger(), **arguments)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What linearised cones and qhull make of the worst case: why ``ball_radius`` uses neither."""

from benchmarks.edges import edge_wrenches, hull_radius
from benchmarks.random_grasps import random_grasp
from grasp_quality import ball_radius
from known_grasps import antipodal, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def test_four_edges_depend_on_the_tangents():
    """Exact 0.2877; 0.2579 or 0.2048 by how the same pyramids are turned."""
    grasp = three_finger(0.5, 'l1')
    found = ball_radius(grasp, relative_width=1e-3)
    assert (found.lower, found.upper) == pytest.approx((0.2877, 0.2877), abs=4e-4)
    turned = hull_radius(grasp, 4, 0.0), hull_radius(grasp, 4, np.pi / 4.0)
    assert sorted(turned) == pytest.approx([0.2048, 0.2579], abs=1e-4)


@pytest.mark.parametrize('edges', [4, 8, 16])
@pytest.mark.parametrize('seed', [0, 4, 7])
def test_inscribed_pyramids_never_exceed_the_upper_end(edges, seed):
    grasp = random_grasp(np.random.default_rng(seed), 5, 'l1')
    assert hull_radius(grasp, edges) <= ball_radius(grasp).upper + CLOSED_FORM


def test_edges_are_wrenches_of_the_grasp():
    grasp = antipodal(0.5, 0.1)
    rows = edge_wrenches(grasp, 6, 0.2)
    assert rows.shape == (2 * (6 + 2), 6)
    assert np.abs(rows[:, 0]) == pytest.approx(1.0)  # each presses along x with its cap


def test_qhull_fails_on_a_flat_set_or_claims_closure():
    """Two point contacts turn nothing about their line; joggled, qhull finds a ball anyway."""
    grasp = antipodal(0.5, bound='l1')
    assert hull_radius(grasp, 8) is None
    assert hull_radius(grasp, 8, options='QJ') > 0.0
    assert ball_radius(grasp).upper == 0.0

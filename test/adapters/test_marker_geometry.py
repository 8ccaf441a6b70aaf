# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of the shapes that are drawn: closed, turned outward, to scale."""

from adapter_messages import EXACT
from grasp_quality.directions import force_grid
from hypothesis import given, strategies
from msg_adapters.marker_geometry import (
    automatic_force_scale, cone_mesh, grid_faces, thinned_rows)
import numpy as np
import pytest

lengths = strategies.floats(1e-9, 1e9)


@given(lengths, lengths)
def test_the_scale_is_1_2_or_5_and_no_larger_than_wanted(lever_arm, cap):
    scale = automatic_force_scale(lever_arm, cap)
    assert 0.4 * lever_arm / cap <= scale <= lever_arm / cap * (1.0 + 1e-6)
    mantissa = scale / 10.0 ** np.floor(np.log10(scale) + 1e-9)
    assert np.min(np.abs(mantissa - np.array([1.0, 2.0, 5.0]))) < 1e-6


@pytest.mark.parametrize('friction', [0.0, 0.5, 3.0])
def test_the_rim_of_a_cone_is_at_its_edge(friction):
    vertices, faces = cone_mesh(friction, 0.02)
    assert not vertices[0].any()
    tangential = np.linalg.norm(vertices[1:, :2], axis=1)
    np.testing.assert_allclose(vertices[1:, 2], 0.02, atol=EXACT)
    np.testing.assert_allclose(tangential, friction * vertices[1:, 2], atol=EXACT)
    assert (faces[:, 0] == 0).all()
    assert sorted(faces[:, 1]) == sorted(faces[:, 2]) == list(range(1, len(vertices)))
    assert faces.dtype == np.uint32


@pytest.mark.parametrize('sides', [3, 24])
def test_a_cone_is_open_along_the_normal_and_turned_outward(sides):
    """Its triangles are those of a regular pyramid, and with a lid they would enclose it."""
    vertices, faces = cone_mesh(0.5, 2.0, sides)
    assert (len(vertices), len(faces)) == (sides + 1, sides)
    first, second = vertices[faces[:, 1]], vertices[faces[:, 2]]
    np.testing.assert_allclose(
        np.linalg.norm(first - second, axis=1), 2.0 * np.sin(np.pi / sides), atol=EXACT)
    outward = np.cross(first, second)
    assert (np.einsum('fi,fi->f', outward[:, :2], (first + second)[:, :2]) > 0.0).all()


@pytest.mark.parametrize('resolution', [2, 5, 36])
def test_the_surface_is_closed_and_turned_outward(resolution):
    faces = grid_faces(resolution, 2 * resolution)
    points = force_grid(resolution)[:, :3]
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there = {tuple(edge) for edge in edges.tolist()}
    assert len(there) == len(edges)
    assert there == {(b, a) for a, b in there}
    assert (np.linalg.det(points[faces]) > -EXACT).all()
    volume = np.linalg.det(points[faces]).sum() / 6.0
    assert 0.0 < volume < 4.0 / 3.0 * np.pi
    if resolution == 36:
        assert volume == pytest.approx(4.0 / 3.0 * np.pi, rel=0.01)


@pytest.mark.parametrize('resolution', [1, 3, 18, 36, 100])
def test_a_thinned_map_keeps_first_and_last_ring(resolution):
    rows, rings, columns = thinned_rows(resolution, 18)
    assert len(rows) == rings * columns == len(set(rows.tolist()))
    assert rings == min(resolution, 18) and columns == 2 * rings
    assert rows.min() == 0 and rows.max() // (2 * resolution) == resolution - 1
    if resolution <= 18:
        assert rows.tolist() == list(range(2 * resolution ** 2))

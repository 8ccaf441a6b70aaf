# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the triangles of the pictures."""

from grasp_quality_hand import shapes
import numpy as np


def volume(triangles):
    """Return the volume inside a closed surface whose triangles face outward."""
    return np.linalg.det(triangles).sum() / 6.0


def area(triangles):
    """Return the area of triangles."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2.0


def test_closed_shapes_face_outward():
    assert np.isclose(volume(shapes.box([1.0, 2.0, 3.0])), 48.0)
    sphere = volume(shapes.ball(2.0))
    assert 0.95 < sphere / (4.0 / 3.0 * np.pi * 8.0) < 1.0


def test_cutting_fine_keeps_the_surface():
    coarse = shapes.box([1.0, 2.0, 3.0])
    cut = shapes.fine(coarse, 0.7)
    assert np.linalg.norm(cut - np.roll(cut, -1, axis=1), axis=2).max() <= 0.7
    assert np.isclose(area(cut), area(coarse)) and np.isclose(volume(cut), volume(coarse))


def test_front_and_back_make_the_whole():
    whole = shapes.ball(1.0)
    front = shapes.facing(whole, (20.0, -60.0))
    back = shapes.facing(whole, (-20.0, 120.0))
    assert len(front) + len(back) == len(whole)


def test_friction_cone_has_the_slope_of_the_friction():
    apex, normal = np.array([1.0, 2.0, 3.0]), np.array([0.0, 0.6, 0.8])
    rim = shapes.friction_cone(apex, normal, 0.5, 2.0)[:, 1] - apex
    along = rim @ normal
    assert np.allclose(along, 2.0)
    assert np.allclose(np.linalg.norm(rim - along[:, None] * normal, axis=1), 0.5 * along)

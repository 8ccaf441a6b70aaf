# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Triangles of the things that the pictures show; each shape is an array (n, 3, 3)."""

from grasp_quality_hand.contact_reading import rotation_with_z
import numpy as np
from scipy.spatial import ConvexHull

SIDES = 24        # of round things


def convex_hull(points):
    """Return the hull of points, shape (n, 3), its triangles counterclockwise from outside."""
    hull = ConvexHull(points)
    triangles = points[hull.simplices]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inside_out = np.einsum('ij,ij->i', normals, hull.equations[:, :3]) < 0.0
    triangles[inside_out] = triangles[inside_out, ::-1]
    return triangles


def box(half_edges):
    """Return a box about the origin."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return convex_hull(corners * np.asarray(half_edges))


def fine(triangles, longest):
    """Return the triangles halved until no edge is longer than longest, to be sorted by depth."""
    done = []
    while len(triangles):
        edges = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2)    # (n, 3)
        long = edges.max(axis=1) > longest
        done.append(triangles[~long])
        triangles, first = triangles[long], edges[long].argmax(axis=1)
        rows = np.arange(len(triangles))
        a, b, c = (triangles[rows, (first + i) % 3] for i in range(3))    # a to b is the longest
        middle = (a + b) / 2.0
        triangles = np.concatenate([np.stack([a, middle, c], axis=1),
                                    np.stack([middle, b, c], axis=1)])
    return np.concatenate(done)


def facing(triangles, view):
    """Return the triangles whose outside is seen from (elevation, azimuth) in degrees."""
    elevation, azimuth = np.deg2rad(view)
    towards_viewer = np.array([np.cos(elevation) * np.cos(azimuth),
                               np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return triangles[normals @ towards_viewer > 0.0]


def ball(radius):
    """Return a sphere about the origin."""
    polar = np.linspace(0.0, np.pi, SIDES // 2 + 1)[1:-1]
    around = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    polar, around = np.meshgrid(polar, around)
    points = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around),
                       np.cos(polar)], axis=-1).reshape(-1, 3)
    return convex_hull(radius * np.concatenate([points, [[0, 0, 1], [0, 0, -1]]]))


def cylinder(radius, half_length):
    """Return a cylinder about the origin, along z."""
    ring = _ring(np.array([0.0, 0.0, 1.0]), radius)
    return convex_hull(np.concatenate([ring + [0.0, 0.0, half_length],
                                       ring - [0.0, 0.0, half_length]]))


def friction_cone(apex, normal, friction, height):
    """Return the cone of the forces that do not slip, its axis along the unit vector normal."""
    rim = apex + height * normal + _ring(normal, friction * height)
    return np.stack([np.broadcast_to(apex, rim.shape), rim, np.roll(rim, -1, axis=0)], axis=1)


def arrow(tail, vector, radius):
    """Return an arrow from tail along vector, with a shaft of the radius given."""
    length = np.linalg.norm(vector)
    direction = vector / length
    head = min(5.0 * radius, 0.6 * length)
    ring = _ring(direction, radius)
    back, front = tail + ring, tail + (length - head) * direction + ring
    shoulder = front + 1.2 * ring
    tip = np.broadcast_to(tail + vector, ring.shape)
    return np.concatenate([*_band(back, front), *_band(front, shoulder),
                           np.stack([shoulder, np.roll(shoulder, -1, axis=0), tip], axis=1)])


def _ring(direction, radius):
    """Return points on a circle about the origin, normal to direction, shape (SIDES, 3)."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    x, y, _ = rotation_with_z(direction).T
    return radius * (np.cos(angle)[:, None] * x + np.sin(angle)[:, None] * y)


def _band(first, second):
    """Return the triangles between two rings of equally many points."""
    first_next, second_next = np.roll(first, -1, axis=0), np.roll(second, -1, axis=0)
    return (np.stack([first, first_next, second_next], axis=1),
            np.stack([first, second_next, second], axis=1))


def shaded(triangles, colour, alpha=1.0, contrast=0.28):
    """
    Return one RGBA colour per triangle, darker where it turns away from the light.

    Parameters
    ----------
    triangles : ndarray, shape (n, 3, 3)
        Counterclockwise from outside.
    colour : array, shape (3,) or (n, 3)
        In [0, 1].
    alpha : float
        Opacity.
    contrast : float
        How much the light matters, in [0, 0.5].

    """
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    light = np.array([0.3, -0.5, 0.81])
    normals = normals / np.where(lengths > 0.0, lengths, 1.0)
    lit = 1.0 - contrast + contrast * normals @ light    # (n,)
    rgb = np.clip(np.broadcast_to(colour, (len(triangles), 3)) * lit[:, None], 0.0, 1.0)
    return np.column_stack([rgb, np.full(len(triangles), alpha)])

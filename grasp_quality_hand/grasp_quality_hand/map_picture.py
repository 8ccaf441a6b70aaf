# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of the force map around the unit ball, after Fig. 3b of the paper."""

from grasp_quality_hand import shapes
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
import numpy as np
from scipy.spatial import ConvexHull

COLOURS = 'viridis'          # in even steps of lightness, also for the colour-blind
VIEWS = ((24.0, -60.0), (24.0, 120.0))


def draw_map(path, name, directions, alphas, grasp):
    """
    Save the surface whose radius is the force that the grasp can apply in each direction.

    Parameters
    ----------
    path : path
        Of the PNG file.
    name : str
        Of the object.
    directions : ndarray, shape (n, 3)
        Unit vectors all around, object frame.
    alphas : ndarray, shape (n,)
        [N]
    grasp : MeasuredGrasp
        Its contacts are shown by the lines on which their normals stand.

    """
    corners = ConvexHull(directions).simplices    # the ball's surface, in triangles
    triangles = _outward((alphas[:, None] * directions)[corners])
    scale = Normalize(alphas.min(), alphas.max())
    colours = colormaps[COLOURS](scale(alphas[corners].mean(axis=1)))[:, :3]

    figure = Figure(figsize=(13.0, 6.4))
    figure.subplots_adjust(left=0.0, right=0.87, bottom=0.06, top=0.89, wspace=0.1)
    FigureCanvasAgg(figure)
    reach = 1.05 * np.abs(triangles).max()
    lit = shapes.shaded(triangles, colours, contrast=0.12)
    for column in range(len(VIEWS)):
        _panel(figure, column, triangles, lit, reach, grasp)
    figure.suptitle(f'Force that the grasp on the {name} can apply, in each direction '
                    '(object frame)', fontsize=14)
    figure.colorbar(ScalarMappable(scale, COLOURS), cax=figure.add_axes((0.92, 0.14, 0.016, 0.66)),
                    label='largest force alpha [N]')
    figure.savefig(path, dpi=110)


def _outward(triangles):
    """Return triangles about the origin, turned so that they are counterclockwise from outside."""
    inward = np.linalg.det(triangles) < 0.0
    triangles[inward] = triangles[inward, ::-1]
    return triangles


def _panel(figure, column, triangles, colours, reach, grasp):
    """Draw the surface as one of VIEWS sees it."""
    axes = figure.add_subplot(1, len(VIEWS), column + 1, projection='3d', computed_zorder=False)
    axes.add_collection3d(Poly3DCollection(triangles, facecolors=colours, edgecolors=colours,
                                           linewidths=0.3))
    for finger, R in zip(grasp.fingers, grasp.rotations):
        tail, head = -1.15 * reach * R[:, 2], -0.92 * reach * R[:, 2]
        axes.quiver(*tail, *(head - tail), color='black', arrow_length_ratio=0.4)
        axes.text(*tail, finger, fontsize=11, **_beside(head - tail, VIEWS[column]))
    for axis in 'xyz':
        getattr(axes, f'set_{axis}lim')(-1.2 * reach, 1.2 * reach)
        getattr(axes, f'set_{axis}label')(f'force along {axis} [N]')
        getattr(axes, f'{axis}axis').set_major_locator(MaxNLocator(5))
    axes.set_box_aspect((1.0, 1.0, 1.0), zoom=1.04)
    axes.patch.set_visible(False)    # it would cover the label beside it
    axes.set_proj_type('ortho')
    axes.view_init(*VIEWS[column])
    axes.set_title('seen from the front' if column == 0 else 'seen from behind')


def _beside(arrow, view):
    """Return the alignment of a text at the tail of an arrow that keeps it off the arrow."""
    elevation, azimuth = np.deg2rad(view)
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    up = np.array([-np.sin(elevation) * np.cos(azimuth), -np.sin(elevation) * np.sin(azimuth),
                   np.cos(elevation)])
    return {'ha': 'right' if arrow @ right > 0.0 else 'left',
            'va': 'top' if arrow @ up > 0.0 else 'bottom'}

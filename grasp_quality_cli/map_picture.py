# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A grasp and its force map side by side, after Fig. 3 of the paper."""

from __future__ import annotations

from pathlib import Path

from grasp_quality import Grasp
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import (
    Line3DCollection, Poly3DCollection)
from mpl_toolkits.mplot3d.axes3d import Axes3D
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

COLOURS = 'viridis'   # in even steps of lightness, also for the colour-blind
VIEW = (22.0, -58.0)  # elevation, azimuth [degrees]
SHADE = 0.25          # how much darker what faces away from the light is
LIGHT = np.array([0.3, -0.5, 0.81])
SIDES = 24            # of a friction cone
NAMED = 6             # contacts that have room for their names
Array = NDArray[np.float64]


def draw_map(path: Path, grasp: Grasp, directions: Array, alphas: Array, title: str,
             unit: str = 'N') -> None:
    """
    Save the contacts with their friction cones, and the surface with radius alpha.

    Parameters
    ----------
    path : Path
        Of the PNG file.
    grasp : Grasp
        Its contacts are drawn.
    directions : (n, 3) array
        Unit forces or torques all around, object frame.
    alphas : (n,) array
        Largest factor of each, in ``unit``.
    title : str
        Stands above both.
    unit : str
        'N' for a map of forces, 'N m' for one of torques.

    """
    figure = Figure(figsize=(11.0, 5.4), dpi=110)
    FigureCanvasAgg(figure)
    figure.subplots_adjust(left=0.01, right=0.87, bottom=0.07, top=0.87, wspace=0.16)
    _draw_grasp(figure.add_subplot(1, 2, 1, projection='3d'), grasp)
    scale = Normalize(0.0, float(alphas.max()) or 1.0)
    _draw_surface(figure.add_subplot(1, 2, 2, projection='3d'), directions, alphas, scale, unit)
    bar = figure.colorbar(ScalarMappable(scale, COLOURS),
                          cax=figure.add_axes((0.925, 0.16, 0.016, 0.62)))
    bar.set_label(f'alpha, largest {_kind(unit)} [{unit}]')
    figure.suptitle(title, fontsize=13)
    figure.savefig(path)


def _kind(unit: str) -> str:
    return 'force' if unit == 'N' else 'torque'


def _draw_grasp(axes: Axes3D, grasp: Grasp) -> None:
    """Draw contacts, normals and cones, in the box that the contacts span."""
    points, frames = grasp.positions, grasp.rotations
    reach = float(np.abs(points - grasp.center).max()) or 1.0
    colours = colormaps[COLOURS](np.linspace(0.0, 0.8, len(grasp)))
    angles = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    height = 0.55 * reach
    for i, (point, R) in enumerate(zip(points, frames)):
        mu = grasp.scales[i, 0]
        ring = np.stack([mu * np.cos(angles), mu * np.sin(angles), np.ones_like(angles)], axis=1)
        # the cone stands outside: the fingers press along it
        rim = point - height * (ring * [-1.0, -1.0, 1.0]) @ R.T
        triangles = [[point, rim[k], rim[k + 1]] for k in range(SIDES)]
        axes.add_collection3d(Poly3DCollection(
            triangles, facecolor=colours[i], alpha=0.35, edgecolor='none'))
        axes.plot(*rim.T, color=colours[i], linewidth=1.2)
        axes.quiver(*(point - 1.35 * height * R[:, 2]), *(1.35 * height * R[:, 2]),
                    color='black', linewidth=1.1, arrow_length_ratio=0.22)
        if len(grasp) <= NAMED:
            axes.text(*(point - 1.3 * height * R[:, 2] + [0.0, 0.0, 0.75 * height]),
                      grasp.names[i], fontsize=10, ha='center')
    _draw_box(axes, points)
    tails = points - 1.6 * height * frames[:, :, 2]
    everything = np.concatenate([points, tails])
    _frame(axes, everything.mean(axis=0), 1.05 * float(np.ptp(everything, axis=0).max()) / 2.0,
           'position along {} [m]')
    axes.set_title(f'{len(grasp)} contacts with their normals and friction cones', fontsize=11)


def _draw_box(axes: Axes3D, points: Array) -> None:
    """Draw the edges of the box that the contacts span."""
    low, high = points.min(axis=0), points.max(axis=0)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    edges = [(a, b) for i, a in enumerate(corners) for b in corners[i + 1:]
             if np.abs(a - b).sum() == 1]
    axes.add_collection3d(Line3DCollection(
        [[low + (high - low) * a, low + (high - low) * b] for a, b in edges],
        colors='0.55', linewidths=0.8, linestyles='dashed'))


def _draw_surface(axes: Axes3D, directions: Array, alphas: Array, scale: Normalize, unit: str
                  ) -> None:
    corners = ConvexHull(directions).simplices  # the ball's surface, in triangles
    triangles = (alphas[:, None] * directions)[corners]
    inward = np.linalg.det(directions[corners]) < 0.0
    triangles[inward] = triangles[inward, ::-1]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sizes = np.linalg.norm(normals, axis=1, keepdims=True)
    light = np.divide(normals, sizes, where=sizes > 0.0, out=np.zeros_like(normals)) @ LIGHT
    colours = colormaps[COLOURS](scale(alphas[corners].mean(axis=1)))[:, :3]
    colours *= (1.0 - SHADE * (1.0 - light) / 2.0)[:, None]
    axes.add_collection3d(Poly3DCollection(
        triangles, facecolors=colours, edgecolors=colours, linewidths=0.2))
    reach = 1.15 * float(np.abs(triangles).max()) or 1.0
    _frame(axes, np.zeros(3), reach, f'{_kind(unit)} along {{}} [{unit}]')
    axes.set_title(f'{_kind(unit)} map: {len(directions):,} directions', fontsize=11)


def _frame(axes: Axes3D, center: Array, reach: float, label: str) -> None:
    for axis, middle in zip('xyz', center):
        getattr(axes, f'set_{axis}lim')(middle - reach, middle + reach)
        getattr(axes, f'set_{axis}label')(label.format(axis), labelpad=6)
        getattr(axes, f'{axis}axis').set_major_locator(MaxNLocator(5, prune='both'))
    axes.set_box_aspect((1.0, 1.0, 1.0), zoom=1.03)
    axes.set_proj_type('ortho')
    axes.view_init(*VIEW)
    axes.patch.set_visible(False)  # it would cover the label beside it

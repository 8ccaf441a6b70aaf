# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The pictures of ``grasp-quality figures``, after the figures of the paper."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from grasp_quality import evaluate, Grasp, TaskWrench, wrench_map
from grasp_quality.directions import force_grid
from grasp_quality_cli.map_picture import draw_map
from grasp_quality_cli.paper_grasps import eight_contacts, pinch, three_fingers
from grasp_quality_cli.paper_numbers import (
    cone_about, FLAT, FLAT_HALF_ANGLE, FX, FY, FZ, HALF_ANGLE, tilted)
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import numpy as np
from numpy.typing import NDArray

DARK, MIDDLE, LIGHT = colormaps['viridis']([0.0, 0.5, 0.8])
RESOLUTION = 36  # 2,592 directions, as in the paper


def draw_all(folder: Path) -> list[Path]:
    """Draw every figure; return the files."""
    drawings: dict[str, Callable[[Path], None]] = {
        'paper_fig_3.png': _fig_3, 'paper_fig_5.png': _fig_5, 'paper_fig_6.png': _fig_6,
        'paper_fig_7.png': _fig_7}
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in drawings.items():
        draw(folder / name)
    return [folder / name for name in drawings]


def _fig_3(path: Path) -> None:
    grasp, directions = eight_contacts(0.25), force_grid(RESOLUTION)
    draw_map(path, grasp, directions[:, :3], wrench_map(grasp, directions).alpha,
             'Fig. 3: eight contacts, friction 0.25, each at most 1 N')


def _fig_5(path: Path) -> None:
    _direction_and_cone(path, three_fingers(), HALF_ANGLE, np.linspace(0.0, 50.0, 51), 30.0,
                        'Fig. 5: three fingers, friction 0.5, cone of 60 degrees half angle')


def _fig_6(path: Path) -> None:
    _direction_and_cone(path, pinch(FLAT), FLAT_HALF_ANGLE, np.linspace(0.0, 45.0, 91), 30.0,
                        'Fig. 6: flat wrench space, two fingers with friction 0.1, cone of 50 '
                        'degrees half angle')


def _direction_and_cone(path: Path, grasp: Grasp, half_angle: float,
                        tilts: NDArray[np.float64], shown: float, title: str) -> None:
    """Draw what forces can be applied in the plane, and what direction and cone make of a tilt."""
    left, right, figure = _two_panels(title)
    around = np.linspace(0.0, 2.0 * np.pi, 721)
    forces = np.cos(around)[:, None] * FX + np.sin(around)[:, None] * FY
    edge = wrench_map(grasp, forces).alpha[:, None] * forces[:, :2]
    left.fill(*edge.T, color=LIGHT, alpha=0.35, linewidth=0)
    left.plot(*edge.T, color=MIDDLE, linewidth=1.5, label='forces that can be applied')
    axis = tilted(shown)
    best = evaluate(grasp, cone_about(axis, half_angle))
    reach = 1.1 * float(np.abs(edge).max())
    middle = np.arctan2(axis[1], axis[0])
    for side in (-half_angle, half_angle):
        ray = 2 * reach * np.array([np.cos(middle + side), np.sin(middle + side)])
        left.plot([0.0, ray[0]], [0.0, ray[1]], color='0.45', linestyle='dotted',
                  label='task cone' if side > 0 else None)
    left.plot(*np.stack([np.zeros(2), 2 * reach * axis[:2]]).T, color='0.45', linestyle='dashed',
              label=f'its axis, tilted by {shown:g} degrees')
    _point(left, np.asarray(best.alpha_axis, np.float64) * axis[:2], DARK, 's', 'single direction')
    _point(left, best.wrench[:2], DARK, 'o', 'best in the cone')
    left.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect='equal',
             xlabel='force along x [N]', ylabel='force along y [N]')
    left.legend(loc='upper center', bbox_to_anchor=(0.5, -0.17), ncols=2, frameon=False,
                fontsize=9)
    cones = [evaluate(grasp, cone_about(tilted(t), half_angle)) for t in tilts]
    right.plot(tilts, [np.linalg.norm(c.wrench[:3]) for c in cones], color=MIDDLE, marker='o',
               markevery=10, label='force reached, best in the cone')
    right.plot(tilts, np.asarray([c.alpha_axis for c in cones], np.float64), color=DARK,
               marker='s', markevery=10, linestyle='dashed',
               label='force reached, single direction')
    right.set(xlabel='tilt of the axis from -x [degrees]', ylabel='force reached [N]',
              ylim=(0.0, None))
    right.legend(loc='lower left', frameon=False)
    figure.savefig(path)


def _point(axes: Axes, place: NDArray[np.float64], colour: object, marker: str, label: str
           ) -> None:
    axes.plot(*place, color=colour, marker=marker, markersize=9, linestyle='none', label=label)


def _fig_7(path: Path) -> None:
    left, right, figure = _two_panels('Fig. 7: robustness against magnitude, by the weight eps of '
                                      'eq. (11)')
    weights = np.geomspace(1e-3, 10.0, 41)
    grasps = {'two fingers, y': (pinch(0.5), FY), 'three fingers, -x': (three_fingers(), -FX),
              'eight contacts, z': (eight_contacts(0.25), FZ)}
    for (label, (grasp, wrench)), colour, marker in zip(
            grasps.items(), (DARK, MIDDLE, LIGHT), 'os^'):
        answers = [evaluate(grasp, TaskWrench(wrench), barrier_weight=eps) for eps in weights]
        shares = np.array([a.alpha / a.alpha_upper for a in answers])
        margins = np.array([a.friction_margin for a in answers])
        left.plot(weights, shares, color=colour, marker=marker, markevery=8, label=label)
        right.plot(shares, margins, color=colour, marker=marker, markevery=5, label=label)
    left.set(xscale='log', xlabel='weight eps [N]', ylabel='magnitude: alpha / largest alpha [-]',
             ylim=(0.0, 1.05))
    right.set(xlabel='magnitude: alpha / largest alpha [-]',
              ylabel='robustness: friction margin [-]', xlim=(0.0, 1.05),
              ylim=(0.0, 1.05))
    for axes in (left, right):
        axes.legend(frameon=False, loc='lower left')
    figure.savefig(path)


def _two_panels(title: str) -> tuple[Axes, Axes, Figure]:
    figure = Figure(figsize=(11.0, 5.2), dpi=110, layout='constrained')
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.suptitle(title, fontsize=13)
    return left, right, figure

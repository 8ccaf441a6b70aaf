# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The animation of a pull: forces at the contacts, and the load beside its prediction."""

from pathlib import Path
from typing import Any

from grasp_quality_hand import shapes
from grasp_quality_hand.demo_pull import Frame, PullRecord
from grasp_quality_hand.grasp_objects import GraspObject
from grasp_quality_hand.grasp_picture import (
    ARROW_RADIUS, CONE, CONE_HEIGHT, draw_parts, frame_axes, HAND, hand_triangles, LIFT, MEASURED,
    OBJECT, object_triangles, part, pose_of)
from grasp_quality_hand.hand_model import build_hand_model
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import mujoco
import numpy as np
from PIL import Image

FRAMES = 24
LAST_FRAMES = 6              # that show how it ends, at more of the kept samples
PERIOD_MS, LAST_MS = 160, 2000
SIZE, DPI = (8.4, 4.2), 80
METRES_PER_NEWTON = 0.0022


def draw_pull(path: Path, grasp_object: GraspObject, record: PullRecord) -> None:
    """
    Save a pull as an animated GIF.

    Parameters
    ----------
    path : path
        Of the GIF file.
    grasp_object : GraspObject
        What is held.
    record : PullRecord
        The pull, of one frame at least.

    """
    hand = build_hand_model(grasp_object)
    data = mujoco.MjData(hand.mujoco)
    last = max(0, len(record.frames) - LAST_FRAMES)
    early = np.linspace(0, last, FRAMES, endpoint=False).astype(int) if last else []
    chosen = [*early, *range(last, len(record.frames))]
    pictures = [_picture(hand, data, grasp_object, record, index) for index in chosen]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], loop=0,
                     duration=[PERIOD_MS] * (len(pictures) - 1) + [LAST_MS])


def _picture(hand: Any, data: Any, grasp_object: GraspObject, record: PullRecord,
             index: int) -> Image.Image:
    """Return the picture of one moment."""
    figure = Figure(figsize=SIZE, dpi=DPI)
    canvas = FigureCanvasAgg(figure)
    frame = record.frames[index]
    scene = figure.add_axes((-0.05, 0.07, 0.6, 0.86), projection='3d')
    draw_parts(scene, _scene(hand, data, grasp_object, record, frame))
    frame_axes(scene, np.array([0.0, 0.0, grasp_object.height]), 0.062)
    scene.tick_params(labelsize=7)
    figure.text(0.02, 0.94, f"D'Claw holds the {grasp_object.name} with optimised forces; "
                f'a pull {record.way} grows until it slips', fontsize=10)
    _draw_load(figure.add_axes((0.62, 0.52, 0.35, 0.36)), record, index)
    _draw_way(figure.add_axes((0.62, 0.13, 0.35, 0.26)), record, index)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[:, :, :3]).quantize(64)


def _scene(hand: Any, data: Any, grasp_object: GraspObject, record: PullRecord,
           frame: Frame) -> list[Any]:
    """Return fingertips, object, cones, contact forces and the load as coloured triangles."""
    angles = dict(zip(frame.joints.name, frame.joints.position))
    _, tips = hand_triangles(hand, data, [angles[name] for name in hand.joint_names])
    R, p = pose_of(frame.object_pose)
    parts = [part(tips, HAND, 0.15), part(object_triangles(grasp_object) @ R.T + p, OBJECT, 0.3)]
    measured = frame.measured
    for position, rotation, force in zip(measured.positions, measured.rotations,
                                         measured.forces_in_object_frame):
        point = R @ position + p
        parts.append(part(shapes.friction_cone(point, R @ rotation[:, 2], grasp_object.friction,
                                               CONE_HEIGHT), CONE, 0.35))
        if force.any():
            parts.append(part(shapes.arrow(point, METRES_PER_NEWTON * R @ force, ARROW_RADIUS),
                              MEASURED))
    load = METRES_PER_NEWTON * frame.load * R @ record.direction
    if load.any():
        parts.append(part(shapes.arrow(p, load, 1.6 * ARROW_RADIUS), LIFT))
    return parts


def _draw_load(axes: Any, record: PullRecord, index: int) -> None:
    """Draw the load up to now, beside the predicted alpha."""
    loads = [frame.load for frame in record.frames[:index + 1]]
    axes.axhline(record.alpha, color=tuple(MEASURED), linestyle='--', linewidth=1.2)
    axes.plot(range(len(loads)), loads, color=tuple(LIFT), linewidth=2.0)
    axes.set_xlim(0, len(record.frames))
    axes.set_ylim(0.0, 1.2 * record.alpha)
    axes.set_title(f'load {loads[-1]:.1f} N, predicted alpha {record.alpha:.1f} N (dashed)',
                   fontsize=9)
    _plain(axes, 'load [N]')


def _draw_way(axes: Any, record: PullRecord, index: int) -> None:
    """Draw how far the object has moved up to now."""
    ways = [1e3 * frame.moved for frame in record.frames[:index + 1]]
    axes.plot(range(len(ways)), ways, color='0.25', linewidth=2.0)
    axes.set_xlim(0, len(record.frames))
    axes.set_ylim(0.0, 0.6)
    axes.axhline(0.5, color='0.6', linestyle=':', linewidth=1.0)
    axes.set_title(f'object moved by {ways[-1]:.2f} mm (slip: 0.5 mm)', fontsize=9)
    _plain(axes, 'moved [mm]')
    axes.set_xlabel('time', fontsize=8)


def _plain(axes: Any, label: str) -> None:
    """Name the upright axis, and leave out what says nothing."""
    axes.set_ylabel(label, fontsize=8)
    axes.tick_params(labelsize=7)
    axes.set_xticks([])
    for side in ('top', 'right'):
        axes.spines[side].set_visible(False)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The hand and the object on the page: shapes that are sent once, and poses that follow."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.urdf_shapes import link_meshes, read_mesh
from grasp_quality_hand.urdf_tree import UrdfError, UrdfTree
import numpy as np
from numpy.typing import NDArray
import trimesh
import viser
from viser import transforms

Array = NDArray[np.float64]

HAND_COLOUR, OBJECT_COLOUR = (120, 125, 135), (219, 214, 199)
OBJECT_OPACITY = 0.3
DIGITS = 6  # of metres and quaternions: what moves less is not sent again
OBJECT_RULE = ("must be '' (ask the simulated hand), 'none', 'box:<x>,<y>,<z>' with edges [m], "
               "'sphere:<radius>', 'cylinder:<radius>,<height>' along z [m] or a mesh file in the "
               'object frame')


def object_mesh(text: str) -> trimesh.Trimesh | None:
    """
    Read the parameter ``object``.

    Raises
    ------
    ValueError
        Names the rule.

    """
    kind, _, numbers = text.partition(':')
    if kind in ('', 'none'):
        return None
    try:
        if kind == 'box':
            edges = [float(number) for number in numbers.split(',')]
            if len(edges) == 3 and min(edges) > 0.0:
                box: trimesh.Trimesh = trimesh.creation.box(edges)
                return box
        elif kind == 'cylinder':
            sizes = [float(number) for number in numbers.split(',')]
            if len(sizes) == 2 and min(sizes) > 0.0:
                cylinder: trimesh.Trimesh = trimesh.creation.cylinder(*sizes)
                return cylinder
        elif kind == 'sphere':
            if float(numbers) > 0.0:
                ball: trimesh.Trimesh = trimesh.creation.icosphere(3, float(numbers))
                return ball
        else:
            return read_mesh(Path(text))
    except (UrdfError, ValueError) as exc:
        raise ValueError(f'object {OBJECT_RULE}, got {text!r} ({exc})') from exc
    raise ValueError(f'object {OBJECT_RULE}, got {text!r}')


def known_object(name: str) -> str:
    """Return how the parameter ``object`` would name what the simulated hand calls so."""
    if name not in OBJECTS:
        return 'none'
    size = OBJECTS[name].size
    if OBJECTS[name].shape == 'sphere':
        return f'sphere:{size[0]:g}'
    if OBJECTS[name].shape == 'cylinder':
        return f'cylinder:{size[0]:g},{2.0 * size[1]:g}'
    return 'box:' + ','.join(f'{2.0 * half:g}' for half in size)


class HandAndObject:
    """Draws below /hand and /object of a viser server."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._tree: UrdfTree | None = None
        self._links: dict[str, Any] = {}
        self._object: Any = None
        self.frame = server.scene.add_frame('/object', show_axes=True, axes_length=0.02,
                                            axes_radius=0.0006)

    def set_object(self, mesh: trimesh.Trimesh | None) -> None:
        """Draw another object."""
        if self._object is not None:
            self._object.remove()
            self._object = None
        if mesh is not None:
            self._object = self._server.scene.add_mesh_simple(
                '/object/shape', mesh.vertices, mesh.faces, color=OBJECT_COLOUR,
                opacity=OBJECT_OPACITY, flat_shading=len(mesh.faces) < 100, cast_shadow=False)

    def set_hand(self, tree: UrdfTree) -> None:
        """Draw another hand; it is hidden until ``place`` knows where it is."""
        meshes = {link: link_meshes(tree, link) for link in tree.visual}
        for handle in self._links.values():
            handle.remove()
        self._tree, self._links = tree, {}
        for link, parts in meshes.items():
            if parts:
                whole = trimesh.util.concatenate(parts)
                self._links[link] = self._server.scene.add_mesh_simple(
                    f'/hand/{link}', whole.vertices, whole.faces, color=HAND_COLOUR,
                    flat_shading=True, visible=False, cast_shadow=False)

    def place(self, object_pose: Array | None, joints: Mapping[str, float] | None) -> None:
        """
        Put the object and the hand's links where they are.

        Parameters
        ----------
        object_pose : (4, 4) array or None
            Base of the hand <- object frame; None when nobody tells, and the object frame then is
            the world of the page.
        joints : mapping of str to float, or None
            Angles [rad] or lengths [m] by name; None when nobody tells.

        """
        _put(self.frame, np.eye(4) if object_pose is None else object_pose)
        shown = object_pose is not None and joints is not None
        poses = self._tree.link_poses(joints or {}) if self._tree is not None else {}
        for link, handle in self._links.items():
            handle.visible = shown
            if shown:
                _put(handle, poses[link])


def _put(handle: Any, pose: Array) -> None:
    handle.position = np.round(pose[:3, 3], DIGITS)
    handle.wxyz = np.round(transforms.SO3.from_matrix(pose[:3, :3]).wxyz, DIGITS)

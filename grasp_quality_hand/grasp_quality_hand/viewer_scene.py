# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The grasp on the page: friction cones, forces, task and map, below the object frame."""

from typing import Any

from grasp_quality.directions import force_grid
from grasp_quality_hand.viewer_picture import Picture
from grasp_quality_msgs.msg import ForceMap
from msg_adapters import colours
from msg_adapters.force_map import alphas_of
from msg_adapters.marker_geometry import cone_mesh, grid_faces
import numpy as np
from numpy.typing import NDArray
import trimesh
import viser
from viser import transforms

Array = NDArray[np.float64]

CONE_SHARE = 0.4      # height of the cones, of the lever arm
CONE_OPACITY = 0.55
MAP_OPACITY = 0.55
SHAFT, HEAD, HEAD_LENGTH = 0.03, 0.075, 0.16    # of arrows, of the lever arm
SHORTEST = 1e-6       # arrows below this share of the lever arm are not drawn
BYTE = 255.0
DIGITS = 6             # of metres and quaternions: what moves less is not sent again


class Scene:
    """Draws pictures below /object of a viser server."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._scene = server.scene
        self._cones: dict[str, tuple[tuple[float, float], Any, Any]] = {}
        self._arrows: dict[str, Any] = {}
        self._map: Any = None
        self._drawn_map: tuple[ForceMap | None, float] = (None, 0.0)
        self._map_wanted = True

    def show_map(self, wanted: bool) -> None:
        """Show or hide the force map."""
        self._map_wanted = wanted

    def draw(self, picture: Picture) -> None:
        """Draw a picture; what is not in it disappears."""
        self._draw_cones(picture)
        reach = picture.grasp.lever_arm if picture.grasp is not None else 1.0
        points = picture.grasp.positions if picture.grasp is not None else np.zeros((0, 3))
        scale = picture.metres_per_newton
        self._draw_arrows('optimal', points, scale * picture.optimal, colours.OPTIMAL, reach)
        self._draw_arrows('measured', points, scale * picture.measured, colours.MEASURED, reach)
        task = scale * np.vstack([picture.alpha_task[:3], picture.alpha_task[3:] / reach])
        self._draw_arrows('task', np.zeros((2, 3)), task, colours.TASK, reach)
        self._draw_map(picture.force_map if self._map_wanted else None, scale)

    def _draw_cones(self, picture: Picture) -> None:
        grasp = picture.grasp
        names = grasp.names if grasp is not None else ()
        for name in set(self._cones) - set(names):
            for handle in self._cones.pop(name)[1:]:
                handle.remove()
        for i, name in enumerate(names):
            friction = float(grasp.contacts.effective_friction[i])
            shape = friction, float(f'{CONE_SHARE * grasp.lever_arm:.2g}')
            if name not in self._cones or self._cones[name][0] != shape:
                self._cones[name] = self._new_cone(i, name, shape)
            _, cone, label = self._cones[name]
            pose = grasp.rotations[i], grasp.positions[i]
            cone.wxyz = np.round(transforms.SO3.from_matrix(pose[0]).wxyz, DIGITS)
            cone.position = np.round(pose[1], DIGITS)
            label.position = np.round(pose[1] - 0.3 * grasp.lever_arm * pose[0][:, 2], DIGITS)
            usage = picture.usage[i]
            colour = colours.UNKNOWN if np.isnan(usage) else colours.usage_colours([usage])[0]
            cone.color = tuple(int(BYTE * c) for c in colour)
            limits = picture.quality is not None and name == picture.quality.limiting_contact
            label.text = f'{name} (limits)' if limits else name
            cone.opacity = 0.9 if limits else CONE_OPACITY

    def _new_cone(self, i: int, name: str, shape: tuple[float, float]) -> Any:
        vertices, faces = cone_mesh(*shape)
        cone = self._scene.add_mesh_simple(
            f'/object/cones/{i}', vertices, faces, side='double', opacity=CONE_OPACITY,
            cast_shadow=False, receive_shadow=False)
        label = self._scene.add_label(f'/object/names/{i}', name, anchor='center-center',
                                      font_screen_scale=0.9)
        return shape, cone, label

    def _draw_arrows(self, name: str, tails: Array, vectors: Array,
                     colour: tuple[float, float, float], reach: float) -> None:
        lengths = np.linalg.norm(vectors, axis=1)
        there = lengths > SHORTEST * reach  # not those of NaN
        handle = self._arrows.get(name)
        if not there.any():
            if handle is not None:
                handle.visible = False
            return
        points = np.stack([tails[there], tails[there] + vectors[there]], axis=1)
        points = np.round(points, DIGITS).astype(np.float32)
        if handle is None:
            self._arrows[name] = self._scene.add_arrows(
                f'/object/forces/{name}', points, np.array(colour),
                shaft_radius=SHAFT * reach, head_radius=HEAD * reach,
                head_length=HEAD_LENGTH * reach)
            return
        handle.visible = True
        if not np.array_equal(handle.points, points):
            handle.points = points

    def _draw_map(self, message: ForceMap | None, scale: float) -> None:
        if (message, scale) == self._drawn_map:
            return
        self._drawn_map = message, scale
        alphas = alphas_of(message) if message is not None else np.zeros(0)
        if not alphas.any() or message.resolution < 2:
            if self._map is not None:
                self._map.remove()
                self._map = None
            return
        resolution = message.resolution
        vertices = scale * alphas[:, None] * force_grid(resolution)[:, :3]
        self._map = self._scene.add_mesh_trimesh(
            '/object/force_map', map_mesh(vertices, resolution, alphas), cast_shadow=False,
            receive_shadow=False)


def map_mesh(vertices: Array, resolution: int, alphas: Array) -> trimesh.Trimesh:
    """Return the surface of a map as a mesh that lets light through, coloured by alpha."""
    mesh = trimesh.Trimesh(
        vertices, grid_faces(resolution, 2 * resolution), process=False)
    tint = np.column_stack([colours.alpha_colours(alphas), np.full(len(alphas), MAP_OPACITY)])
    mesh.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(
            alphaMode='BLEND', doubleSided=True, metallicFactor=0.0, roughnessFactor=0.8))
    mesh.visual.vertex_attributes['color'] = (BYTE * tint).astype(np.uint8)
    return mesh

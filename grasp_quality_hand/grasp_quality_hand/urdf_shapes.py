# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Triangles of the shapes of a URDF, coarse enough to be sent to a browser."""

from functools import cache
from pathlib import Path

from grasp_quality_hand.urdf_tree import Shape, UrdfError, UrdfTree
import numpy as np
import trimesh

MANY_FACES = 3000  # a mesh with more is made coarser
FINEST = 1.0 / 40.0  # cell that vertices are merged in, of the mesh's extent


def link_meshes(tree: UrdfTree, link: str) -> list[trimesh.Trimesh]:
    """
    Return the shapes of a link as meshes in the link's frame.

    Those of ``visual``, or of ``collision`` where a link has no visual.

    Raises
    ------
    UrdfError
        When a mesh file cannot be read.

    """
    return [mesh_of(shape) for shape in tree.visual[link] or tree.collision[link]]


def mesh_of(shape: Shape) -> trimesh.Trimesh:
    """Return a shape as a mesh in the frame of its link."""
    mesh = _plain_mesh(shape)
    mesh.apply_transform(shape.pose)
    return mesh


def _plain_mesh(shape: Shape) -> trimesh.Trimesh:
    mesh: trimesh.Trimesh
    if shape.kind == 'box':
        mesh = trimesh.creation.box(shape.size)
    elif shape.kind == 'cylinder':
        mesh = trimesh.creation.cylinder(shape.size[0], shape.size[1], sections=24)
    elif shape.kind == 'sphere':
        mesh = trimesh.creation.icosphere(subdivisions=2, radius=shape.size[0])
    elif shape.file is None:
        raise UrdfError('a mesh needs a file')
    else:
        mesh = read_mesh(shape.file).copy()
        mesh.apply_scale(shape.size)
    return mesh


@cache
def read_mesh(path: Path) -> trimesh.Trimesh:
    """
    Read a mesh file of any kind that trimesh knows, made coarser where it is fine.

    Raises
    ------
    UrdfError

    """
    try:
        mesh = trimesh.load(path, force='mesh')
    except Exception as exc:  # the readers of trimesh raise whatever they please
        raise UrdfError(f'{path}: {exc}') from exc
    if not isinstance(mesh, trimesh.Trimesh) or not len(mesh.faces):
        raise UrdfError(f'{path} holds no triangles')
    return coarse(mesh) if len(mesh.faces) > MANY_FACES else mesh


def coarse(mesh: trimesh.Trimesh, cell: float | None = None) -> trimesh.Trimesh:
    """
    Merge the vertices of a mesh that share a cell, and drop the triangles that vanish.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Not changed.
    cell : float, optional
        Edge of the cells [m]; FINEST of the largest extent when not given.

    """
    cell = cell or float(mesh.extents.max()) * FINEST
    cells = np.floor(mesh.vertices / cell).astype(np.int64)
    _, _, cell_of = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    count = np.bincount(cell_of.ravel())
    vertices = np.column_stack([
        np.bincount(cell_of.ravel(), weights=mesh.vertices[:, axis]) / count for axis in range(3)])
    faces = cell_of.ravel()[mesh.faces]
    there = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) \
        & (faces[:, 2] != faces[:, 0])
    faces = faces[there]
    _, once = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    return trimesh.Trimesh(vertices, faces[once], process=False)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A hand's URDF as a tree of links, and where joint angles put them.

Only what drawing needs: joints (revolute, continuous, prismatic, fixed and those that mimic
another) and the shapes of links. Poses are 4 x 4 matrices, frame of the parent <- frame of the
child, lengths in metres.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
import xml.etree.ElementTree as ElementTree

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MOVING = ('revolute', 'continuous', 'prismatic')
LOCKED = ('fixed', 'floating', 'planar')


class UrdfError(ValueError):
    """A URDF cannot be used; the text names what is wrong and where."""


@dataclass(frozen=True, eq=False)
class Shape:
    """
    One shape of a link.

    Attributes
    ----------
    pose : (4, 4) array
        Link frame <- shape frame.
    kind : str
        'mesh', 'box', 'cylinder' or 'sphere'.
    size : tuple of float
        Edges of a box, radius and length of a cylinder, radius of a sphere, scale of a mesh [m].
    file : Path or None
        Of a mesh.

    """

    pose: Array
    kind: str
    size: tuple[float, ...]
    file: Path | None = None


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint: pose of its frame at zero, and how the angle or length moves the child."""

    name: str
    kind: str
    parent: str
    child: str
    pose: Array
    axis: Array
    mimic: tuple[str, float, float] | None = None  # joint, multiplier, offset


@dataclass(frozen=True, eq=False)
class UrdfTree:
    """Joints in the order from the base out, and the visual and collision shapes of each link."""

    name: str
    base: str
    joints: tuple[Joint, ...]
    visual: Mapping[str, tuple[Shape, ...]]
    collision: Mapping[str, tuple[Shape, ...]]

    def link_poses(self, positions: Mapping[str, float]) -> dict[str, Array]:
        """
        Place every link.

        Parameters
        ----------
        positions : mapping of str to float
            Angle [rad] or length [m] of joints by name; 0 for those that are missing.

        Returns
        -------
        dict of str to (4, 4) array
            Base link <- link.

        """
        poses = {self.base: np.eye(4)}
        for joint in self.joints:
            poses[joint.child] = poses[joint.parent] @ joint.pose @ _moved(joint, positions)
        return poses


def _moved(joint: Joint, positions: Mapping[str, float]) -> Array:
    name, factor, offset = joint.mimic or (joint.name, 1.0, 0.0)
    value = factor * positions.get(name, 0.0) + offset
    pose = np.eye(4)
    if joint.kind == 'prismatic':
        pose[:3, 3] = value * joint.axis
    elif joint.kind in MOVING:
        x, y, z = joint.axis
        K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        pose[:3, :3] += np.sin(value) * K + (1.0 - np.cos(value)) * K @ K
    return pose


def read_urdf(text: str, folder: Path) -> UrdfTree:
    """
    Read a URDF.

    Parameters
    ----------
    text : str
        The XML.
    folder : Path
        That relative mesh files are in; ``package://`` is looked up in the ament index.

    Raises
    ------
    UrdfError

    """
    try:
        robot = ElementTree.fromstring(text)
    except ElementTree.ParseError as exc:
        raise UrdfError(f'the URDF is no XML: {exc}') from exc
    links = [link.get('name', '') for link in robot.findall('link')]
    joints = [_joint(element) for element in robot.findall('joint')]
    bases = sorted(set(links) - {joint.child for joint in joints})
    if len(bases) != 1:
        raise UrdfError(f'a URDF must have one link without a parent, this one has {bases}')
    shapes = {part: {
        link.get('name', ''): tuple(_shape(element, folder) for element in link.findall(part))
        for link in robot.findall('link')} for part in ('visual', 'collision')}
    return UrdfTree(robot.get('name', ''), bases[0], _from_the_base_out(bases[0], joints),
                    shapes['visual'], shapes['collision'])


def _from_the_base_out(base: str, joints: list[Joint]) -> tuple[Joint, ...]:
    reached, ordered = {base}, []
    left = list(joints)
    while left:
        ready = [joint for joint in left if joint.parent in reached]
        if not ready:
            raise UrdfError(f'joints {[joint.name for joint in left]} hang on no link: '
                            f'their parents are {[joint.parent for joint in left]}')
        ordered += ready
        reached |= {joint.child for joint in ready}
        left = [joint for joint in left if joint not in ready]
    return tuple(ordered)


def _joint(element: ElementTree.Element) -> Joint:
    name, kind = element.get('name', ''), element.get('type', '')
    if kind not in MOVING + LOCKED:
        raise UrdfError(f'joint {name!r}: type must be one of {MOVING + LOCKED}, got {kind!r}')
    parent, child = element.find('parent'), element.find('child')
    if parent is None or child is None:
        raise UrdfError(f'joint {name!r} has no parent or no child')
    axis = _numbers(element.find('axis'), 'xyz', (1.0, 0.0, 0.0))
    mimic = element.find('mimic')
    return Joint(
        name, kind, parent.get('link', ''), child.get('link', ''), _pose(element.find('origin')),
        axis / max(float(np.linalg.norm(axis)), 1e-12), None if mimic is None else (
            mimic.get('joint', ''), float(mimic.get('multiplier', 1.0)),
            float(mimic.get('offset', 0.0))))


def _shape(element: ElementTree.Element, folder: Path) -> Shape:
    pose, geometry = _pose(element.find('origin')), element.find('geometry')
    part = geometry[0] if geometry is not None and len(geometry) else ElementTree.Element('none')
    if part.tag == 'mesh':
        scale = _numbers(part, 'scale', (1.0, 1.0, 1.0))
        return Shape(pose, 'mesh', tuple(scale), mesh_file(part.get('filename', ''), folder))
    attributes = {'box': ('size',), 'cylinder': ('radius', 'length'), 'sphere': ('radius',)}
    if part.tag not in attributes:
        raise UrdfError(f'geometry must be mesh, box, cylinder or sphere, got {part.tag!r}')
    size = [float(word) for name in attributes[part.tag] for word in part.get(name, '').split()]
    return Shape(pose, part.tag, tuple(size))


def mesh_file(name: str, folder: Path) -> Path:
    """Return where the mesh file of a URDF stands: file://, package:// or relative to folder."""
    if name.startswith('package://'):
        from ament_index_python.packages import (
            get_package_share_directory, PackageNotFoundError)
        package, _, rest = name[len('package://'):].partition('/')
        try:
            return Path(get_package_share_directory(package)) / rest
        except PackageNotFoundError as exc:
            raise UrdfError(f'{name}: the package {package!r} is not in this environment: build '
                            'and source the workspace that holds it') from exc
    return folder / name.removeprefix('file://')


def _pose(origin: ElementTree.Element | None) -> Array:
    roll, pitch, yaw = _numbers(origin, 'rpy', (0.0, 0.0, 0.0))
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    pose = np.eye(4)
    pose[:3, :3] = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                    [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                    [-sp, cp * sr, cp * cr]]
    pose[:3, 3] = _numbers(origin, 'xyz', (0.0, 0.0, 0.0))
    return pose


def _numbers(element: ElementTree.Element | None, name: str,
             default: tuple[float, float, float]) -> Array:
    text = None if element is None else element.get(name)
    try:
        values = np.array(default if text is None else text.split(), dtype=float)
    except ValueError as exc:
        raise UrdfError(f'{name} must be three numbers, got {text!r}') from exc
    if values.shape != (3,) or not np.isfinite(values).all():
        raise UrdfError(f'{name} must be three numbers, got {text!r}')
    return values

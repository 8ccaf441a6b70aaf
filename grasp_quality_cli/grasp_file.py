# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Grasp files: contacts, bound, load and named tasks in YAML; docs/grasp_files.md is their page.

The names of the fields are those of the Python interface (Contact, TaskCone, ...), and so are the
units and the rules.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias, TypeVar

from grasp_quality import (
    Contact, ContactModel, Grasp, GraspQualityError, TaskCone, TaskEllipsoid, TaskPolytope,
    TaskWrench)
from grasp_quality.bounds import BOUNDS
from grasp_quality_cli.source_item import FileError, SourceItem
from grasp_quality_cli.yaml_source import load_yaml
from msg_adapters.poses import rotation_matrix
import numpy as np
from numpy.typing import NDArray

Task: TypeAlias = TaskWrench | TaskCone | TaskPolytope | TaskEllipsoid
Made = TypeVar('Made')

WRENCH = 'fx fy fz [N] tx ty tz [N m]'
PHYSICS = ('model', 'friction', 'torsional_friction', 'max_normal_force')
FRAMES = ('normal', 'rotation', 'quaternion')
CONTACT = ('name', 'finger', 'position', *FRAMES, *PHYSICS)
KINDS = ('wrench', 'cone', 'polytope', 'ellipsoid')


class Quaternion(NamedTuple):
    """Rotation of a contact frame as in geometry_msgs/Quaternion."""

    x: float
    y: float
    z: float
    w: float


@dataclass(frozen=True, eq=False)
class GraspFile:
    """
    What a grasp file holds.

    Attributes
    ----------
    path : str
    grasp : Grasp
    external_wrench : (6,) array [N, N m] or None
        What the world applies on the object besides the fingers, about the object frame's origin.
    tasks : mapping of str to TaskWrench, TaskCone, TaskPolytope or TaskEllipsoid

    """

    path: str
    grasp: Grasp
    external_wrench: NDArray[np.float64] | None
    tasks: Mapping[str, Task]


def read_grasp_file(path: Path | str) -> GraspFile:
    """
    Read a grasp file.

    Raises
    ------
    FileError
        Names file, line and field.

    """
    return read_grasp(load_yaml(path))


def read_grasp(source: SourceItem, also: Sequence[str] = ()) -> GraspFile:
    """
    Read a grasp with its load and tasks, from a file or a row of a dataset.

    Parameters
    ----------
    source : SourceItem
        A mapping with the fields of a grasp file.
    also : sequence of str
        Further fields that may be there and are not read.

    Raises
    ------
    FileError

    """
    known = ('bound', 'defaults', 'contacts', 'external_wrench', 'tasks')
    fields = source.fields((*known, *also), required=('contacts',))
    defaults = _physics(fields['defaults'].fields(PHYSICS)) if 'defaults' in fields else {}
    contacts = [_contact(item, defaults) for item in fields['contacts'].items()]
    bound = fields['bound'].choice(tuple(BOUNDS)) if 'bound' in fields else 'linf'
    load = fields.get('external_wrench')
    tasks = fields['tasks'].named_items() if 'tasks' in fields else {}
    return GraspFile(
        source.file, _made(fields['contacts'], lambda: Grasp(contacts, bound)),
        None if load is None else load.numbers(6, WRENCH),
        {name: read_task(item) for name, item in tasks.items()})


def read_task(item: SourceItem) -> Task:
    """Read one task: a mapping with exactly one of wrench, cone, polytope and ellipsoid."""
    fields = item.fields(KINDS)
    if len(fields) != 1:
        item.fail(f'must have exactly one of {", ".join(KINDS)}, got {len(fields)}')
    (kind, value), = fields.items()
    readers: dict[str, Callable[[SourceItem], Task]] = {
        'wrench': lambda i: TaskWrench(i.numbers(6, WRENCH)), 'cone': _cone,
        'polytope': _polytope, 'ellipsoid': lambda i: TaskEllipsoid(
            _wrenches(i.fields(('axes',), required=('axes',))['axes']))}
    return _made(value, lambda: readers[kind](value))


def _cone(item: SourceItem) -> Task:
    axes = ('axis', 'lateral_x', 'lateral_y')
    fields = item.fields((*axes, 'half_angle', 'surface_samples'), required=(*axes, 'half_angle'))
    samples = fields['surface_samples'].number() if 'surface_samples' in fields else 32.0
    if not samples.is_integer():
        fields['surface_samples'].fail(f'must be a whole number, got {samples:g}')
    axis, lateral_x, lateral_y = (fields[name].numbers(6, WRENCH) for name in axes)
    return TaskCone(axis, lateral_x, lateral_y, fields['half_angle'].number(), int(samples))


def _polytope(item: SourceItem) -> Task:
    fields = item.fields(('wrenches', 'weights'), required=('wrenches',))
    weights = fields.get('weights')
    return TaskPolytope(
        _wrenches(fields['wrenches']),
        None if weights is None else np.array([w.number() for w in weights.items()]))


def _wrenches(item: SourceItem) -> NDArray[np.float64]:
    return np.array([row.numbers(6, WRENCH) for row in item.items()]).reshape(-1, 6)


def _physics(fields: Mapping[str, SourceItem]) -> dict[str, Any]:
    """Read those of the fields model, friction, torsional_friction, max_normal_force."""
    found: dict[str, Any] = {
        name: item.number() for name, item in fields.items() if name in PHYSICS[1:]}
    if 'model' in fields:
        found['model'] = ContactModel[fields['model'].choice([m.name for m in ContactModel])]
    return found


def _contact(item: SourceItem, defaults: Mapping[str, Any]) -> Contact:
    fields = item.fields(CONTACT, required=('position',))
    frames = [name for name in FRAMES if name in fields]
    if len(frames) != 1:
        item.fail(f'must have exactly one of {", ".join(FRAMES)}, got {len(frames)}')
    arguments = {**defaults, **_physics(fields), **_frame(fields[frames[0]], frames[0])}
    for name in ('name', 'finger'):
        arguments[name] = fields[name].text() if name in fields else ''
    # each its own finger, as for contacts in messages
    arguments['finger'] = arguments['finger'] or arguments['name']
    position = fields['position'].numbers(3, 'x y z [m]')
    return _made(item, lambda: Contact(position, **arguments), fields)


def _frame(item: SourceItem, kind: str) -> dict[str, Any]:
    if kind == 'normal':
        return {'normal': item.numbers(3, 'x y z, into the object')}
    if kind == 'rotation':
        rows = item.items()
        if len(rows) != 3:
            item.fail(f'must hold 3 rows of 3 numbers, got {len(rows)}')
        return {'rotation': np.array([row.numbers(3, 'one row') for row in rows])}
    quaternion = Quaternion(*item.numbers(4, 'x y z w'))
    return {'rotation': _made(item, lambda: rotation_matrix(quaternion, 'it'))}


def _made(item: SourceItem, make: Callable[[], Made],
          fields: Mapping[str, SourceItem] | None = None) -> Made:
    """Make an object of the core; its complaint gets the line of the field that it names."""
    try:
        return make()
    except FileError:
        raise
    except GraspQualityError as exc:
        words = str(exc).split()
        named = [fields[word] for word in words if word in fields] if fields else []
        (named or [item])[0].fail(f'cannot be used: {exc}')

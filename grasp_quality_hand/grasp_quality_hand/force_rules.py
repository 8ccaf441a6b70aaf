# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What must hold of every set of contact forces that a quality node publishes, in plain numpy.

Written a second time from docs/conventions.md on purpose: nothing here comes from the core or from
the adapters, so that a mistake there does not hide itself. All functions return sentences, one for
each rule that is broken.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BALANCE = 1e-6  # of the caps' sum; torques over the largest distance from the contacts' mean
CONE = 1e-6     # of a cone usage or a use of the bound
PLACE = 1e-9    # of positions [m, relative above one] and unit normals [-]
UNIT = 1e-6     # of the length of a normal
JOINT = 1e-6    # of a joint's largest torque
UNKNOWN = np.full(6, np.nan)  # no column: a node must refuse such joint limits
SMALL = 1e-6    # share of the cap below which a contact counts as not loaded
NO_LENGTH = 1e-12  # [m]
COINCIDENT = 1e-8  # distance over distance from the origin of points that are the same
BLUR = 1e-15    # of a force, in any direction: what float64 components keep of it


@dataclass(frozen=True)
class Limits:
    """
    What one contact may carry.

    Parameters
    ----------
    position : (3,) array [m]
    R : (3, 3) array
        Axes of the contact frame in the object frame; the third is the inward normal.
    friction, torsional_friction, cap : float [-], [m], [N]
        0 where the contact model has none.
    finger : str

    """

    position: Array
    R: Array
    friction: float
    torsional_friction: float
    cap: float
    finger: str


@dataclass(frozen=True)
class Joint:
    """
    What the motor of a joint may be asked for.

    Parameters
    ----------
    name : str
    max_torque, gravity_torque : float [N m]
    columns : mapping of contact names to (6,) arrays [m, -]
        Torque for each newton and newton metre of that contact's wrench in the object's axes.

    """

    name: str
    max_torque: float
    gravity_torque: float
    columns: Mapping[str, Array]


@dataclass(frozen=True)
class Force:
    """
    What a node says that one contact shall do to the object.

    Parameters
    ----------
    name : str
    position, normal : (3,) arrays [m], [-]
    wrench : (6,) array [N, N m]
        Of the finger on the object, in the axes of the object frame, about position.
    cone_usage : float

    """

    name: str
    position: Array
    normal: Array
    wrench: Array
    cone_usage: float


def broken_alone(forces: Sequence[Force], cap: float) -> list[str]:
    """Tell what is wrong whatever the contacts were; no contact has a cap above ``cap`` [N]."""
    said = []
    if len({force.name for force in forces}) < len(forces):
        said.append('a contact has two forces')
    for force in forces:
        numbers = np.concatenate([force.position, force.normal, force.wrench, [force.cone_usage]])
        if not np.isfinite(numbers).all():
            said.append(f'{force.name}: not finite: {numbers.tolist()}')
            continue
        n = float(force.wrench[:3] @ force.normal)
        if abs(float(np.linalg.norm(force.normal)) - 1.0) > UNIT:
            said.append(f'{force.name}: its normal is no unit vector')
        if n < -CONE * cap:
            said.append(f'{force.name}: it pulls with {-n:.6g} N')
        if n > 10.0 * SMALL * cap and not 0.0 <= force.cone_usage <= 1.0 + CONE:
            said.append(f'{force.name}: its cone usage is {force.cone_usage:.9g}')
    return said


def broken_forces(forces: Sequence[Force], limits: Mapping[str, Limits], bound: str) -> list[str]:
    """Tell what is wrong with each force by itself, and with all of them under the bound."""
    said = []
    if len({force.name for force in forces}) < len(forces):
        said.append('a contact has two forces')
    use: dict[str, list[float]] = {}
    for force in forces:
        numbers = np.concatenate([force.position, force.normal, force.wrench, [force.cone_usage]])
        if not np.isfinite(numbers).all():
            said.append(f'{force.name}: not finite: {numbers.tolist()}')
        elif force.name not in limits:
            said.append(f'{force.name}: no such contact was received')
        else:
            own = limits[force.name]
            said += [f'{force.name}: {text}' for text in _broken_force(force, own)]
            share = float(force.wrench[:3] @ own.R[:, 2]) / own.cap
            use.setdefault(own.finger if bound == 'finger' else force.name, []).append(share)
    order = {'linf': np.inf, 'finger': np.inf, 'l1': 1, 'l2': 2}[bound]
    used = float(np.linalg.norm([sum(group) for group in use.values()] or [0.0], order))
    if used > 1.0 + CONE:
        said.append(f'{used:.9g} of the bound {bound} is used')
    return said


def _broken_force(force: Force, own: Limits) -> list[str]:
    said = []
    far = np.abs(force.position - own.position).max()
    if far > PLACE * max(1.0, float(np.abs(own.position).max())):
        said.append(f'its point is {far:.3g} m from where the contact was received')
    if np.abs(force.normal - own.R[:, 2]).max() > PLACE:
        said.append('its normal is not that of the contact received')
    local, moment = own.R.T @ force.wrench[:3], own.R.T @ force.wrench[3:]
    n, small = float(local[2]), SMALL * own.cap
    if n < -CONE * own.cap:
        said.append(f'it pulls with {-n:.6g} N')
    if np.abs(moment[:2]).max() > small:
        said.append('it has a moment that is not about the normal')
    carried = np.array([local[0], local[1], moment[2]])
    coefficient = np.array([own.friction, own.friction, own.torsional_friction])
    if (np.abs(carried[coefficient == 0.0]) > small).any():
        said.append('it carries what its contact model cannot')
        return said
    parts = np.divide(carried, coefficient, out=np.zeros(3), where=coefficient > 0.0)
    norm = float(np.linalg.norm(parts))
    blur = BLUR / (own.friction or 1.0)
    if norm > n * (1.0 + CONE + blur) + CONE * small:
        said.append(f'it lies outside its friction cone: what it carries along the surface takes '
                    f'{norm:.9g} N along the normal, it has {n:.9g} N')
    if n > 10.0 * small and abs(norm / n - force.cone_usage) > CONE + blur:
        said.append(f'its cone usage is {norm / n:.9g}, not {force.cone_usage:.9g}')
    return said


def broken_joints(forces: Sequence[Force], joints: Sequence[Joint]) -> list[str]:
    """Tell which joints the forces, all of them of contacts received, ask for too much torque."""
    said = []
    for joint in joints:
        torque = joint.gravity_torque + sum(
            float(joint.columns.get(force.name, UNKNOWN) @ force.wrench) for force in forces)
        if not abs(torque) <= joint.max_torque * (1.0 + JOINT):
            said.append(f'joint {joint.name} needs {torque:.9g} N m of {joint.max_torque:.9g}')
    return said


def broken_balance(
        forces: Sequence[Force], limits: Mapping[str, Limits], wanted: Array) -> list[str]:
    """
    Tell whether the forces do not add up to the wanted wrench.

    Parameters
    ----------
    forces : sequence of Force
        At least one.
    limits : mapping of names to Limits
        Of all these forces.
    wanted : (6,) array [N, N m]
        alpha times the task, less the external wrench, about the object frame's origin.

    """
    points = np.array([force.position for force in forces])
    center = points.mean(axis=0)
    total = np.zeros(6)
    for force in forces:
        total[:3] += force.wrench[:3]
        total[3:] += force.wrench[3:] + np.cross(force.position - center, force.wrench[:3])
    missing = wanted - total
    missing[3:] -= np.cross(center, wanted[:3])
    caps = sum(limits[force.name].cap for force in forces)
    reach = float(np.linalg.norm(points - center, axis=1).max())
    if reach <= max(COINCIDENT * float(np.abs(center).max()), NO_LENGTH):
        reach = 0.0  # what rounding leaves is no arm
    arm = max(reach, max(limits[force.name].torsional_friction for force in forces))
    if arm <= NO_LENGTH:
        arm = max(1.0, float(np.abs(center).max()))
    # numbers about an origin that is far away carry the rounding of that distance
    size = caps + float(np.abs(wanted[:3]).max())
    rounding = 1e-14 * size * float(np.abs(points).max()) / arm
    left = float(np.linalg.norm(np.concatenate([missing[:3], missing[3:] / arm])))
    allowed = BALANCE * size + rounding
    if not left <= allowed:
        force, moment = np.linalg.norm(missing[:3]), np.linalg.norm(missing[3:])
        return [f'{force:.6g} N and {moment:.6g} N m are missing to alpha task - external wrench '
                f'(allowed: {allowed:.3g} N, moments over {arm:.3g} m)']
    return []

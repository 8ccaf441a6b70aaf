# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the page shows at one instant, as plain numbers, from what was heard.

Contacts come from the node's own input topic, read with the node's own parameters; forces, alpha
and the map from its outputs. Nothing of an answer is in the picture unless it is OPTIMAL and
fresh.
"""

from dataclasses import dataclass, field
from typing import Any

from grasp_quality.contact import Contact, ContactModel
from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import GraspQualityError
from grasp_quality.grasp import Grasp
from grasp_quality.measures import slip_margin
from grasp_quality_hand.viewer_heard import Heard
from grasp_quality_msgs.msg import ForceMap, GraspQuality, ResultCode
from msg_adapters.contacts import ContactDefaults, contacts_from_array, contacts_from_poses
from msg_adapters.marker_geometry import automatic_force_scale
from msg_adapters.measured import local_force
from msg_adapters.wrenches import wrench_array
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PARAMETERS = ['contact_source', 'contact_names', 'contact_fingers', 'contact_model',
              'friction_coefficient', 'torsional_friction_coefficient', 'max_normal_force']


@dataclass(frozen=True, eq=False)
class Picture:
    """
    What is shown; forces are those of the fingers on the object, in the object frame.

    Attributes
    ----------
    grasp : Grasp or None
        All contacts heard of.
    optimal, usage : (k, 3) array [N], (k,) array [-]
        Of the live answer; NaN for contacts without one.
    measured, margins : (k, 3) array [N], (k,) array [-]
        NaN where nothing was measured.
    quality : GraspQuality or None
        The newest, unless it is stale.
    age : float or None
        Since the last quality [s]; None when there never was one.
    stale : bool
        Whether the node has fallen silent, or never spoke.
    alpha_task : (6,) array [N, N m]
        alpha times the task, zero without an answer.
    force_map : ForceMap or None
        The same object as long as it is the same map.
    metres_per_newton : float
        Scale of all forces.
    problem : str
        Why contacts cannot be shown; empty when they can.

    """

    grasp: Grasp | None = None
    optimal: Array = field(default_factory=lambda: np.zeros((0, 3)))
    usage: Array = field(default_factory=lambda: np.zeros(0))
    measured: Array = field(default_factory=lambda: np.zeros((0, 3)))
    margins: Array = field(default_factory=lambda: np.zeros(0))
    quality: GraspQuality | None = None
    age: float | None = None
    stale: bool = True
    alpha_task: Array = field(default_factory=lambda: np.zeros(6))
    force_map: ForceMap | None = None
    metres_per_newton: float = 0.0
    problem: str = ''


def defaults_from(parameters: dict[str, Any]) -> ContactDefaults:
    """Return what contact messages leave open, by the node's parameters."""
    return ContactDefaults(
        ContactModel[parameters['contact_model']], parameters['friction_coefficient'],
        parameters['torsional_friction_coefficient'], parameters['max_normal_force'],
        tuple(parameters['contact_names'] or ()), tuple(parameters['contact_fingers'] or ()))


def take_picture(heard: Heard, defaults: ContactDefaults, now: float) -> Picture:
    """
    Put together what was heard.

    Parameters
    ----------
    heard : Heard
        The newest message of every topic.
    defaults : ContactDefaults
        Of the node, for what contact messages leave open.
    now : float
        Time of the steady clock [s].

    """
    stale, age = heard.freshness.stale(now), heard.freshness.age(now)
    if stale:
        return Picture(age=age)
    quality = heard.quality
    answered = quality.result.code == ResultCode.OPTIMAL
    forces = list(heard.forces.forces) if answered and heard.forces is not None else []
    gone = quality.result.code in (ResultCode.NO_CONTACTS, ResultCode.STALE_CONTACTS)
    try:
        grasp = _grasp(None if gone else heard.contacts, forces, defaults)
        if grasp is None:
            return Picture(quality=quality, age=age, stale=False)
        measured, margins = _measured(grasp, heard, now)
        optimal, usage = _optimal(grasp, forces)
        return Picture(
            grasp=grasp, optimal=optimal, usage=usage, measured=measured, margins=margins,
            quality=quality, age=age, stale=False,
            alpha_task=quality.alpha * wrench_array(quality.task_wrench, 'task_wrench'),
            force_map=heard.force_map if answered else None,
            metres_per_newton=automatic_force_scale(grasp.lever_arm, grasp.force_scale))
    except GraspQualityError as exc:
        return Picture(quality=quality, age=age, stale=False, problem=str(exc))


def _grasp(contacts: Any, forces: list[Any], defaults: ContactDefaults) -> Grasp | None:
    found: ContactSet | None = None
    if contacts is not None:
        read = contacts_from_poses if hasattr(contacts, 'poses') else contacts_from_array
        found = read(contacts, defaults)
    elif forces:  # a node whose inputs cannot be heard still tells where its forces act
        found = ContactSet.of([_contact(item, defaults) for item in forces])
    return Grasp(found) if found is not None and len(found) else None


def _contact(item: Any, defaults: ContactDefaults) -> Contact:
    point, normal = item.position, item.normal
    return Contact(
        np.array([point.x, point.y, point.z]), np.array([normal.x, normal.y, normal.z]),
        model=defaults.model, friction=defaults.friction,
        torsional_friction=defaults.torsional_friction,
        max_normal_force=defaults.max_normal_force, name=item.name)


def _optimal(grasp: Grasp, forces: list[Any]) -> tuple[Array, Array]:
    optimal, usage = np.full((len(grasp), 3), np.nan), np.full(len(grasp), np.nan)
    for item in forces:
        if item.name in grasp.names:
            i, force = grasp.names.index(item.name), item.wrench.force
            optimal[i], usage[i] = (force.x, force.y, force.z), item.cone_usage
    return optimal, usage


def _measured(grasp: Grasp, heard: Heard, now: float) -> tuple[Array, Array]:
    local = np.zeros((len(grasp), 4))
    known = np.zeros(len(grasp), bool)
    wrenches, frame = heard.measured_now(now), heard.quality.header.frame_id
    for i, name in enumerate(grasp.names):
        if name in wrenches:
            try:
                local[i] = local_force(wrenches[name], grasp.contacts[i], frame)
                known[i] = True
            except GraspQualityError:
                continue  # the node itself names it on /diagnostics
    forces = np.einsum('kij,kj->ki', grasp.rotations, local[:, :3])
    margins = np.clip(slip_margin(grasp, local), -1.0, 1.0)
    forces[~known], margins[~known] = np.nan, np.nan
    return forces, margins

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Parts that the audit of forces is made of: what one message says, without ROS.

``audit_messages`` makes them of messages, ``force_records`` puts them together.
"""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property

from grasp_quality_hand.force_rules import Array, Force, Joint, Limits
import numpy as np


@dataclass(frozen=True)
class Settings:
    """Parameters of the node that decide what forces it may publish; names as there."""

    contact_model: str
    friction_coefficient: float
    torsional_friction_coefficient: float
    max_normal_force: float
    force_bound: str
    contact_names: tuple[str, ...]
    contact_fingers: tuple[str, ...]
    max_contact_age: float
    contact_source: str = 'pose_array'


@dataclass(frozen=True)
class ReceivedContact:
    """A contact as it was published; None and '' stand for the node's default."""

    position: Array
    R: Array
    name: str = ''
    finger: str = ''
    model: str = ''
    friction: float | None = None
    torsional_friction: float | None = None
    cap: float | None = None


@dataclass(frozen=True)
class ReceivedJoint:
    """Torque limit of a joint as it was published, with one column (6,) for each contact."""

    name: str
    max_torque: float
    gravity_torque: float
    columns: Sequence[Array]


@dataclass(frozen=True)
class Contacts:
    """All contacts of one message; are_poses: a PoseArray, whose names are parameters."""

    stamp: int
    frame: str
    contacts: Sequence[ReceivedContact]
    are_poses: bool
    joints: Sequence[ReceivedJoint] = ()

    @cached_property
    def content(self) -> Hashable:
        """All that two messages of one stamp may differ in."""
        contacts = tuple((c.position.tobytes(), c.R.tobytes(), c.name, c.finger, c.model,
                          c.friction, c.torsional_friction, c.cap) for c in self.contacts)
        joints = tuple((j.name, j.max_torque, j.gravity_torque,
                        *(column.tobytes() for column in j.columns)) for j in self.joints)
        return self.frame, self.are_poses, contacts, joints

    def may_be_of(self, settings: Settings) -> bool:
        """Tell whether a node of these parameters listens to messages of this kind."""
        own = 'pose_array' if self.are_poses else 'contact_array'
        return settings.contact_source in (own, '')  # '': not known


@dataclass(frozen=True)
class Quality:
    """What a GraspQuality message says."""

    stamp: int
    optimal: bool
    alpha: float
    others: tuple[float, ...]  # that must be 0 on failure
    task: Array
    load: Array

    @cached_property
    def content(self) -> Hashable:
        """All that two messages of one stamp may differ in, as far as forces go."""
        return self.optimal, self.alpha, self.task.tobytes(), self.load.tobytes()


@dataclass(frozen=True)
class Forces:
    """
    What a ContactForceArray says.

    ``age_s`` by stamp when it was sent, None if unknown; ``are_holding`` when they are to balance
    the load alone.

    """

    stamp: int
    frame: str
    forces: Sequence[Force]
    age_s: float | None
    are_holding: bool = False

    @cached_property
    def content(self) -> Hashable:
        """All that two messages of one stamp may differ in, as far as single wrenches go."""
        return self.are_holding, tuple((f.name, f.wrench.tobytes()) for f in self.forces)


@dataclass(frozen=True)
class LocalWrench:
    """What ``optimal_wrenches/<name>`` says; it must be in the frame of that contact."""

    stamp: int
    name: str
    frame: str
    wrench: Array


def limits_of(received: Contacts, settings: Settings) -> dict[str, Limits]:
    """Fill in the node's defaults."""
    limits = {}
    for i, contact in enumerate(received.contacts):
        name, finger = contact.name or f'contact_{i}', contact.finger
        if received.are_poses and i < len(settings.contact_names):
            name = settings.contact_names[i]
        if received.are_poses and i < len(settings.contact_fingers):
            finger = settings.contact_fingers[i]
        model = contact.model or settings.contact_model
        mu = settings.friction_coefficient if contact.friction is None else contact.friction
        gamma = (settings.torsional_friction_coefficient if contact.torsional_friction is None
                 else contact.torsional_friction)
        limits[name] = Limits(
            contact.position, contact.R, 0.0 if model == 'FPC' else mu,
            gamma if model == 'SFCE' else 0.0,
            settings.max_normal_force if contact.cap is None else contact.cap, finger or name)
    return limits


def limits_alone(forces: Sequence[Force], settings: Settings) -> dict[str, Limits]:
    """Limits of contacts that came as poses, from what their forces say of them."""
    names = settings.contact_names
    fingers = {names[i] if i < len(names) else f'contact_{i}': finger
               for i, finger in enumerate(settings.contact_fingers)}
    return limits_of(Contacts(0, '', [
        ReceivedContact(force.position, _axes_along(force.normal), force.name,
                        fingers.get(force.name, '')) for force in forces], False), settings)


def _axes_along(normal: Array) -> Array:
    side = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    side /= np.linalg.norm(side)
    return np.column_stack([side, np.cross(normal, side), normal])


def joints_of(received: Contacts, names: Sequence[str]) -> list[Joint]:
    """Give the columns of every joint the names of the contacts that they belong to, in order."""
    return [Joint(joint.name, joint.max_torque, joint.gravity_torque,
                  dict(zip(names, joint.columns))) for joint in received.joints]

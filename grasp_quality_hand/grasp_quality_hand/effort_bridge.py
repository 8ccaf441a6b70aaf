# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contact forces to joint efforts, one tick at a time, with no ROS in it.

Every tick either follows the newest contact forces, tau = J^T f + gravity, or, when anything that
this needs is missing, stale or wrong, holds. What is needed: forces that are not empty, all joint
angles, and, for forces in the object frame, where the object is.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from grasp_quality_hand.contact_pushes import contact_efforts, Pushes, saturated
from grasp_quality_hand.effort_command import EffortCommand, Phase
from grasp_quality_hand.effort_inputs import Newest, Now, Unusable
from grasp_quality_hand.hand_kinematics import HandKinematics
from msg_adapters.errors import InvalidMessageError
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LONGEST_STEP_S = 0.05  # that slew limit and ramp count after a pause


@dataclass(frozen=True)
class Joints:
    """Joint states by name: angles, and rates and efforts where they are told."""

    positions: Mapping[str, float]
    rates: Mapping[str, float] = field(default_factory=dict)
    efforts: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class FramedPushes:
    """Contact forces and the frame that they stand in, or what is wrong with their message."""

    frame: str
    pushes: Pushes
    problem: str = ''


@dataclass(frozen=True)
class ObjectPose:
    """Where the object frame stands: x_frame = R x_object + p [m]."""

    frame: str
    R: Array
    p: Array


@dataclass(frozen=True)
class Report:
    """What a tick did: the phase, why it does not follow, and the scale of the forces."""

    phase: Phase
    reason: str
    scale: float
    blind: bool


class EffortBridge:
    """
    The bridge.

    Parameters
    ----------
    hand : HandKinematics
    links : dict of str to str
        Link that makes each contact, by the contact's name.
    command : EffortCommand
    max_force_age, max_joint_age, max_pose_age : float
        [s]
    object_frame : str
        Frame that the poses of the object are of.
    compensate_gravity : bool
        Whether the efforts carry the hand's own links.
    period : float
        Between ticks [s].

    """

    def __init__(self, hand: HandKinematics, links: Mapping[str, str], command: EffortCommand,
                 max_force_age: float, max_joint_age: float, max_pose_age: float,
                 object_frame: str, compensate_gravity: bool = True,
                 period: float = 0.0) -> None:
        for link in links.values():
            hand.check_link(link)
        self._hand, self._links, self._command = hand, dict(links), command
        self.forces: Newest[FramedPushes] = Newest('contact forces', max_force_age)
        self.joints: Newest[Joints] = Newest('joint states', max_joint_age)
        self.poses: Newest[ObjectPose] = Newest('poses of the object', max_pose_age)
        self._object_frame = object_frame
        self._gravity = compensate_gravity
        self._last_s: float | None = None
        self._longest_hold_step_s = max(LONGEST_STEP_S, period)
        self.ending = ''  # why nothing shall be followed any more

    def check_count(self, count: int) -> None:
        """Refuse more forces than there are contacts, before anybody reads them."""
        if count > len(self._links):
            raise InvalidMessageError(f'{count} came for {len(self._links)} contact_names')

    def ages(self, now: Now) -> dict[str, float]:
        """Ages of the newest inputs [s]."""
        return {'forces': self.forces.age(now), 'joint states': self.joints.age(now),
                'object pose': self.poses.age(now)}

    def tick(self, now: Now) -> tuple[Array | None, Report]:
        """
        Work out the efforts of this instant.

        Returns
        -------
        (n,) array to command, or None where nothing shall be; Report

        """
        period = 0.0 if self._last_s is None else max(0.0, now.steady_s - self._last_s)
        self._last_s = now.steady_s
        try:
            if self.ending:
                raise Unusable(self.ending)
            wanted, scale = self._wanted(now)
        except Unusable as error:
            return self._hold(str(error), period, now)
        except Exception as error:  # of Pinocchio or our own: never a reason to stop commanding
            return self._hold(f'internal error, please report it: {type(error).__name__}: {error}',
                              period, now)
        efforts = self._command.follow(wanted, min(period, LONGEST_STEP_S))
        return efforts, Report(self._command.phase, '', scale, False)

    def _hold(self, reason: str, period: float, now: Now) -> tuple[Array | None, Report]:
        positions = rates = None
        try:
            joints = self.joints.fresh(now)
            positions = self._of_motors(joints.positions)
            rates = self._of_motors(joints.rates)
        except Unusable:
            pass
        efforts = self._command.hold(
            min(period, self._longest_hold_step_s), positions, rates)
        return efforts, Report(self._command.phase, reason, 0.0, positions is None)

    def _wanted(self, now: Now) -> tuple[Array, float]:
        """Efforts (n,) [N m, N] of the newest forces, and their scale."""
        joints, framed = self.joints.fresh(now), self.forces.fresh(now)
        missing = [name for name in self._hand.movable if name not in joints.positions]
        if missing:
            raise Unusable(f'the joint states lack {missing}')
        pushes = framed.pushes
        if framed.problem:
            raise Unusable(framed.problem)
        if not pushes.names:
            raise Unusable('the contact forces are empty: there is no answer, see ~/quality')
        strangers = [name for name in pushes.names if name not in self._links]
        if strangers:
            raise Unusable(f'contacts {strangers} have no link: name them in contact_names and '
                           'contact_links; without them the others are out of balance')
        if framed.frame != self._hand.base_frame:
            if framed.frame != self._object_frame:
                raise Unusable(f'the contact forces stand in {framed.frame!r}, which is neither '
                               f'base_frame {self._hand.base_frame!r} nor object_frame '
                               f'{self._object_frame!r}')
            pose = self.poses.fresh(now)
            if pose.frame != self._hand.base_frame:
                raise Unusable(f'the pose of the object stands in {pose.frame!r}, and not in the '
                               f'base frame {self._hand.base_frame!r}')
            pushes = pushes.moved(pose.R, pose.p)
        self._hand.update(np.array([joints.positions[name] for name in self._hand.movable]))
        if not self._command.begun:
            measured = self._of_motors(joints.efforts)
            if measured is not None:
                self._command.begin(measured)
        efforts = contact_efforts(self._hand, [self._links[n] for n in pushes.names], pushes)
        offset = self._hand.gravity_efforts() if self._gravity else np.zeros_like(efforts)
        wanted, scale = saturated(efforts, offset, self._hand.effort_limits)
        if not np.isfinite(wanted).all():
            raise Unusable('the forces are too large to compute with')
        return wanted, scale

    def _of_motors(self, values: Mapping[str, float]) -> Array | None:
        if not all(name in values for name in self._hand.joints):
            return None
        return np.array([values[name] for name in self._hand.joints])

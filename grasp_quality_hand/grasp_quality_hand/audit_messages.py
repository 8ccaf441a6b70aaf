# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of a quality node, taken apart into parts for ``force_records``.

Written apart from msg_adapters on purpose: see ``force_rules``. The last argument of each is the
time the message was sent [ns].
"""

from typing import Any

from geometry_msgs.msg import PoseArray, Wrench, WrenchStamped
from grasp_quality_hand.audit_parts import (
    Contacts, Forces, LocalWrench, Quality, ReceivedContact, ReceivedJoint)
from grasp_quality_hand.force_rules import Array, Force
from grasp_quality_msgs.msg import (
    Contact, ContactArray, ContactForceArray, GraspQuality, ResultCode)
import numpy as np

MODELS = {Contact.MODEL_FPC: 'FPC', Contact.MODEL_PCWF: 'PCWF', Contact.MODEL_SFCE: 'SFCE'}


def nanoseconds(stamp: Any) -> int:
    """Return a Time message in nanoseconds."""
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


def xyz(message: Any) -> Array:
    """Return a Point or Vector3 as (3,)."""
    return np.array([message.x, message.y, message.z])


def six(message: Wrench) -> Array:
    """Return a Wrench as (6,)."""
    return np.concatenate([xyz(message.force), xyz(message.torque)])


def axes(q: Any) -> Array:
    """Turn a quaternion into the axes of its frame, (3, 3); the third is the inward normal."""
    v, w = np.array([q.x, q.y, q.z]), q.w
    norm = v @ v + w * w
    if not norm > 0.0:
        return np.full((3, 3), np.nan)
    skew = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    turned: Array = np.eye(3) + 2.0 * (w * skew + skew @ skew) / norm
    return turned


def read_poses(message: PoseArray, sent_ns: int) -> Contacts:
    """Take a PoseArray apart."""
    return Contacts(
        nanoseconds(message.header.stamp), message.header.frame_id,
        [ReceivedContact(xyz(pose.position), axes(pose.orientation)) for pose in message.poses],
        are_poses=True)


def read_contacts(message: ContactArray, sent_ns: int) -> Contacts:
    """Take a ContactArray apart."""
    return Contacts(
        nanoseconds(message.header.stamp), message.header.frame_id,
        [ReceivedContact(
            xyz(c.pose.position), axes(c.pose.orientation), c.name, c.finger,
            MODELS.get(c.model, ''), c.friction_coefficient or None,
            c.torsional_friction_coefficient or None, c.max_normal_force or None)
         for c in message.contacts], are_poses=False,
        joints=[ReceivedJoint(
            j.name, j.max_torque, j.gravity_torque,
            [np.concatenate([xyz(t.linear), xyz(t.angular)]) for t in j.twists])
            for j in message.joint_limits])


def read_quality(message: GraspQuality, sent_ns: int) -> Quality:
    """Take a GraspQuality apart."""
    return Quality(
        nanoseconds(message.header.stamp), message.result.code == ResultCode.OPTIMAL,
        message.alpha, (message.alpha_upper, message.alpha_lower, message.friction_margin),
        six(message.task_wrench), six(message.external_wrench))


def read_forces(message: ContactForceArray, sent_ns: int) -> Forces:
    """Take a ContactForceArray apart."""
    stamp = nanoseconds(message.header.stamp)
    return Forces(stamp, message.header.frame_id, [read_force(f) for f in message.forces],
                  (sent_ns - stamp) * 1e-9 if stamp else None)


def read_force(message: Any) -> Force:
    """Take a ContactForce apart."""
    return Force(message.name, xyz(message.position), xyz(message.normal), six(message.wrench),
                 message.cone_usage)


def read_alpha(message: Any, sent_ns: int) -> float:
    """Take a Float64 apart."""
    return float(message.data)


def read_wrench(name: str, message: WrenchStamped, sent_ns: int) -> LocalWrench:
    """Take a WrenchStamped apart that came on the topic of a contact of this name."""
    return LocalWrench(nanoseconds(message.header.stamp), name, message.header.frame_id,
                       six(message.wrench))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The contacts between fingers and object, read from MuJoCo."""

from dataclasses import dataclass

import mujoco
import numpy as np

MERGE_DISTANCE = 0.002     # below it two points are one contact seen twice [m]
NEAREST_RANGE = 1.0        # how far an unloaded fingertip may be from the object [m]


@dataclass(frozen=True)
class MeasuredContact:
    """
    One contact and what the finger does there to the object.

    Attributes
    ----------
    finger : int
        Index of the finger.
    position : ndarray, shape (3,)
        Object frame [m].
    R_object_contact : ndarray, shape (3, 3)
        Object frame <- contact frame; the third column is the inward normal.
    force : ndarray, shape (4,)
        [t1, t2, n, m_n] of the finger on the object, in the contact frame [N, N, N, N m].

    """

    finger: int
    position: np.ndarray
    R_object_contact: np.ndarray
    force: np.ndarray

    @property
    def normal(self):
        """Return the inward unit normal in the object frame, shape (3,)."""
        return self.R_object_contact[:, 2]

    @property
    def force_in_object_frame(self):
        """Return the force on the object along the axes of the object frame, shape (3,) [N]."""
        return self.R_object_contact @ self.force[:3]


@dataclass(frozen=True)
class _Point:
    """A contact point with vectors in the object frame; moment is about the normal."""

    finger: int
    position: np.ndarray
    normal: np.ndarray
    force: np.ndarray
    moment: float


def contact_points(hand, data):
    """
    Return every contact of a finger with the object, twins merged.

    The MeasuredContacts are in the order of the fingers.

    """
    points = sorted(_read_points(hand, data), key=lambda point: point.finger)
    return [_measured(_merge(cluster)) for cluster in _clusters(points)]


def finger_contacts(hand, data):
    """
    Return one contact per finger, in the order of the fingers.

    A finger with several points gives their sum at the force-weighted centre.  A finger without
    load gives zero force at its fingertip's point nearest to the object.

    """
    points = [point for point in _read_points(hand, data) if point.force @ point.normal > 0.0]
    contacts = []
    for finger in range(len(hand.tip_geoms)):
        own = [point for point in points if point.finger == finger]
        contacts.append(_measured(_merge(own) if own else _nearest(hand, data, finger)))
    return contacts


def _read_points(hand, data):
    """Yield the contact points of fingers with the object as MuJoCo has them."""
    p_object = data.xpos[hand.object_body]
    R_world_object = data.xmat[hand.object_body].reshape(3, 3)
    wrench = np.zeros(6)    # [n, t1, t2, m_n, ...] of geom1 on geom2, contact frame
    for index in range(data.ncon):
        contact = data.contact[index]
        if hand.object_geom not in contact.geom:
            continue
        object_is_second = contact.geom[1] == hand.object_geom
        finger = hand.finger_of_geom[contact.geom[0 if object_is_second else 1]]
        if finger < 0:
            continue
        mujoco.mj_contactForce(hand.mujoco, data, index, wrench)
        sign = 1.0 if object_is_second else -1.0
        axes = R_world_object.T @ contact.frame.reshape(3, 3).T    # columns: normal, tangents
        yield _Point(int(finger), R_world_object.T @ (contact.pos - p_object), sign * axes[:, 0],
                     sign * axes @ wrench[:3], wrench[3])


def _clusters(points):
    """Group points of one finger that are nearer to the group's first than MERGE_DISTANCE."""
    clusters = []
    for point in points:
        for cluster in clusters:
            first = cluster[0]
            if (first.finger == point.finger
                    and np.linalg.norm(first.position - point.position) < MERGE_DISTANCE):
                cluster.append(point)
                break
        else:
            clusters.append([point])
    return clusters


def _merge(points):
    """Return the one point that stands for points: sum of forces, at their weighted centre."""
    if len(points) == 1:
        return points[0]
    weights = np.array([max(point.force @ point.normal, 0.0) for point in points])
    if weights.sum() == 0.0:
        weights = np.ones(len(points))
    weights /= weights.sum()
    position = weights @ [point.position for point in points]
    normal = weights @ [point.normal for point in points]
    normal /= np.linalg.norm(normal)
    moment = sum(np.cross(point.position - position, point.force) + point.moment * point.normal
                 for point in points) @ normal
    return _Point(points[0].finger, position, normal, sum(point.force for point in points),
                  moment)


def _nearest(hand, data, finger):
    """Return the unloaded contact at the fingertip's point nearest to the object."""
    ends = np.zeros(6)    # nearest point of the fingertip, nearest point of the object; world
    tip = hand.tip_geoms[finger]
    distance = mujoco.mj_geomDistance(hand.mujoco, data, tip, hand.object_geom, NEAREST_RANGE,
                                      ends)
    R_world_object = data.xmat[hand.object_body].reshape(3, 3)
    toward = (ends[3:] - ends[:3]) * np.sign(distance)
    if np.linalg.norm(toward) == 0.0:
        toward = data.xpos[hand.object_body] - ends[:3]
    normal = R_world_object.T @ (toward / np.linalg.norm(toward))
    position = R_world_object.T @ (ends[:3] - data.xpos[hand.object_body])
    return _Point(finger, position, normal, np.zeros(3), 0.0)


def _measured(point):
    """Return the point with its force in a contact frame whose +z is the normal."""
    R = rotation_with_z(point.normal)
    return MeasuredContact(point.finger, point.position, R,
                           np.append(R.T @ point.force, point.moment))


def rotation_with_z(normal):
    """Return a rotation, shape (3, 3), whose third column is the unit vector normal."""
    x, y, z = normal
    sign = 1.0 if z >= 0.0 else -1.0    # no division by anything below 1
    a = 1.0 / (1.0 + sign * z)
    return np.array([[1.0 - a * x * x, -sign * a * x * y, x],
                     [-a * x * y, sign * (1.0 - a * y * y), y],
                     [-sign * x, -y, z]])

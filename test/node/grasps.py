# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Grasps with known answers, as messages, and the arithmetic of messages.

All of them have mu = 0.5, caps of 10 N and the bound linf, the node's defaults (DESIGN values are
for caps of 1).
"""

import copy
import math

from geometry_msgs.msg import Point, Pose, PoseArray, Quaternion, Vector3, Wrench
from grasp_quality_msgs.msg import Contact, ContactArray
import numpy as np
from std_msgs.msg import Header

SOLVER = 1e-6  # relative tolerance of a solved number
FACE = 0.03    # [m]


def wrench(fx=0.0, fy=0.0, fz=0.0, tx=0.0, ty=0.0, tz=0.0):
    """Build a Wrench."""
    return Wrench(force=Vector3(x=fx, y=fy, z=fz), torque=Vector3(x=tx, y=ty, z=tz))


def pose(position, normal):
    """Build a Pose whose +z is the inward normal."""
    x, y, z = (float(v) for v in position)
    nx, ny, nz = np.array(normal, dtype=float) / np.linalg.norm(normal)
    half = Quaternion(x=-ny, y=nx, z=0.0, w=1.0 + nz)  # half way from +z to the normal
    size = math.sqrt(half.x ** 2 + half.y ** 2 + half.w ** 2)
    turn = Quaternion(x=half.x / size, y=half.y / size, z=0.0, w=half.w / size)
    return Pose(position=Point(x=x, y=y, z=z), orientation=turn)


ANTIPODAL = (pose((-1, 0, 0), (1, 0, 0)), pose((1, 0, 0), (-1, 0, 0)))
CIRCLE = tuple(  # three contacts on a sphere's equator
    pose((math.cos(a), math.sin(a), 0), (-math.cos(a), -math.sin(a), 0))
    for a in np.radians([180, 60, -60]))
EIGHT = tuple(  # Fig. 3: four contacts on each of the faces x = +-FACE
    pose((side * FACE, y, z), (-side, 0, 0))
    for side in (-1, 1) for y in (-0.01, 0.01) for z in (-0.01, 0.01))
SINGLE = (pose((0, 0, 0), (1, 0, 0)),)


def pose_array(poses, stamp=None, frame='object'):
    """Build a PoseArray; without a stamp it is not stamped."""
    message = PoseArray(header=Header(frame_id=frame), poses=copy.deepcopy(list(poses)))
    if stamp is not None:
        message.header.stamp = stamp
    return message


def contact_array(poses, stamp=None, frame='object', **fields):
    """Build a ContactArray; each field is a list with one value a contact."""
    message = ContactArray(header=Header(frame_id=frame), contacts=[
        Contact(pose=copy.deepcopy(p), **{name: values[i] for name, values in fields.items()})
        for i, p in enumerate(poses)])
    if stamp is not None:
        message.header.stamp = stamp
    return message


def vector(message):
    """Return x, y, z of a Vector3 or Point (3,)."""
    return np.array([message.x, message.y, message.z])


def numbers(message):
    """Return fx fy fz tx ty tz of a Wrench (6,)."""
    return np.concatenate([vector(message.force), vector(message.torque)])


def total_wrench(forces):
    """Sum the forces of a ContactForceArray to a wrench (6,) about the frame's origin."""
    total = np.zeros(6)
    for item in forces.forces:
        force = vector(item.wrench.force)
        total[:3] += force
        total[3:] += vector(item.wrench.torque) + np.cross(vector(item.position), force)
    return total


def check_forces(forces, friction=0.5, cap=10.0):
    """Assert that every force presses inward, within its cone and its cap."""
    for item in forces.forces:
        force, normal = vector(item.wrench.force), vector(item.normal)
        n = force @ normal
        slide = np.linalg.norm(force - n * normal)
        assert -1e-9 <= n <= cap * (1 + 1e-9)
        assert slide <= friction * n + 1e-8 * cap
        assert -1e-9 <= item.cone_usage <= 1.0 + 1e-9
        if n > 1e-5 * cap:
            assert abs(item.cone_usage - slide / (friction * n)) <= 1e-6

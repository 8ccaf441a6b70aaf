# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Valid contacts, wrenches and joints of every shape and size, as messages."""

from collections.abc import Sequence
import math
from random import Random
from typing import Any

from geometry_msgs.msg import Pose, PoseArray, Twist, Wrench
from grasp_quality_msgs.msg import Contact, ContactArray, JointLimit

FRAME = 'object'
NOW_S = 1_800_000_000  # of the ROS clock
COUNTS = (*(0, 1, 1, 1), *(2,) * 14, *(3,) * 18, *(4,) * 10, 5, 6, 7, 8)
SHAPES = ('ball', 'ball', 'ball', 'ball', 'ball', 'pinch', 'pinch', 'pinch', 'circle', 'circle',
          'circle', 'coincident', 'line', 'parallel')
NO_LOAD = 0.0

Vector = tuple[float, float, float]


class Sizes:
    """Length [m] and force [N] that all parts of one question are made in."""

    def __init__(self, random: Random) -> None:
        ordinary = random.random() < 0.7
        self.length = 0.03 if ordinary else 10.0 ** random.uniform(-4.0, 1.0)
        self.force = 10.0 if ordinary else 10.0 ** random.uniform(-4.0, 4.0)


def direction(random: Random) -> Vector:
    """Return a unit vector."""
    x, y, z = (random.gauss(0.0, 1.0) for _ in range(3))
    size = math.sqrt(x * x + y * y + z * z) or 1.0
    return x / size, y / size, z / size


def wrench(random: Random, force: float, length: float) -> Wrench:
    """Return a wrench of any direction."""
    message = Wrench()
    for part, size in ((message.force, force), (message.torque, force * length)):
        part.x, part.y, part.z = (random.gauss(0.0, size) for _ in range(3))
    if random.random() < 0.2:
        message.torque.x = message.torque.y = message.torque.z = 0.0
    if random.random() < 0.1:
        message.force.x = message.force.y = 0.0
    return message


def load(random: Random, sizes: Sizes) -> Wrench:
    """Return an external wrench: none, light, just in reach, or too heavy."""
    share = random.choice((NO_LOAD, NO_LOAD, NO_LOAD, NO_LOAD, 0.01, 0.1, 0.3, 3.0))
    return wrench(random, share * sizes.force, sizes.length) if share else Wrench()


def _places(random: Random, count: int) -> list[tuple[Vector, Vector]]:
    """Points of about unit size and the inward normals there."""
    shape, tilt = random.choice(SHAPES), random.choice((0.0, 0.2, 0.5))
    away, found = direction(random), []
    for i in range(count):
        point = direction(random)
        if shape == 'pinch':
            point = (1.0 - 2.0 * (i % 2), 0.0, 0.1 * (i // 2))
        elif shape == 'circle':
            angle = math.tau * (i + random.random() * tilt) / max(count, 1)
            point = (math.cos(angle), math.sin(angle), 0.0)
        normal = tuple(-p + random.gauss(0.0, tilt) for p in point)
        if shape == 'coincident':
            point = away
        elif shape == 'line':
            point = tuple(a * (i + 1.0) for a in away)  # type: ignore[assignment]
        elif shape == 'parallel':
            normal = away
        found.append((point, normal))
    return found  # type: ignore[return-value]


def turn_to(pose: Pose, normal: Sequence[float], random: Random) -> None:
    """Give a pose the orientation whose +z is the normal, turned about it by any angle."""
    x, y, z = normal
    size = math.sqrt(x * x + y * y + z * z) or 1.0
    x, y, z = x / size, y / size, z / size
    a, b, c, w = (-y, x, 0.0, 1.0 + z) if z > -0.99 else (1.0, 0.0, 0.0, 0.0)
    half = random.uniform(0.0, math.pi)
    s, k = math.sin(half), math.cos(half)
    a, b, c, w = a * k + b * s, b * k - a * s, c * k + w * s, w * k - c * s
    size = math.sqrt(a * a + b * b + c * c + w * w)
    q = pose.orientation
    q.x, q.y, q.z, q.w = a / size, b / size, c / size, w / size


def pose(random: Random, place: tuple[Vector, Vector], sizes: Sizes, offset: Vector) -> Pose:
    """Return the contact frame at a place."""
    message, (point, normal) = Pose(), place
    message.position.x, message.position.y, message.position.z = (
        sizes.length * (p + o) for p, o in zip(point, offset))
    turn_to(message, normal, random)
    return message


def pose_array(random: Random, sizes: Sizes, count: int | None = None) -> PoseArray:
    """Return contact poses."""
    message = PoseArray()
    _head(message.header)
    offset = _offset(random)
    message.poses = [pose(random, place, sizes, offset) for place in _places(
        random, random.choice(COUNTS) if count is None else count)]
    return message


def contact_array(random: Random, sizes: Sizes) -> ContactArray:
    """Return contacts of mixed models, some of them with joint limits."""
    message = ContactArray()
    _head(message.header)
    offset, model = _offset(random), random.choice((0, 0, 1, 2, 3, None))
    for i, place in enumerate(_places(random, random.choice(COUNTS))):
        item = Contact(pose=pose(random, place, sizes, offset))
        item.model = random.randrange(4) if model is None else model
        item.max_normal_force = sizes.force * random.uniform(0.3, 1.0)
        if random.random() < 0.7:
            item.friction_coefficient = random.uniform(0.1, 1.2)
            item.torsional_friction_coefficient = random.uniform(0.0, 0.2) * sizes.length
        if random.random() < 0.5:
            item.name = f'tip_{i}'
            item.finger = f'finger_{i // 2}'
        message.contacts.append(item)
    if message.contacts and random.random() < 0.12:
        message.joint_limits = [
            _joint(random, j, len(message.contacts), sizes) for j in range(random.randint(1, 4))]
    return message


def _joint(random: Random, index: int, count: int, sizes: Sizes) -> JointLimit:
    joint = JointLimit(name=f'joint_{index}')
    joint.max_torque = sizes.force * sizes.length * 10.0 ** random.uniform(-1.0, 1.0)
    joint.gravity_torque = joint.max_torque * random.choice((0.0, 0.0, 0.3, -0.3, 1.2))
    for _ in range(count):
        twist = Twist()
        linear, angular = twist.linear, twist.angular
        if random.random() < 0.5:
            linear.x, linear.y, linear.z = (random.gauss(0.0, sizes.length) for _ in range(3))
            angular.x, angular.y, angular.z = direction(random)
        joint.twists.append(twist)
    return joint


def _offset(random: Random) -> Vector:
    x, y, z = direction(random)
    size = random.choice((0.0, 0.0, 1.0, 30.0))
    return x * size, y * size, z * size


def _head(header: Any) -> None:
    header.frame_id = FRAME
    header.stamp.sec = NOW_S

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Messages and frames that several adapter tests start from, and their tolerance."""

import math

from geometry_msgs.msg import Point, Pose, Quaternion, Vector3, Wrench
from hypothesis import strategies
from msg_adapters.frames import Transform
import numpy as np

EXACT = 1e-12
BAD_NUMBERS = (math.nan, math.inf, -math.inf, 1e300, -1.1e12)
any_float = strategies.floats(allow_nan=True, allow_infinity=True)
sizes = strategies.floats(-10.0, 10.0)


def facing_x():
    """Return a new Quaternion that turns +z to +x."""
    return Quaternion(x=0.0, y=math.sqrt(0.5), z=0.0, w=math.sqrt(0.5))


def pose(position=(0.0, 0.0, 0.0), orientation=None):
    """Build a Pose, along +x unless turned otherwise; its parts are its own."""
    x, y, z = position
    return Pose(position=Point(x=x, y=y, z=z), orientation=orientation or facing_x())


def xyz(message):
    """Return the parts of a Point or Vector3."""
    return [message.x, message.y, message.z]


def wrench(fx=0.0, fy=0.0, fz=0.0, tx=0.0, ty=0.0, tz=0.0):
    """Build a Wrench."""
    return Wrench(force=Vector3(x=fx, y=fy, z=fz), torque=Vector3(x=tx, y=ty, z=tz))


def shuffled_axes():
    """Return the transform of a frame at (1, 2, 3) whose x, y, z are the target's y, z, x."""
    R = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    return Transform(R, np.array([1.0, 2.0, 3.0]))


def quaternion_of(numbers):
    """Normalise four numbers, not all zero, to a Quaternion."""
    x, y, z, w = (float(v) for v in np.array(numbers) / np.linalg.norm(numbers))
    return Quaternion(x=x, y=y, z=z, w=w)

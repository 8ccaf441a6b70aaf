# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Frames: where a message stands, and how it comes into the object frame.

Without tf2 (it is not on PyPI) only messages in the object frame can be used, and anything else is
a TransformError, never a silent reinterpretation. An empty frame_id of a wrench means the object
frame; contacts must name their frame, unless the object_frame parameter does.
"""

from dataclasses import dataclass, field
from typing import Any

from grasp_quality.arrays import Array
from grasp_quality.wrench import transform
from msg_adapters.errors import InvalidMessageError, TransformError
from msg_adapters.message_types import Stamp
from msg_adapters.number_checks import checked_numbers
from msg_adapters.poses import rotation_matrix
import numpy as np


@dataclass(frozen=True, eq=False)
class Transform:
    """Rigid transform from a source frame: x_target = R x_source + p [m]."""

    R: Array = field(default_factory=lambda: np.eye(3))
    p: Array = field(default_factory=lambda: np.zeros(3))

    def wrench(self, wrench: Array) -> Array:
        """Express a wrench of the source frame, (6,) [N, N m], in the target frame."""
        return transform(wrench, self.R, self.p)


def object_frame_of(contacts_frame: str, object_frame: str) -> str:
    """
    Name the object frame.

    Parameters
    ----------
    contacts_frame : str
        header.frame_id of the contacts.
    object_frame : str
        The parameter; empty means the frame that the contacts come in.

    Raises
    ------
    InvalidMessageError
        When both are empty.

    """
    frame = object_frame or contacts_frame
    if not frame:
        raise InvalidMessageError(
            'header.frame_id of the contacts must not be empty: name the frame of the poses '
            'there, or set the parameter object_frame')
    return frame


def transform_to(target: str, source: str, buffer: Any, stamp: Stamp) -> Transform | None:
    """
    Find the transform from a source frame to the object frame.

    Parameters
    ----------
    target, source : str
        Frame names; an empty source means the target itself.
    buffer : tf2_ros.Buffer or None
        None where tf2 is not installed.
    stamp : builtin_interfaces.msg.Time
        Of the message; zero asks for the newest.

    Returns
    -------
    Transform or None
        None for the identity.

    Raises
    ------
    TransformError

    """
    if source in ('', target):
        return None
    if buffer is None:
        raise TransformError(
            f'frame {source!r} is not the object frame {target!r}, and tf2 is not installed here: '
            f'send the message in {target!r}, or install tf2_ros')
    from rclpy.time import Time  # where there is a buffer, there is ROS
    try:
        found = buffer.lookup_transform(target, source, Time.from_msg(stamp)).transform
        t = found.translation
        return Transform(rotation_matrix(found.rotation, 'its rotation'),
                         np.array(checked_numbers((t.x, t.y, t.z), 'its translation')))
    except Exception as exc:  # the exceptions of tf2 have no common base in Python
        raise TransformError(f'no transform from {source!r} to {target!r}: {exc}') from exc

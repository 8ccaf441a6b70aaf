# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What is read of messages, as types: the same fields whether ROS or a recorded bag has made them.

Nothing here is checked when the node runs; mypy holds the adapters to these names.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol


class Stamp(Protocol):
    """builtin_interfaces/Time, or Duration."""

    sec: int
    nanosec: int


class Header(Protocol):
    """std_msgs/Header."""

    stamp: Stamp
    frame_id: str


class Framed(Protocol):
    """std_msgs/Header without its stamp; read only."""

    @property
    def frame_id(self) -> str: ...


class Stamped(Protocol):
    """Any message with a header."""

    header: Header


class Xyz(Protocol):
    """geometry_msgs/Point, or Vector3."""

    x: float
    y: float
    z: float


class Quaternion(Protocol):
    """geometry_msgs/Quaternion; read only."""

    @property
    def x(self) -> float: ...

    @property
    def y(self) -> float: ...

    @property
    def z(self) -> float: ...

    @property
    def w(self) -> float: ...


class Pose(Protocol):
    """geometry_msgs/Pose."""

    position: Xyz
    orientation: Quaternion


class Wrench(Protocol):
    """geometry_msgs/Wrench."""

    force: Xyz
    torque: Xyz


class StampedWrench(Protocol):
    """geometry_msgs/WrenchStamped."""

    header: Header
    wrench: Wrench


class Poses(Protocol):
    """geometry_msgs/PoseArray."""

    header: Header
    poses: Sequence[Pose]


class Item(Protocol):
    """grasp_quality_msgs/Contact."""

    name: str
    finger: str
    pose: Pose
    model: int


class Contacts(Protocol):
    """grasp_quality_msgs/ContactArray."""

    header: Header
    contacts: Sequence[Item]


class ConeFields(Protocol):
    """Fields of a task cone, of EvaluateTaskCone or SetTask."""

    axis: Wrench
    lateral_x: Wrench
    lateral_y: Wrench
    half_angle: float


class PolytopeFields(Protocol):
    """Fields of a task polytope, of EvaluateTaskPolytope or SetTask."""

    task_wrenches: Sequence[Wrench]
    weights: Sequence[float]

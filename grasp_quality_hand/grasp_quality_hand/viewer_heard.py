# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the viewer has heard last, and how long ago. No ROS node and no page in here."""

from collections import deque
from dataclasses import dataclass, field
import statistics
from typing import Any

STALE_S = 0.5            # silence that always counts as stale [s]; slow streams may take longer
INTERVALS = 9            # of arrivals, whose median tells how often a stream comes
PATIENCE = 4.0           # usual intervals of silence that count as stale
MEASURED_S = 0.5         # age at which a measured force is not drawn any more [s]


class Freshness:
    """Tells whether a stream has fallen silent, by how often it came before."""

    def __init__(self) -> None:
        self._last: float | None = None
        self._intervals: deque[float] = deque(maxlen=INTERVALS)

    def note(self, now: float) -> None:
        """Note an arrival at a time of the steady clock [s]."""
        if self._last is not None and not self.stale(now):
            self._intervals.append(now - self._last)
        self._last = now

    def age(self, now: float) -> float | None:
        """Return the time since the last arrival [s]; None when there was none."""
        return None if self._last is None else now - self._last

    def stale(self, now: float) -> bool:
        """Tell whether nothing came for longer than the stream ever lets one wait."""
        usual = statistics.median(self._intervals) if self._intervals else 0.0
        age = self.age(now)
        return age is None or age > max(STALE_S, PATIENCE * usual)


@dataclass
class Heard:
    """
    The newest message of every topic.

    Attributes
    ----------
    quality, forces, force_map, contacts, joints, object_pose, up : message or None
        GraspQuality, ContactForceArray, ForceMap, PoseArray or ContactArray, JointState,
        PoseStamped and Vector3Stamped.
    measured : dict of str to (WrenchStamped, float)
        By contact name, with the time of arrival on the steady clock [s].
    freshness : Freshness
        Of the quality, which every answer and every failure of the node comes with.

    """

    quality: Any = None
    forces: Any = None
    force_map: Any = None
    contacts: Any = None
    joints: Any = None
    object_pose: Any = None
    up: Any = None
    measured: dict[str, tuple[Any, float]] = field(default_factory=dict)
    freshness: Freshness = field(default_factory=Freshness)

    def measured_now(self, now: float) -> dict[str, Any]:
        """Return the measured wrenches that are fresh, by contact name."""
        return {name: message for name, (message, arrival) in self.measured.items()
                if now - arrival <= MEASURED_S}

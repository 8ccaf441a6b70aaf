# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What people look at: ~/markers and ~/force_map, worked out only while somebody subscribes.

The live loop only leaves its newest answer here. A timer draws it, and works out the force map in
slices, each of which takes at most a set share of the timer's period. On any failure of the live
loop everything is taken off the screen at once.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math
from typing import Any

from builtin_interfaces.msg import Duration
from grasp_quality.exceptions import GraspQualityError
from grasp_quality.grasp import Grasp
from grasp_quality.node_parameters import Settings
from grasp_quality.node_scene import Scene
from grasp_quality.sliced_map import FIRST_SLICE, SlicedMap
from grasp_quality_msgs.msg import ForceMap, GraspQuality, ResultCode
from msg_adapters import markers, qos
from msg_adapters.force_map import force_map
from msg_adapters.marker_geometry import Array, automatic_force_scale
from msg_adapters.stamps import to_duration
from msg_adapters.wrenches import wrench_array
from rclpy.event_handler import PublisherEventCallbacks
from std_msgs.msg import Header
from visualization_msgs.msg import MarkerArray

LIFETIME_S = 0.5       # of a marker, beyond the age at which contacts are stale
MAP_LIFETIME_S = 10.0  # of the map, which takes longer to renew


@dataclass(frozen=True, eq=False)
class Shown:
    """An answer of the live loop and what it was an answer to."""

    scene: Scene
    load: Array | None  # (6,)
    quality: GraspQuality
    forces: Array  # (k, 4)
    cone_usage: Array  # (k,)


class Display:
    """Publishes what ``show`` was given last; ``settings()`` returns the current Settings."""

    def __init__(self, node: Any, settings: Callable[[], Settings]) -> None:
        self._settings = settings
        self._logger = node.get_logger()
        self._markers = self._publisher(node, MarkerArray, '~/markers', qos.display())
        self._maps = self._publisher(node, ForceMap, '~/force_map', qos.newest_command())
        self._shown: Shown | None = None
        self._drawn: Shown | None = None
        self._names: tuple[str, ...] | None = None  # of the contacts on the screen
        self._map: tuple[SlicedMap, Shown] | None = None  # in progress, and what it is of
        self._slice_size = FIRST_SLICE

    @staticmethod
    def _publisher(node: Any, message_type: Any, topic: str, profile: Any) -> Any:
        return node.create_lifecycle_publisher(
            message_type, topic, profile,
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False))

    @property
    def publishers(self) -> tuple[Any, Any]:
        """Return the publishers, to be flushed on the way out."""
        return self._markers, self._maps

    def show(self, scene: Scene, load: Array | None, quality: GraspQuality, forces: Array,
             cone_usage: Array) -> None:
        """Keep an answer; it is drawn when the timer comes round."""
        if quality.result.code == ResultCode.OPTIMAL:
            self._shown = Shown(scene, load, quality, forces, cone_usage)
        else:
            self.clear(quality.header)

    def clear(self, header: Header) -> None:
        """Take everything off the screen, once; nothing is drawn until the next answer."""
        was_shown, self._shown, self._drawn = self._shown, None, None
        self._names, self._map = None, None
        if was_shown is not None:
            self._markers.publish(markers.delete_all(header))
            self._maps.publish(force_map(header))

    def draw(self) -> None:
        """Publish the newest answer if it is a new one, and work on the map."""
        shown = self._shown
        watched = self._markers.get_subscription_count() > 0
        if not watched:
            self._names = self._drawn = None  # whoever comes next begins with an empty screen
        if shown is None:
            return
        if watched and shown is not self._drawn:
            self._draw_grasp(shown)
        if watched or self._maps.get_subscription_count():
            self._draw_map(shown)

    def _draw_grasp(self, shown: Shown) -> None:
        names = shown.scene.grasp.names
        quality, anew = shown.quality, names != self._names
        picture = markers.Picture(
            header=quality.header, grasp=shown.scene.grasp, optimal=shown.forces,
            cone_usage=shown.cone_usage, measured=shown.scene.forces, alpha=quality.alpha,
            task=wrench_array(quality.task_wrench, 'task_wrench'),
            limiting_contact=quality.limiting_contact,
            metres_per_newton=self._force_scale(shown.scene.grasp),
            lifetime=self._lifetime(LIFETIME_S))
        self._markers.publish(markers.grasp_markers(picture, anew))
        self._drawn, self._names = shown, names

    def _draw_map(self, shown: Shown) -> None:
        settings = self._settings()
        if self._map is None:
            self._map = SlicedMap(
                shown.scene.grasp, _resolution(settings), shown.load, self._slice_size), shown
        (work, shown), self._map = self._map, None  # with an error the next map begins anew
        budget = settings.display_time_share / settings.marker_rate
        try:
            done = work.advance(budget, settings.solver_time_limit)
        except GraspQualityError as exc:
            self._logger.warning(f'no force map: {exc}', throttle_duration_sec=5.0)
            return
        self._slice_size = work.slice_size
        if done:
            self._publish_map(work, shown)
        else:
            self._map = work, shown

    def _publish_map(self, work: SlicedMap, shown: Shown) -> None:
        header, alphas = shown.quality.header, work.alphas
        if self._maps.get_subscription_count():
            self._maps.publish(force_map(header, work.resolution, alphas))
        if self._markers.get_subscription_count():
            self._markers.publish(markers.map_marker(
                header, work.resolution, alphas, self._force_scale(shown.scene.grasp),
                self._lifetime(MAP_LIFETIME_S)))

    def _force_scale(self, grasp: Grasp) -> float:
        return self._settings().marker_force_scale or automatic_force_scale(
            grasp.lever_arm, grasp.force_scale)

    def _lifetime(self, beyond_s: float) -> Duration:
        return to_duration(self._settings().max_contact_age + beyond_s)


def _resolution(settings: Settings) -> int:
    return max(1, round(math.sqrt(settings.map_directions / 2)))

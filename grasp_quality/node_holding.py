# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Forces to hold with, live: those that balance the load and nothing else, with the largest margin.

``~/contact_forces`` apply alpha times the task, as much as the hand can. A controller that holds
an object wants ``~/holding_forces`` instead. They are computed while somebody listens, after the
answer has been published, and are empty whenever they do not exist.
"""

import time

from grasp_quality.exceptions import GraspQualityError
from grasp_quality.margin_forces import hold_forces


class HoldingForces:
    """Works the holding forces out, each search beginning at the last answer."""

    def __init__(self, logger):
        self._logger = logger
        self._last = None

    def publish(self, outputs, quality, grasp, load, time_left_s):
        """
        Publish the forces that hold the load.

        Parameters
        ----------
        outputs : Outputs
            Of the node.
        quality : GraspQuality
            OPTIMAL, for these contacts.
        grasp : Grasp
            These contacts.
        load : (6,) array [N, N m] or None
            External wrench in the object frame.
        time_left_s : float
            [s]

        """
        if not outputs.holding_wanted:
            self._last = None
            return
        self._last = self._computed(grasp, load, time_left_s)
        outputs.publish_holding(quality.header, self._last)

    def _computed(self, grasp, load, time_left_s):
        if time_left_s <= 0.0:
            self._tell('no time was left for them')
            return None
        start = self._last
        if start is not None and start.grasp.names != grasp.names:
            start = None
        deadline = time.monotonic() + time_left_s
        try:
            held = hold_forces(grasp, load, start=start, time_limit_s=time_left_s)
        except GraspQualityError as exc:
            self._tell(str(exc))
            return None
        if time.monotonic() > deadline:
            self._tell('contacts or load became stale while they were computed')
            return None
        if not held.feasible:
            self._tell('no forces inside cones, bound and joint limits hold the external wrench')
            return None
        return held

    def _tell(self, why):
        self._logger.warning(f'no holding forces: {why}', throttle_duration_sec=1.0)

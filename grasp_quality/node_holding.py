# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Forces to hold with, live: those that balance the load and nothing else, with the largest margin.

``~/contact_forces`` apply alpha times the task, as much as the hand can. A controller that holds
an object wants ``~/holding_forces`` instead. They are computed while somebody listens, after the
answer has been published, and are empty whenever they do not exist or come too late: the answer
was in time, and stays.
"""

from grasp_quality.exceptions import GraspQualityError
from grasp_quality.margin_forces import hold_forces
from grasp_quality.node_ages import until_stale


class HoldingForces:
    """Works the holding forces out, each search beginning at the last answer."""

    def __init__(self, logger):
        self._logger = logger
        self._last = None

    def publish(self, outputs, quality, grasp, load, left_s):
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
        left_s : callable
            Time until contacts, load or measurements are too old [s]; raises when they are.

        """
        if not outputs.holding_wanted:
            self._last = None
            return
        self._last = self._computed(grasp, load, left_s)
        try:
            outputs.publish_holding(quality.header, self._last, left_s)
        except GraspQualityError as exc:
            self._tell(str(exc))
            outputs.publish_holding(quality.header, None)

    def _computed(self, grasp, load, left_s):
        start = self._last
        if start is not None and start.grasp.names != grasp.names:
            start = None
        try:
            held = hold_forces(grasp, load, start=start, time_limit_s=until_stale(left_s()))
        except GraspQualityError as exc:
            self._tell(str(exc))
            return None
        if not held.feasible:
            self._tell('no forces inside cones, bound and joint limits hold the external wrench')
            return None
        return held

    def _tell(self, why):
        self._logger.warning(f'no holding forces: {why}', throttle_duration_sec=1.0)

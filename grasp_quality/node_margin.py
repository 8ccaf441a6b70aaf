# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Measured against possible, live on ~/margin: computed only while somebody listens.

It needs a fresh measured wrench of every contact that counts, and no task. What is missing or goes
wrong is a result code with zeros, like everything that the node publishes.
"""

from grasp_quality.measured_margin import measured_margin
from grasp_quality_msgs.msg import GraspMargin
from msg_adapters.errors import StaleContactsError
from msg_adapters.margins import margin_message
from msg_adapters.results import error_result
from std_msgs.msg import Header


class MarginTopic:
    """Publishes a GraspMargin for every scene; ``publisher`` is that of ~/margin."""

    def __init__(self, publisher, settings):
        self._publisher = publisher
        self._settings = settings

    def show(self, scene, age_s):
        """Publish how close measured forces are to their limits; age_s() is that of contacts."""
        if not self._publisher.get_subscription_count():
            return
        header = Header(stamp=scene.stamp, frame_id=scene.frame)
        try:
            message = self._message(header, scene, age_s)
            age_s()  # raises when the contacts became stale meanwhile
        except Exception as exc:
            message = GraspMargin(header=header, result=error_result(exc))
        self._publisher.publish(message)

    def fail(self, result, header):
        """Publish that there is no scene."""
        if self._publisher.get_subscription_count():
            self._publisher.publish(GraspMargin(header=header, result=result))

    def _message(self, header, scene, age_s):
        missing = [name for name, force in zip(scene.grasp.names, scene.forces) if force is None]
        if missing:
            raise StaleContactsError(
                f'no fresh measured wrench of {missing}: publish them on '
                '~/contact_wrenches/<name> with every sample of contacts')
        settings = self._settings()
        limit = min(settings.solver_time_limit, settings.max_contact_age - age_s())
        found = measured_margin(scene.grasp, scene.forces, settings.wanted_margin, limit)
        return margin_message(header, scene.grasp, found)

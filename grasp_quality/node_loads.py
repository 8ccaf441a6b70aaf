# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The load of the live loop: the newest that came on its topic, or that was given with a task.

With ``max_load_age`` above 0 a load must be known, and one of the topic must be fresh. One that
was given with a task was said once and does not age, until one comes on the topic; there a wrench
of zero, which is what a request holds that says nothing of a load, is none. One of the topic that
is stamped before a fresh one is passed over, as contacts are; where loads do not age, the last to
come counts.
"""

from collections.abc import Callable
import math

from grasp_quality.node_ages import Ages, Received, Subject
from grasp_quality.node_settings import Settings
from msg_adapters.errors import StaleContactsError
from msg_adapters.message_types import StampedWrench
from msg_adapters.tasks import HeldLoad
from msg_adapters.wrenches import is_zero, wrench_array

CURE = ('publish loads steadily, give one that is not zero with ~/set_task, or set max_load_age '
        'to 0, with which no load ages')
LOAD = Subject('the load of ~/external_wrench is', 'max_load_age', CURE)


class Loads:
    """Holds what is known of the load."""

    def __init__(self, settings: Callable[[], Settings], ages: Ages) -> None:
        self._settings = settings
        self._ages = ages
        self._given: HeldLoad | None = None  # with a task, since the last of the topic
        self._streamed: Received | None = None

    def clear(self) -> None:
        """Forget all loads, as a node that was started anew."""
        self._given = self._streamed = None

    def give(self, load: HeldLoad) -> None:
        """Keep the load of a SetTask request."""
        self._given = load

    def store(self, message: StampedWrench, sent_ns: int | None) -> None:
        """Keep a WrenchStamped of the topic, unless loads age and a later one is fresh."""
        if self._settings().max_load_age <= 0.0 or not self._ages.is_late(
                message, self._streamed, LOAD):
            self._given, self._streamed = None, self._ages.received(message, sent_ns)

    def newest(self) -> HeldLoad | StampedWrench | None:
        """
        Return the load that counts, or None when there is none.

        Raises
        ------
        StaleContactsError
            When max_load_age is above 0 and no load counts.

        """
        self.left_s()  # for what it raises
        if self._given is not None and not self._has_age():
            return self._given
        return None if self._streamed is None else self._streamed.message

    def left_s(self) -> float:
        """Time until the load is too old [s], infinite where it does not age; raises as newest."""
        if not self._has_age():
            return math.inf
        limit = self._settings().max_load_age
        if self._streamed is None:
            raise StaleContactsError(
                f'no load received yet on ~/external_wrench, max_load_age is {limit:g} s: {CURE}')
        return limit - self._ages.checked_s(self._streamed, LOAD)

    def _has_age(self) -> bool:
        """Whether the load must be a fresh one of the topic."""
        if self._settings().max_load_age <= 0.0:
            return False
        return self._given is None or is_zero(
            wrench_array(self._given.wrench, 'external_wrench'))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a service is asked, read when its turn has come, and whether its answer still holds.

A question is read twice where it had to wait for the thread of long ones: at once, so that what
cannot be answered is refused at once, and anew when its turn comes, so that waiting makes nothing
stale. When it is answered, nothing it was read from may have been replaced: parameters are those
of now, the node was active all the time, and forces are for contacts, and with
``min_contact_force`` for measured wrenches, that are not older than ``max_contact_age``, as on the
topics.
"""

from contextlib import asynccontextmanager
from typing import NamedTuple

from grasp_quality.arrays import Array
from grasp_quality.grasp import Grasp
from grasp_quality.node_ages import ASK_FOR_LESS, Received
from grasp_quality.node_settings import Settings
from grasp_quality.time_limit import TimeLimit
from msg_adapters.errors import NotActiveError, StaleContactsError
from msg_adapters.frames import Transform
from msg_adapters.tasks import load_from
from std_msgs.msg import Header


class Question(NamedTuple):
    """
    What was read of one request.

    Attributes
    ----------
    grasp : Grasp
    header : std_msgs.msg.Header
        Of the answer: object frame, stamp of the contacts.
    transform : Transform or None
        Of the request's wrenches into the object frame.
    load : (6,) array [N, N m]
        External wrench in the object frame.
    settings : Settings
    limit : TimeLimit
        Of the whole question; waiting is part of it.
    contacts : Received or None
        Live contacts; None when the request brought its own.
    loaded_by : dict
        Measured wrenches by which they are loaded, by name.
    cleared : int
        Deactivations before it was read.

    """

    grasp: Grasp
    header: Header
    transform: Transform | None
    load: Array
    settings: Settings
    limit: TimeLimit
    contacts: Received | None
    loaded_by: dict[str, Received]
    cleared: int


class Questions:
    """Reads requests; ``check_active()`` raises while the node is not active."""

    def __init__(self, inputs, settings, check_active, worker):
        self._inputs = inputs
        self._settings = settings
        self._check_active = check_active
        self._worker = worker

    @asynccontextmanager
    async def asked(self, request, response, waits=lambda grasp: True):
        """Give the Question of a request; ``waits(grasp)``: whether it needs the thread."""
        limit = TimeLimit(self._settings().solver_time_limit, ASK_FOR_LESS)
        question = self._read(request, limit)
        if waits(question.grasp):
            waited = await self._worker.take()
            try:
                if waited:
                    question = self._read(request, limit)
                yield question
            finally:
                self._worker.free()
        else:
            yield question
        self._check(question, has_forces=hasattr(response, 'forces'))

    def _read(self, request, limit):
        self._check_active()
        inputs, contacts = self._inputs, None
        if request.contacts.contacts:
            grasp, frame = inputs.read_grasp(request.contacts)
            stamp = request.contacts.header.stamp
        else:
            scene, contacts = inputs.scene(), inputs.contacts
            grasp, frame, stamp = scene.grasp, scene.frame, scene.stamp
        transform = inputs.transform(request.header, frame, stamp)
        return Question(
            grasp, Header(stamp=stamp, frame_id=frame), transform,
            load_from(request.external_wrench, transform), self._settings(), limit, contacts,
            inputs.loaded_by if contacts else {}, inputs.cleared)

    def _check(self, question, has_forces):
        if question.cleared != self._inputs.cleared:
            raise NotActiveError('the node was deactivated while this was computed: ask again')
        if question.settings != self._settings():
            raise StaleContactsError('parameters were changed while this was computed: ask again')
        if has_forces and question.contacts is not None:
            self._inputs.check_answered(question.contacts, question.loaded_by)

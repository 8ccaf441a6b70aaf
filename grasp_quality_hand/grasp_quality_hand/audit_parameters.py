# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Questions of the audit to a node about its parameters, and what it says of their changes."""

from collections.abc import Callable
import dataclasses
import time
from typing import Any

from grasp_quality_hand.audit_parts import Settings
from rcl_interfaces.msg import ParameterEvent
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

ANSWER_S = 5.0  # after which an answer will not come
LISTS = ('contact_names', 'contact_fingers')
UNSET = (*LISTS, 'contact_source')  # read-only, and perhaps not set
REQUIRED = tuple(f.name for f in dataclasses.fields(Settings) if f.name not in UNSET)


class ParameterQuestions:
    """
    Asks ``target`` and tells ``store`` (see ``ForceRecords.store``) all that it says.

    ``sure_s``: until when the parameters that it has said last are known to hold [s].

    """

    def __init__(self, node: Node, target: str,
                 store: Callable[[Settings, float, float], object]) -> None:
        self.sure_s = 0.0
        self._target, self._store, self._logger = target, store, node.get_logger()
        self._asked: dict[tuple[str, ...], Any] = {}
        self._asked_s = self._changed_s = 0.0
        self._settings: Settings | None = None
        self._client = node.create_client(GetParameters, f'{target}/get_parameters')

    def ask(self) -> None:
        """Ask the node for its parameters, time and again: it may be started anew."""
        now_s = time.monotonic()
        if self._asked and all(asked.done() for asked in self._asked.values()):
            found: dict[str, Any] = {}
            for names, asked in self._asked.items():
                found.update(zip(names, map(parameter_value_to_python, asked.result().values)))
            if set(REQUIRED) <= set(found):
                self._learn(Settings(**{
                    **found, **{name: tuple(found.get(name) or ()) for name in LISTS},
                    'contact_source': found.get('contact_source') or ''}), now_s)
            self._asked = {}
        if now_s > self._asked_s + ANSWER_S:
            self._ask_anew()  # an answer of a node that is gone never comes
        if not self._asked and self._client.service_is_ready():
            self._asked_s = now_s
            # one that is not set takes the answers to all that were asked for with it away
            self._asked = {names: self._client.call_async(
                GetParameters.Request(names=names)) for names in (REQUIRED, *zip(UNSET))}

    def _ask_anew(self) -> None:
        for asked in self._asked.values():
            self._client.remove_pending_request(asked)
        self._asked = {}

    def _learn(self, settings: Settings, now_s: float) -> None:
        """Take an answer; what was changed since it was asked for is newer."""
        if settings != self._settings and self._changed_s >= self._asked_s:
            return
        if self._settings is None:
            self._logger.info(f'{self._target} has told its parameters')
        self._store(settings, now_s, now_s if self._settings is None else self.sure_s)
        self._settings, self.sure_s = settings, self._asked_s

    def change(self, event: ParameterEvent, sent_ns: int, number: int | None) -> None:
        """Note each change of parameters as it is made: many may lie between two questions."""
        if event.node != self._target:
            return
        self._changed_s = time.monotonic()
        if event.new_parameters:
            self._ask_anew()  # it was started anew: the one that was asked is gone
        if self._settings is not None:
            changes = {p.name: parameter_value_to_python(p.value)
                       for p in event.changed_parameters if p.name in REQUIRED}
            self._settings = dataclasses.replace(self._settings, **changes)
            sent_s = steady_times(sent_ns)[1]
            self._store(self._settings, sent_s, sent_s)


def steady_times(sent_ns: int) -> tuple[float, float]:
    """Return now, and when something was sent, both by the steady clock [s]."""
    now_s = time.monotonic()
    return now_s, now_s - max(0.0, time.time() - 1e-9 * sent_ns)

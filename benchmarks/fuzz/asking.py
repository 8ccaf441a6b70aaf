# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Questions are put to the node's own code, in this process: inputs, services, live loop, outputs.

Only DDS is left out. ``Desk`` stands where the ROS node stands: it keeps the handlers of services
instead of offering them, and what is published instead of sending it. Clocks stand still.
"""

from collections.abc import Coroutine
from dataclasses import dataclass, field
from threading import Event
from typing import Any

from benchmarks.fuzz.cases import Case, LIVE, SERVICES
from benchmarks.fuzz.grasps import NOW_S
from builtin_interfaces.msg import Time
from grasp_quality.node_holding import HoldingForces
from grasp_quality.node_inputs import Inputs
from grasp_quality.node_live import LiveLoop
from grasp_quality.node_margin import MarginTopic
from grasp_quality.node_outputs import Outputs
from grasp_quality.node_services import Services
from grasp_quality.node_settings import Settings
from rclpy.serialization import deserialize_message, serialize_message

STEADY_NS = 10 ** 12


@dataclass
class Answer:
    """
    Response to the request, if there was one, and what was published, by topic.

    ``passed_over``: the contacts were stamped before those that came first; no answer is theirs.

    """

    response: Any = None
    published: dict[str, list[Any]] = field(default_factory=dict)
    passed_over: bool = False


class Publisher:
    """Keeps what is published in a list that is shared by topic."""

    def __init__(self, kept: list[Any], listeners: int) -> None:
        self.publish = kept.append
        self._listeners = listeners

    def get_subscription_count(self) -> int:
        """Count who listens."""
        return self._listeners

    def on_activate(self, state: Any) -> None:
        """Be active."""


class Silent:
    """A logger, monitor and display that nobody reads."""

    def __getattr__(self, name: str) -> Any:
        """Return a function that does nothing."""
        return lambda *_, **__: None


class Desk:
    """What Services, Worker and Outputs need of a ROS node."""

    active = True

    def __init__(self) -> None:
        self.handlers: dict[str, Any] = {}
        self.published: dict[str, list[Any]] = {}
        self.silent_topics: tuple[str, ...] = ()
        self.executor = self
        self.awake = Event()

    def get_logger(self) -> Silent:
        """Return a logger."""
        return Silent()

    def create_service(self, kind: Any, name: str, handler: Any, **_: Any) -> None:
        """Keep a handler."""
        self.handlers[name.removeprefix('~/')] = handler

    def create_lifecycle_publisher(self, kind: Any, topic: str, *_: Any, **__: Any) -> Publisher:
        """Return a publisher to a list."""
        kept = self.published.setdefault(topic.removeprefix('~/'), [])
        return Publisher(kept, int(topic not in self.silent_topics))

    def wake(self) -> None:
        """Tell that the thread for long questions is done, as an executor is told."""
        self.awake.set()

    def run(self, answering: Coroutine[Any, Any, Any]) -> Any:
        """Run a service callback to its end."""
        while True:
            try:
                answering.send(None)
            except StopIteration as exc:
                return exc.value
            self.awake.wait()
            self.awake.clear()


class Asker:
    """Puts one case after the other to the same node."""

    def __init__(self) -> None:
        self._desk = Desk()
        self._settings = Settings()
        self._inputs: Any = Inputs(
            lambda: self._settings, lambda: NOW_S * 1_000_000_000, lambda: STEADY_NS)
        Services(self._desk, self._inputs, lambda: self._settings, lambda: True)

    def ask(self, case: Case, settings: Settings, everything: bool = True) -> Answer:
        """Ask; ``everything``: somebody listens to margin and holding forces too."""
        self._settings, inputs, messages = settings, self._inputs, case.messages
        if case.on_wire:
            messages = {name: deserialize_message(serialize_message(message), type(message))
                        for name, message in messages.items()}
        inputs.clear()
        inputs.task = None
        inputs.loads.clear()
        answer = Answer()
        if case.kind == LIVE:
            self._ask_live(messages, answer, everything)
        else:
            if 'contacts' in messages:
                inputs.store_contacts(messages['contacts'])
            answer.response = self._call(case.kind, messages['request'])
        return answer

    def _call(self, name: str, request: Any) -> Any:
        return self._desk.run(self._desk.handlers[name](request, SERVICES[name].Response()))

    def _ask_live(self, messages: dict[str, Any], answer: Answer, everything: bool) -> None:
        desk, inputs = self._desk, self._inputs
        desk.published = answer.published
        desk.silent_topics = () if everything else ('~/margin', '~/holding_forces')
        outputs = Outputs(desk)
        margin = MarginTopic(outputs.margin, lambda: self._settings)
        loop = LiveLoop(inputs, outputs, lambda: self._settings, Silent(), Silent(), margin,
                        HoldingForces(Silent()), lambda: Time(sec=NOW_S))
        if 'request' in messages:
            answer.response = self._call('set_task', messages['request'])
        if 'task' in messages:
            inputs.store_task_wrench(messages['task'])
        if 'load' in messages:
            inputs.store_load(messages['load'])
        for name, message in messages.items():
            if name.startswith('measured/'):
                inputs.store_wrench(name.removeprefix('measured/'), message)
        for name in ('before', 'contacts'):
            if name in messages:
                answer.passed_over = not inputs.store_contacts(messages[name])
                if not answer.passed_over:
                    for kept in desk.published.values():
                        kept.clear()
                    loop.evaluate()

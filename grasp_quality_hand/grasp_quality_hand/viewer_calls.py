# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The viewer's questions: service calls that go out from a node and a thread of their own.

Nothing waits here: an answer is handed to a function when it comes, and a call to a service that
is not there, or that does not answer in time, is answered with None.
"""

from collections.abc import Callable
import threading
import time
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import parameter_value_to_python

PATIENCE_S = 5.0
SPIN_S = 0.05


class Caller:
    """Calls services of ``node``; ``close`` ends its thread."""

    def __init__(self, node: Any) -> None:
        self._node = node
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(node)
        self._clients: dict[str, Any] = {}
        self._waiting: dict[Any, tuple[float, Callable[[Any], None]]] = {}
        self._lock = threading.Lock()
        self._open = True
        self._thread = threading.Thread(target=self._spin, name='viewer calls', daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the thread and forget what is on its way."""
        self._open = False
        self._thread.join()
        self._executor.shutdown()

    def call(self, kind: Any, name: str, request: Any, done: Callable[[Any], None]) -> None:
        """Call a service; ``done`` gets the response, or None, in the thread of the calls."""
        with self._lock:
            client = self._clients.get(name)
            if client is None:
                client = self._clients[name] = self._node.create_client(kind, name)
            ready = client.service_is_ready()
            if ready:
                future = client.call_async(request)
                self._waiting[future] = time.monotonic() + PATIENCE_S, done
        if not ready:
            done(None)

    def get_parameters(self, target: str, names: list[str],
                       done: Callable[[dict[str, Any] | None], None]) -> None:
        """Ask a node for the values of parameters; those not set are None."""
        def answered(response: Any) -> None:
            done(None if response is None or len(response.values) != len(names) else dict(
                zip(names, map(parameter_value_to_python, response.values))))
        self.call(GetParameters, f'{target}/get_parameters',
                  GetParameters.Request(names=names), answered)

    def set_number(self, target: str, name: str, value: float,
                   done: Callable[[str | None], None]) -> None:
        """Set a parameter; ``done`` gets why it was refused, empty when it was not."""
        def answered(response: Any) -> None:
            done(None if response is None else response.results[0].reason)
        parameter = Parameter(name=name, value=ParameterValue(
            type=ParameterType.PARAMETER_DOUBLE, double_value=float(value)))
        self.call(SetParameters, f'{target}/set_parameters',
                  SetParameters.Request(parameters=[parameter]), answered)

    def _spin(self) -> None:
        while self._open:
            try:
                self._executor.spin_once(timeout_sec=SPIN_S)
                self._hand_out()
            except Exception as exc:  # one bad answer shall not end all others
                self._node.get_logger().error(
                    f'{type(exc).__name__}: {exc}', throttle_duration_sec=1.0)

    def _hand_out(self) -> None:
        now = time.monotonic()
        with self._lock:
            over = [(future, done) for future, (deadline, done) in self._waiting.items()
                    if future.done() or now > deadline]
            for future, _ in over:
                del self._waiting[future]
        for future, done in over:
            done(future.result() if future.done() else None)

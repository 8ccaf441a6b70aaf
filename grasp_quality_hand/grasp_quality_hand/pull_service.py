# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The service that pulls on what a simulated hand holds; it answers when the pull has ended."""

from collections.abc import Callable
from typing import Any

from grasp_quality_hand.hand_messages import set_wrench
from grasp_quality_hand.pull import Pull
from grasp_quality_msgs.srv import PullObject
import numpy as np
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.task import Future

GROWTH, LIMIT = 1.0, 100.0   # [1/s] and [-], where the request has none


class PullService:
    """One pull at a time, in the simulated time that goes on meanwhile."""

    def __init__(self, node: Any, simulation: Callable[[], Any]) -> None:
        """Create ~/pull on a node; `simulation` returns the simulation of now."""
        self._simulation = simulation
        self._pull: Pull | None = None
        self._ended: Future | None = None
        # a group of its own: the simulation goes on while the answer waits
        node.create_service(PullObject, '~/pull', self._on_pull,
                            callback_group=MutuallyExclusiveCallbackGroup())

    def look(self) -> None:
        """Let the answer go when the pull has ended or was broken off; call it at every step."""
        if self._ended is not None and self._pull is not None and (
                self._pull.result is not None or self._simulation().pull is not self._pull):
            ended, self._ended = self._ended, None
            ended.set_result(self._pull.result)

    async def _on_pull(self, request: Any, response: Any) -> Any:
        """Pull until the object slips, and answer."""
        refusal = self._refusal(request)
        if refusal:
            response.message = refusal
            return response
        simulation = self._simulation()
        wrench = _vector(request.wrench)
        simulation.begin_pull(wrench, request.growth or GROWTH, request.limit or LIMIT,
                              request.slip_distance or simulation.slip_limit)
        self._pull, self._ended = simulation.pull, Future()
        result = await self._ended
        if result is None:
            response.message = 'the pull was broken off: the hand was opened or loaded anew'
            return response
        response.success, response.slipped = True, result.slipped
        response.held, response.moved = float(result.held), float(result.slip)
        response.message = (f'held {result.held:.4g} times the wrench, '
                            + ('then slipped' if result.slipped else 'and did not slip'))
        set_wrench(response.load, result.held * wrench)
        return response

    def _refusal(self, request: Any) -> str:
        """Return why a request cannot be done, empty when it can."""
        numbers = {name: getattr(request, name) for name in ('growth', 'limit', 'slip_distance')}
        for name, value in numbers.items():
            if not (np.isfinite(value) and value >= 0.0):
                return f'{name} is {value}: it must be a finite number, 0 for the default'
        wrench = _vector(request.wrench)
        if not (np.isfinite(wrench).all() and wrench.any()):
            return f'the wrench is {wrench.tolist()}: give finite numbers, not all 0'
        if not self._simulation().held:
            return 'the hand does not hold the object: call close, and wait until it does'
        return ''


def _vector(wrench: Any) -> Any:
    """Return a Wrench as an array, shape (6,), force first."""
    force, torque = wrench.force, wrench.torque
    return np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])

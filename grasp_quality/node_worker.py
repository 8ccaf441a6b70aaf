# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Long questions beside the live loop, in a single-threaded executor.

A callback that awaits ``Worker.run`` gives the executor back while a thread computes; whatever is
ready meanwhile, live samples above all, is served. Its service needs a callback group of its own:
a group waits for the callback that it has begun, so that one question of each service is under way
and the rest stay in the middleware's queue. One thread only: long questions wait for each other,
first come first served, within their time limit, and never the live loop for them. Who waits has
yet to read what the question is about (``take``), so that waiting makes nothing stale. What runs
there gets frozen core objects and touches nothing of the node.
"""

from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from rclpy.node import Node
from rclpy.task import Future


class Worker:
    """One thread beside the executor of a node; ``take`` it, ``run``, and ``free`` it."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._pool = ThreadPoolExecutor(1, thread_name_prefix='long_question')
        self._is_taken = False
        self._waiting: deque[Future] = deque()

    async def take(self) -> bool:
        """Wait for the thread; tell whether that took time."""
        if not self._is_taken:
            self._is_taken = True
            return False
        turn: Future = Future()
        self._waiting.append(turn)
        await turn
        return True

    def free(self) -> None:
        """Leave the thread to whoever has waited longest."""
        if self._waiting:
            self._wake(self._waiting.popleft())
        else:
            self._is_taken = False

    async def run(self, function: Callable[..., Any], *args: Any, **options: Any) -> Any:
        """Return what a function of the core returns, or raise what it raises."""
        computing = self._pool.submit(function, *args, **options)
        done: Future = Future()
        computing.add_done_callback(lambda _: self._wake(done))
        await done
        return computing.result()

    def _wake(self, future: Future) -> None:
        future.set_result(None)
        if self._node.executor is not None:
            self._node.executor.wake()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Long questions beside the live loop, in a single-threaded executor.

A callback that awaits ``Worker.run`` gives the executor back while a thread computes; whatever is
ready meanwhile, live samples above all, is served. Its service needs a callback group of its own:
a group waits for the callback that it has begun, so that one question of each service is under way
and the rest stay in the middleware's queue. One thread only: long questions wait for each other,
within their time limit, and never the live loop for them. What runs there gets frozen core objects
and touches nothing of the node.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from rclpy.node import Node
from rclpy.task import Future


class Worker:
    """One thread beside the executor of a node."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._pool = ThreadPoolExecutor(1, thread_name_prefix='long_question')

    async def run(self, function: Callable[..., Any], *args: Any, **options: Any) -> Any:
        """Return what a function of the core returns, or raise what it raises."""
        computing = self._pool.submit(function, *args, **options)
        done: Future = Future()

        def wake(_: object) -> None:
            done.set_result(None)
            if self._node.executor is not None:
                self._node.executor.wake()

        computing.add_done_callback(wake)
        await done
        return computing.result()

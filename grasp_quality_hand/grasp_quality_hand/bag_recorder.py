# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Records what the grasp_quality node hears to an MCAP bag, for ``grasp-quality bag``.

For machines without ``ros2 bag``: the ROS wheels have none. Messages are written as they come,
not decoded. Ends on SIGINT, on SIGTERM or after ``--messages``, with a bag that is whole.

"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
import shutil
import signal
import sys
from typing import Any

from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_cli.bag_types import OURS
from grasp_quality_msgs.msg import ContactArray
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import get_types_from_msg, get_typestore, Stores

TOPICS = {'contact_poses': PoseArray, 'contacts': ContactArray, 'task_wrench': WrenchStamped,
          'external_wrench': WrenchStamped}
MEASURED = 'contact_wrenches/'
LOOK_S = 0.2  # between two looks for new contact names
SILENCE_S = 5.0  # after which it says that it hears nothing
# hears reliable publishers and best-effort ones; deep enough for a burst
QOS = QoSProfile(depth=200, reliability=ReliabilityPolicy.BEST_EFFORT)


def type_name(kind: Any) -> str:
    """Return the name of a message class as bags write it."""
    return f'{kind.__module__.split(".")[0]}/msg/{kind.__name__}'


class BagRecorder(Node):
    """Writes the input topics of one node to a bag."""

    def __init__(self, target: str, writer: Writer, most: int | None = None) -> None:
        super().__init__('grasp_quality_recorder')
        self._target, self._writer, self._most = target.rstrip('/'), writer, most
        self._store = get_typestore(Stores.ROS2_JAZZY)
        for name, definition in OURS.items():
            self._store.register(get_types_from_msg(definition, name))
        self._topics: set[str] = set()
        self._heard: set[str] = set()
        self.count = 0
        for name, kind in TOPICS.items():
            self._record(f'{self._target}/{name}', kind)
        self._look()
        self.create_timer(LOOK_S, self._look)
        self._silence = self.create_timer(SILENCE_S, self._tell_silence)

    @property
    def complete(self) -> bool:
        """Whether all messages that were asked for are recorded."""
        return self._most is not None and self.count >= self._most

    def _tell_silence(self) -> None:
        self._silence.cancel()
        if not self._heard:
            topics = ', '.join(sorted(self._topics))
            print(f'nothing heard yet on {topics}: is the driver running?',
                  file=sys.stderr, flush=True)

    def _look(self) -> None:
        """Record the measured wrenches of contacts that have come up."""
        begin = f'{self._target}/{MEASURED}'
        for topic, types in self.get_topic_names_and_types():
            if topic.startswith(begin) and 'geometry_msgs/msg/WrenchStamped' in types:
                self._record(topic, WrenchStamped)

    def _record(self, topic: str, kind: Any) -> None:
        if topic in self._topics:
            return
        self._topics.add(topic)
        connection = self._writer.add_connection(topic, type_name(kind), typestore=self._store)
        self.create_subscription(kind, topic, self._writing(topic, connection), QOS, raw=True)

    def _writing(self, topic: str, connection: Any) -> Callable[[bytes], None]:
        def write(data: bytes) -> None:
            if self.complete:
                return
            if topic not in self._heard:
                self._heard.add(topic)
                print(f'hears {topic}', flush=True)
            self._writer.write(connection, self.get_clock().now().nanoseconds, data)
            self.count += 1

        return write


def main(arguments: Sequence[str] | None = None) -> int:
    """Record until a signal comes, or all that was asked for; return the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').strip().splitlines()[0])
    parser.add_argument('bag', type=Path, help='folder to write')
    parser.add_argument('--node', default='/grasp_quality',
                        help='whose input topics to record (default %(default)s)')
    parser.add_argument('--overwrite', action='store_true',
                        help='replace a bag that is there already')
    parser.add_argument('--messages', type=int, metavar='N',
                        help='end when this many are recorded')
    options = parser.parse_args(arguments)
    if options.messages is not None and options.messages < 1:
        parser.error(f'--messages must be at least 1, got {options.messages}')
    if options.overwrite and any(options.bag.glob('*.mcap')):
        shutil.rmtree(options.bag)
    if options.bag.exists():
        print(f'bag_recorder: {options.bag} is there already: name another folder, or give '
              '--overwrite', file=sys.stderr)
        return 2
    stopping: list[bool] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stopping.append(True))
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        with Writer(options.bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            recorder = BagRecorder(options.node, writer, options.messages)
            executor = SingleThreadedExecutor()
            executor.add_node(recorder)
            print(f'recording to {options.bag}', flush=True)
            while not stopping and not recorder.complete:
                executor.spin_once(timeout_sec=0.1)
            executor.shutdown()
            recorder.destroy_node()
        print(f'recorded {recorder.count:,} messages to {options.bag}', flush=True)
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A publisher of contacts or loads as a process, so that it can be killed: see ``--help``."""

import argparse
import math
from pathlib import Path
import signal
import sys
import time

sys.path.insert(0, str(Path(__file__).parents[1] / 'node'))

from geometry_msgs.msg import Pose, WrenchStamped  # noqa: E402
import grasps  # noqa: E402
from harness import BEST_EFFORT  # noqa: E402
from msg_adapters.qos import newest_command  # noqa: E402
import rclpy  # noqa: E402
from rclpy.signals import SignalHandlerOptions  # noqa: E402
from rclpy.time import Time  # noqa: E402

NEVER = 1e9  # [s]


def arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('target', help='name of the quality node, with its namespace')
    parser.add_argument('--grasp', default='ANTIPODAL', help='name of a grasp in grasps.py')
    parser.add_argument('--ring', type=int, help='so many contacts around a sphere instead')
    parser.add_argument('--load', type=float, help='a force along z [N] instead of contacts')
    parser.add_argument('--rate', type=float, default=100.0, help='[Hz]')
    parser.add_argument('--stamps', default='0.0', help='zero, or seconds ahead of now; after '
                        'SIGUSR1 the last one again and again')
    parser.add_argument('--seconds', type=float, default=NEVER, help='end after so long')
    return parser.parse_args()


def ring(count: int) -> list[Pose]:
    """Return contacts on the equator of a ball of 3 cm radius."""
    return [grasps.pose((0.03 * math.cos(a), 0.03 * math.sin(a), 0.0),
                        (-math.cos(a), -math.sin(a), 0.0))
            for a in (2.0 * math.pi * i / count for i in range(count))]


def main() -> int:
    """Publish until a signal comes or the time is over; print how many were sent."""
    asked = arguments()
    stopping: list[int] = []
    frozen: list[int] = []
    signal.signal(signal.SIGUSR1, lambda received, frame: frozen.append(received))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, frame: stopping.append(received))
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node('contact_feed', start_parameter_services=False)
    message, topic, qos = (
        grasps.pose_array(ring(asked.ring) if asked.ring else getattr(grasps, asked.grasp)),
        'contact_poses', BEST_EFFORT) if asked.load is None else (
        WrenchStamped(wrench=grasps.wrench(fz=asked.load)), 'external_wrench', newest_command())
    publisher = node.create_publisher(type(message), f'{asked.target}/{topic}', qos)
    while not publisher.get_subscription_count() and not stopping:
        time.sleep(0.01)
    begin, sent = time.monotonic(), 0
    ahead_ns = 0 if asked.stamps == 'zero' else int(1e9 * float(asked.stamps))
    due = begin
    while not stopping and time.monotonic() - begin < asked.seconds:
        if asked.stamps != 'zero' and not frozen:
            now_ns = node.get_clock().now().nanoseconds
            message.header.stamp = Time(nanoseconds=now_ns + ahead_ns).to_msg()
        publisher.publish(message)
        if not sent:
            print('publishing', flush=True)
        sent += 1
        due = max(due + 1.0 / asked.rate, time.monotonic() - 1.0 / asked.rate)
        time.sleep(max(0.0, due - time.monotonic()))
    print(f'sent {sent}', flush=True)
    node.destroy_node()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())

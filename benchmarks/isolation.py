# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a participant on another host sees of a quality node: ``python -m benchmarks.isolation``.

Two network namespaces joined by a cable stand for two hosts. The node runs in one, first with the
discovery range of demo and tests, then with ROS 2's own as the control; from the other one its
topics are looked for. Needs root and iproute2. Ends with code 1 when the result is not
as promised.
"""

import os
from pathlib import Path
import signal
import subprocess
import sys

from ament_index_python.packages import get_package_prefix

HOSTS = (('grasp_quality_hand', '10.213.0.1'), ('grasp_quality_stranger', '10.213.0.2'))
LOOK_S = 10.0
DOMAIN = 42
LOOK = f"""
import time, rclpy
rclpy.init()
node = rclpy.create_node('stranger')
end, seen = time.monotonic() + {LOOK_S}, 0
while time.monotonic() < end and not seen:
    rclpy.spin_once(node, timeout_sec=0.1)
    seen = sum(name.startswith('/grasp_quality/') for name, _ in node.get_topic_names_and_types())
print(seen)
"""


def ip(*words):
    """Run ip and fail with what it says."""
    subprocess.run(['ip', *words], check=True)


def connect():
    """Make two hosts with a cable between them."""
    for host, _ in HOSTS:
        ip('netns', 'add', host)
    (one, _), (two, _) = HOSTS
    ip('link', 'add', 'gq0', 'netns', one, 'type', 'veth', 'peer', 'gq1', 'netns', two)
    for (host, address), cable in zip(HOSTS, ('gq0', 'gq1')):
        ip('-n', host, 'address', 'add', f'{address}/24', 'dev', cable)
        ip('-n', host, 'link', 'set', cable, 'up')
        ip('-n', host, 'link', 'set', 'lo', 'up')


def topics_seen(discovery_range):
    """Run the node on one host and count its topics that the other one sees."""
    environment = {**os.environ, 'ROS_DOMAIN_ID': str(DOMAIN),
                   'ROS_AUTOMATIC_DISCOVERY_RANGE': discovery_range,
                   'FASTDDS_BUILTIN_TRANSPORTS': 'UDPv4'}  # shared memory knows no hosts
    program = Path(get_package_prefix('grasp_quality'), 'lib/grasp_quality/grasp_quality_node')
    node = subprocess.Popen(
        ['ip', 'netns', 'exec', HOSTS[0][0], sys.executable, program], env=environment,
        stderr=subprocess.PIPE, text=True)
    try:
        next(line for line in node.stderr if 'active' in line)
        # the stranger looks as far as it can, whatever the node was told
        looked = subprocess.run(
            ['ip', 'netns', 'exec', HOSTS[1][0], sys.executable, '-c', LOOK], text=True,
            stdout=subprocess.PIPE, check=True,
            env={**environment, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'})
        return int(looked.stdout)
    finally:
        node.send_signal(signal.SIGINT)
        node.wait()


def main():
    """Measure and print; return 1 when a host sees what it should not, or nothing at all."""
    try:
        connect()
        hidden, open_ = topics_seen('LOCALHOST'), topics_seen('SUBNET')
    finally:
        for host, _ in HOSTS:
            subprocess.run(['ip', 'netns', 'delete', host], check=False)
    print(f'topics of the node that another host sees within {LOOK_S:g} s: {hidden} with the '
          f'discovery range LOCALHOST, {open_} with SUBNET')
    return int(hidden > 0 or not open_)


if __name__ == '__main__':
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a participant on another host sees of a quality node: ``python -m benchmarks.isolation``.

Two network namespaces joined by a cable stand for two hosts. The node runs in one, with the
discovery range of the demo, with the profile of the tests, and with ROS 2's own range as the
control; from the other one its topics are looked for. Needs root and iproute2. Ends with code 1
when the result is not as promised.
"""

import os
from pathlib import Path
import signal
import subprocess
import sys

from ament_index_python.packages import get_package_prefix

sys.path.insert(0, str(Path(__file__).parents[1] / 'test' / 'node'))

from transports import FILE, PROFILE, RANGE  # noqa: E402

HOSTS = (('grasp_quality_hand', '10.213.0.1'), ('grasp_quality_stranger', '10.213.0.2'))
LOOK_S = 10.0
DOMAIN = 42
# no shared memory where all is open: it knows no hosts
OPEN = {RANGE: 'SUBNET', 'FASTDDS_BUILTIN_TRANSPORTS': 'UDPv4'}
WAYS = {'LOCALHOST': {RANGE: 'LOCALHOST'},
        'the profile of the tests': {RANGE: 'SYSTEM_DEFAULT', FILE: str(PROFILE)},
        'SUBNET': OPEN}
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


def topics_seen(way):
    """Run the node on one host and count its topics that the other one sees."""
    environment = {**os.environ, 'ROS_DOMAIN_ID': str(DOMAIN)}
    program = Path(get_package_prefix('grasp_quality'), 'lib/grasp_quality/grasp_quality_node')
    node = subprocess.Popen(
        ['ip', 'netns', 'exec', HOSTS[0][0], sys.executable, program],
        env={**environment, **way}, stderr=subprocess.PIPE, text=True)
    try:
        next(line for line in node.stderr if 'active' in line)
        # the stranger looks as far as it can, whatever the node was told
        looked = subprocess.run(
            ['ip', 'netns', 'exec', HOSTS[1][0], sys.executable, '-c', LOOK], text=True,
            stdout=subprocess.PIPE, check=True,
            env={**environment, **OPEN})
        return int(looked.stdout)
    finally:
        node.send_signal(signal.SIGINT)
        node.wait()


def main():
    """Measure and print; return 1 when a host sees what it should not, or nothing at all."""
    try:
        connect()
        seen = {name: topics_seen(way) for name, way in WAYS.items()}
    finally:
        for host, _ in HOSTS:
            subprocess.run(['ip', 'netns', 'delete', host], check=False)
    print(f'topics of the node that another host sees within {LOOK_S:g} s: '
          + ', '.join(f'{count} with {name}' for name, count in seen.items()))
    open_ = seen.pop('SUBNET')
    return int(any(seen.values()) or not open_)


if __name__ == '__main__':
    sys.exit(main())

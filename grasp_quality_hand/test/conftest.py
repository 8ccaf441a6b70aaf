# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A running simulated hand in a ROS domain of its own."""

import os
from pathlib import Path
import signal
import sys

sys.path.insert(0, str(Path(__file__).parents[2] / 'test' / 'node'))

from grasp_quality_hand.demo_processes import claim_domain  # noqa: E402
from hand_rig import Client, DEADLINE, start  # noqa: E402
import pytest  # noqa: E402
from transports import keep_to_this_machine  # noqa: E402


@pytest.fixture(scope='module')
def domain():
    """Take a ROS domain; put the environment back afterwards."""
    before = os.environ.get('ROS_DOMAIN_ID')
    claim = claim_domain()
    keep_to_this_machine()  # as all tests do it, not as the demo
    yield int(os.environ['ROS_DOMAIN_ID'])
    claim.close()
    os.environ.pop('ROS_DOMAIN_ID')
    if before is not None:
        os.environ['ROS_DOMAIN_ID'] = before


@pytest.fixture(scope='module')
def client(domain):
    """Return a client of a running hand, which must end with 0 on SIGINT."""
    process = start('-p', 'target_node:=a_hand/grasp_quality')
    client = Client(domain)
    try:
        client.spin_until(lambda: all(client.heard.values()))
        yield client
    finally:
        client.close()
        process.send_signal(signal.SIGINT)
        code = process.wait(DEADLINE)
    assert code == 0

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A running simulated hand in a ROS domain of its own."""

import os
import signal

from grasp_quality_hand.demo_processes import claim_domain, discovery_environment
from hand_rig import Client, DEADLINE, start
import pytest


@pytest.fixture(scope='module')
def domain():
    """Take a ROS domain; put the environment back afterwards."""
    before = {name: os.environ.get(name) for name in discovery_environment(0)}
    claim = claim_domain()
    yield int(os.environ['ROS_DOMAIN_ID'])
    claim.close()
    for name, value in before.items():
        os.environ.pop(name)
        if value is not None:
            os.environ[name] = value


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

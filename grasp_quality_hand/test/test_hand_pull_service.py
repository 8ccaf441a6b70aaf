# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The service that pulls, over DDS."""

import time

from grasp_quality_msgs.srv import PullObject
from hand_rig import DEADLINE
import pytest


def pull(client, **request):
    """Return the answer of a pull downwards, in newtons."""
    message = PullObject.Request(**request)
    message.wrench.force.z = -1.0
    return client.call(PullObject, 'pull', message)


def hold(client):
    """Close the hand, and wait until it holds the object by itself: it can then be pulled."""
    client.trigger('close')
    end = time.monotonic() + DEADLINE
    while not pull(client, growth=1.0, limit=1e-3).success:
        assert time.monotonic() < end, 'waited in vain'


def test_pull_grows_until_slip_and_answers_with_the_load_held(client):
    client.trigger('load_object')
    assert 'does not hold' in pull(client).message
    hold(client)
    answer = pull(client, growth=4.0)
    assert answer.success and answer.slipped and answer.moved > 5e-4
    assert 1.0 < answer.held < 15.0 and answer.load.force.z == pytest.approx(-answer.held)
    loads = [-message.wrench.force.z for message in client.heard['/simulated_hand/load']]
    assert 0.0 < max(loads) <= answer.held
    again = pull(client, growth=4.0, limit=0.1)
    assert again.success and not again.slipped and again.held == pytest.approx(0.1)
    assert 'growth' in pull(client, growth=-1.0).message


def test_opening_the_hand_breaks_a_pull_off(client):
    client.trigger('load_object')
    hold(client)
    service = client.node.create_client(PullObject, '/simulated_hand/pull')
    client.spin_until(service.service_is_ready)
    request = PullObject.Request(growth=1e-2)
    request.wrench.force.z = -1.0
    future = service.call_async(request)
    loads = client.heard['/simulated_hand/load']
    # more than hold() pulled with, whose last loads may still be on their way
    client.spin_until(lambda: loads and loads[-1].wrench.force.z < -2e-3)
    client.trigger('open')
    client.spin_until(future.done)
    assert not future.result().success and 'broken off' in future.result().message

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Force maps there and back; what is not a map is refused."""

import math

from grasp_quality_msgs.msg import ForceMap
from msg_adapters.errors import InvalidMessageError
from msg_adapters.force_map import alphas_of, force_map
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Header

ALPHAS = np.arange(18.0) ** 2


def test_a_map_comes_back_as_it_was_sent():
    sent = force_map(Header(frame_id='object'), 3, ALPHAS)
    heard = deserialize_message(serialize_message(sent), ForceMap)
    assert heard.resolution == 3 and heard.header.frame_id == 'object'
    np.testing.assert_array_equal(alphas_of(heard), ALPHAS)


def test_no_map_is_empty():
    nothing = force_map(Header(frame_id='object'))
    assert (nothing.resolution, nothing.header.frame_id) == (0, 'object')
    for resolution in (0, 3):
        assert alphas_of(force_map(Header(), resolution)).shape == (0,)


@pytest.mark.parametrize('resolution, alphas, words', [
    (3, ALPHAS[:17], r'be empty or hold 2 resolution\^2 = 18 numbers, got 17'),
    (3, ALPHAS[:1], r'be empty or hold 2 resolution\^2 = 18 numbers, got 1'),
    (2, ALPHAS, 'be empty or hold .* = 8 numbers, got 18'),
    (3, np.append(ALPHAS[:17], math.nan), 'be finite and at least 0'),
    (3, np.append(ALPHAS[:17], math.inf), 'be finite and at least 0'),
    (3, np.append(ALPHAS[:17], -1e-9), 'be finite and at least 0')])
def test_what_is_no_map_is_refused(resolution, alphas, words):
    with pytest.raises(InvalidMessageError, match=f'^alphas must {words}$'):
        alphas_of(force_map(Header(), resolution, alphas))

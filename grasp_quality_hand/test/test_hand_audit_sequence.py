# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What was lost of a topic is told from the numbers of what came."""

from grasp_quality_hand.audit_sequence import MOST, Sequence
from hypothesis import given, strategies as st
import numpy as np
import pytest


def lost(*numbers):
    """Take messages sent at 0, 1, 2... s and return since when some are missing, for each."""
    sequence = Sequence()
    return [sequence.lost_since(number, float(i)) for i, number in enumerate(numbers)]


@given(st.lists(st.booleans(), min_size=1, max_size=50).filter(any))
def test_every_gap_of_one_publisher_is_known_and_nothing_else(came):
    """Message i is sent at i s; those that came tell exactly which did not, up to the last."""
    sequence, missing = Sequence(), set()
    for i in np.flatnonzero(came):
        since_s = sequence.lost_since(int(i) + 1, float(i))
        if since_s is not None:
            missing |= {j for j in range(i) if j > since_s}
    last = int(np.flatnonzero(came)[-1])
    assert missing == {i for i in range(last) if not came[i]}


def test_two_publishers_at_once_hide_nothing():
    assert lost(1, 1, 2, 2, 3, 3)[2:] == [None] * 4
    assert lost(1, 50, 2, 51, 3, 53, 4) == [None, 0.0, 1.0, None, None, 3.0, None]


def test_a_new_publisher_does_not_tell_what_the_one_before_it_said_last():
    assert lost(7, 8, 1, 2) == [-np.inf, None, 1.0, None]


def test_what_came_before_the_first_is_unknown_unless_it_is_number_one():
    assert lost(5) == [-np.inf] and lost(1) == [None]


def test_a_middleware_that_does_not_count_tells_nothing():
    assert lost(None, None) == [None, None]


@pytest.mark.parametrize('starts', [MOST + 1, 10 * MOST])
def test_publishers_that_are_gone_are_forgotten(starts):
    sequence = Sequence()
    for i in range(starts):
        sequence.lost_since(10 * (starts - i), float(i))
    assert len(sequence._newest) <= MOST

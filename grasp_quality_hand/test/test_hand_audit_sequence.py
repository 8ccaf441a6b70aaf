# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What was lost of a topic is told from the numbers of what came."""

from grasp_quality_hand.audit_sequence import Gaps, GONE_S, MOST, Sequence
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


@given(st.lists(st.tuples(st.integers(0, 1), st.sampled_from(['came', 'came', 'lost', 'anew'])),
                max_size=30))
def test_every_loss_of_any_publisher_lies_in_a_reported_gap(sent):
    """Two publishers send in turns, lose messages and start anew, of which the first comes."""
    sequence, gaps, losses, pending = Sequence(), [], [], ([], [])
    numbers = [0, 0]
    for i, (publisher, what) in enumerate(sent):
        sent_s = 0.1 * i  # all of it within GONE_S
        if what == 'anew':
            numbers[publisher] = 0
            pending[publisher].clear()  # nobody can tell what it said last
        numbers[publisher] += 1
        if what == 'lost' and numbers[publisher] > 1:
            pending[publisher].append(sent_s)
            continue
        losses += pending[publisher]
        pending[publisher].clear()
        since_s = sequence.lost_since(numbers[publisher], sent_s)
        if since_s is not None:
            gaps.append((since_s, sent_s))
    assert all(any(since_s < loss_s < until_s for since_s, until_s in gaps) for loss_s in losses)


def test_two_publishers_at_once_hide_nothing():
    """With two that can be told apart by nothing, a message of one may follow the other's."""
    assert lost(1, 1, 2, 2, 3, 3)[2:] == [None] * 4
    assert lost(1, 50, 2, 51, 3, 53, 4) == [None, 0.0, -np.inf, 2.0, None, 3.0, None]
    assert lost(1, 2, 3, 1, 2, 4)[3:] == [2.0, None, 4.0]


def test_after_a_publisher_is_gone_every_gap_is_exact_again():
    sequence = Sequence()
    for number in (1, 2, 3):
        sequence.lost_since(number, 0.1 * number)
    sent_s = [1.0 + 0.5 * i for i in range(30)]
    said = [sequence.lost_since(i + 1, t) for i, t in enumerate(sent_s)]
    assert all(since_s is None for since_s, t in zip(said, sent_s) if t > 1.0 + GONE_S)
    assert sequence.lost_since(32, 20.0) == sent_s[-1]


def test_one_publisher_may_be_silent_for_any_time():
    sequence = Sequence()
    sequence.lost_since(1, 0.0)
    assert sequence.lost_since(2, 1e3 * GONE_S) is None
    assert sequence.lost_since(4, 1e6 * GONE_S) == 1e3 * GONE_S


def test_a_new_publisher_does_not_tell_what_the_one_before_it_said_last():
    assert lost(7, 8, 1, 2) == [-np.inf, None, 1.0, None]
    assert lost(7, 8, 3) == [-np.inf, None, -np.inf]


def test_what_came_before_the_first_is_unknown_unless_it_is_number_one():
    assert lost(5) == [-np.inf] and lost(1) == [None]


def test_where_the_middleware_does_not_count_anything_may_be_lost():
    assert lost(None, None, None) == [-np.inf, 0.0, 1.0]


def test_gaps_that_follow_each_other_are_one():
    gaps = Gaps()
    for i in range(1, 1_000):
        gaps.note(float(i), i - 1.0)
    gaps.note(2_000.0, None)
    assert len(gaps._lost) == 1
    assert gaps.may_come(500.0, 1.0) and gaps.may_come(-0.5, 1.0)
    assert not gaps.may_come(-1.5, 1.0) and not gaps.may_come(1_001.0, 1.0)


@pytest.mark.parametrize('starts', [MOST + 1, 10 * MOST])
def test_publishers_that_are_gone_are_forgotten(starts):
    sequence = Sequence()
    for i in range(starts):
        sequence.lost_since(10 * (starts - i), float(i))
    assert len(sequence._newest) <= MOST

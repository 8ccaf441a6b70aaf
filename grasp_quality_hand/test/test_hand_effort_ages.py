# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How old a message is, which one counts, and what a pause does to a hold."""

from grasp_quality_hand.effort_bridge import FramedPushes, LONGEST_STEP_S
from grasp_quality_hand.effort_command import Phase
from grasp_quality_hand.effort_inputs import Newest, Unusable
from hypothesis import given, strategies
from msg_adapters.errors import InvalidMessageError
import numpy as np
import pytest
from test_hand_effort_bridge import at, pinch, RATE_HZ, Rig

EXACT = 1e-9
ages = strategies.floats(0.0, 20.0)


@given(ages, ages, ages, strategies.booleans())
def test_a_message_is_as_old_as_the_oldest_of_stamp_sending_and_arrival(stamp, sent, held, has):
    newest, began = Newest('things', 0.1), at(100.0)
    newest.put('thing', began.ros_ns - round(1e9 * stamp) if has else 0, began, sent)
    now = at(100.0 + held)
    assert newest.age(now) == pytest.approx(held + max(stamp if has else 0.0, sent), abs=1e-6)


@pytest.mark.parametrize('stamp', [0, 10 ** 9])
def test_what_waited_in_a_queue_is_no_use_whatever_its_stamp(stamp):
    newest = Newest('things', 0.1)
    newest.put('thing', stamp, at(1.0), 0.2)
    with pytest.raises(Unusable, match='older than'):
        newest.fresh(at(1.0))


def test_a_message_without_a_stamp_lets_no_older_one_in():
    newest = Newest('things', 0.1)
    newest.put('new', 10 ** 9, at(1.0))
    newest.put('without', 0, at(1.01))
    newest.put('late', 10 ** 9 - 1, at(1.02))
    assert newest.fresh(at(1.03)) == 'without' and newest.dropped == 1
    newest.put('after', 10 ** 9 + 1, at(1.04))
    assert newest.fresh(at(1.05)) == 'after'


def test_what_was_refused_is_told_until_something_better_comes():
    newest = Newest('things', 0.1)
    newest.refuse('effort must be finite')
    with pytest.raises(Unusable, match='no things .* refused: effort must be finite'):
        newest.fresh(at(1.0))
    newest.put('thing', 0, at(1.0))
    newest.refuse('nan')
    assert newest.fresh(at(1.05)) == 'thing'
    with pytest.raises(Unusable, match='older than .* refused: nan'):
        newest.fresh(at(1.2))
    newest.put('thing', 0, at(2.0))
    with pytest.raises(Unusable, match='older than 0.1 s$'):
        newest.fresh(at(3.0))


def test_after_a_pause_a_hold_begins_with_a_small_step():
    rig = Rig(efforts=np.zeros(2))
    rig.feed()
    followed = rig.tick()
    rig.wait(3.0)
    assert rig.tick() == pytest.approx(followed * (1.0 - LONGEST_STEP_S / 0.2), abs=EXACT)
    rig.wait(3.0)
    assert rig.tick() == pytest.approx(followed * (1.0 - 2.0 * LONGEST_STEP_S / 0.2), abs=EXACT)


def test_a_slow_bridge_holds_within_the_ramp_time_and_a_period():
    rig = Rig(efforts=np.zeros(2), period=1.0)
    rig.feed()
    rig.tick()
    rig.wait(1.0 - 1.0 / RATE_HZ)
    assert rig.tick() == pytest.approx([0.0, 0.0], abs=EXACT)
    assert rig.report.phase is Phase.HOLDING


def test_forces_that_were_too_old_when_read_never_get_into_the_hold():
    rig = Rig()
    rig.feed()
    followed = rig.tick()
    rig.feed()
    rig.bridge.forces.put(FramedPushes('object', pinch(6.0)), 0, rig.now, 0.2)
    for _ in range(60):
        held = rig.tick()
    assert held == pytest.approx(followed, abs=EXACT)


def test_more_forces_than_contacts_are_refused():
    rig = Rig()
    rig.bridge.check_count(2)
    with pytest.raises(InvalidMessageError, match='3 came for 2 contact_names'):
        rig.bridge.check_count(3)

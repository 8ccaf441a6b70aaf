# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The audit does not judge by what it cannot know: lost qualities, parameters of long before."""

from audit_cases import (
    changed, CONTACTS, FORCES, LEFT_FORCE, LOCAL, NEXT, QUALITY, RIGHT_FORCE, SETTINGS)
from grasp_quality_hand.audit_parts import Quality
from grasp_quality_hand.force_records import ForceRecords, GRACE_S, LATE_S, MEMORY_S, UNREAD_S
import numpy as np
import pytest

SHARE = 5.9 / 6.0
LESS = [changed(QUALITY, alpha=2.9), changed(FORCES, forces=[
    changed(force, wrench=force.wrench * (1.0, 1.0, SHARE, 1.0, 1.0, 1.0), cone_usage=SHARE)
    for force in FORCES.forces])]
FAILURE = changed(QUALITY, optimal=False, alpha=0.0, others=(0.0,))


def after_a_loss(*parts, lost_s=1.0):
    """Judge parts of 1 s, of which the quality came after others that were lost since lost_s."""
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    for part in parts:
        records.store(part, 1.0, 1.0, lost_s if isinstance(part, Quality) else None)
    records.store(NEXT, 1.2)
    return records.judge(3.0 * GRACE_S), records.count


@pytest.mark.parametrize('parts', [
    (QUALITY, 4.0), (CONTACTS, changed(QUALITY, alpha=2.9), FORCES),
    (CONTACTS, FAILURE, FORCES)])
def test_where_a_quality_is_known_to_be_lost_it_may_be_the_one_that_fits(parts):
    said, count = after_a_loss(*parts)
    assert said == [] and count.unjudged == {'quality': 1} and count.judged == 0
    said, _ = after_a_loss(*parts, lost_s=None)
    assert len(said) == 1


@pytest.mark.parametrize('parts, late', [
    ([QUALITY, 4.0], changed(QUALITY, alpha=4.0)),
    ([CONTACTS, FAILURE, FORCES], QUALITY),
    ([CONTACTS, changed(QUALITY, alpha=2.9), FORCES], QUALITY)])
def test_a_quality_may_come_late(parts, late):
    """No number tells that one is missing before a later one has come."""
    for came, wrong in ((True, 0), (False, 1)):
        records = ForceRecords()
        records.store(SETTINGS, 0.0)
        for part in parts:
            records.store(part, 1.0)
        assert records.judge(0.9 * LATE_S) == []
        if came:
            records.store(late, 0.9 * LATE_S, 1.0)
        records.store(NEXT, 0.9 * LATE_S, 1.2)
        assert len(records.judge(LATE_S)) == wrong


@pytest.mark.parametrize('parts', [
    [QUALITY, 4.0], [CONTACTS, FAILURE, FORCES], [CONTACTS, changed(QUALITY, alpha=2.9), FORCES]])
def test_where_no_later_quality_comes_nothing_is_certain(parts):
    records = ForceRecords()
    for part in (SETTINGS, *parts):
        records.store(part, 1.0)
    assert records.judge(2.0 * LATE_S) == [] and records.count.unjudged == {'quality': 1}


@pytest.mark.parametrize('part, words', [
    (changed(FORCES, forces=[FORCES.forces[0], changed(RIGHT_FORCE, wrench=np.array(
        [-5.0, 0.0, 3.0, 0.0, 0.0, 0.0]))]), 'outside its friction cone'),
    (changed(FORCES, age_s=0.2), 'after their contacts'),
    (changed(QUALITY, others=(np.nan, 0.0)), 'not finite')])
def test_a_lost_quality_excuses_nothing_that_is_wrong_whatever_it_said(part, words):
    said, _ = after_a_loss(*[
        part if type(part) is type(other) else other for other in (CONTACTS, QUALITY, FORCES)])
    assert any(words in text for text in said), said


@pytest.mark.parametrize('sent_s, wrong', [(0.5, 0), (1.5, 1)])
def test_forces_of_before_the_first_known_parameters_are_not_judged_by_these(sent_s, wrong):
    records = ForceRecords()
    for part in (CONTACTS, QUALITY, FORCES):
        records.store(part, sent_s)
    records.store(NEXT, sent_s + 0.2)
    records.store(changed(SETTINGS, friction_coefficient=0.1), 1.0)  # they lay outside its cones
    said = records.judge(sent_s + 2.0 * GRACE_S)
    assert bool(said) == bool(wrong)
    assert records.count.unjudged == ({} if wrong else {'settings of its time': 1})


PULLING = changed(FORCES, forces=[changed(LEFT_FORCE, wrench=-LEFT_FORCE.wrench), RIGHT_FORCE])


@pytest.mark.parametrize('part, words', [
    (np.nan, 'alpha is nan'), (np.inf, 'alpha is inf'), (-1.0, 'alpha is -1'),
    (changed(LOCAL, wrench=np.full(6, np.nan)), 'not finite'),
    (changed(LOCAL, wrench=np.array([0.0, 0.0, np.inf, 0.0, 0.0, 0.0])), 'not finite'),
    (changed(LOCAL, frame='right'), "in the frame 'right'"),
    (changed(LOCAL, frame='right', wrench=np.zeros(6)), "in the frame 'right'"),
    (changed(QUALITY, alpha=-1.0), 'alpha is -1')])
def test_what_may_never_be_said_is_a_violation_whatever_was_lost(part, words):
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    records.store(part, 1.0)
    said = records.judge(1.0 + 2.0 * LATE_S)
    assert len(said) == 1 and words in said[0]


def test_what_came_before_the_first_parameters_is_judged_by_what_always_holds():
    records = ForceRecords()
    for part in (CONTACTS, QUALITY, PULLING):
        records.store(part, 0.5)
    records.store(NEXT, 0.7)
    records.store(SETTINGS, 1.0)
    said = records.judge(0.5 + 2.0 * GRACE_S)
    assert len(said) == 1 and 'it pulls' in said[0]
    assert records.count.unjudged == {'settings of its time': 1}


def test_where_nothing_has_a_stamp_of_its_own_what_always_holds_is_judged():
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    for i in range(300):
        records.store(changed(CONTACTS, contacts=[
            changed(contact, position=contact.position + 1e-3 * i)
            for contact in CONTACTS.contacts]), 1.0)
    for part in (QUALITY, PULLING):
        records.store(part, 1.0)
    records.store(NEXT, 1.2)
    said = records.judge(3.0 * GRACE_S)
    assert len(said) == 1 and 'it pulls' in said[0]
    assert records.count.unjudged == {'stamp of its own': 1}


@pytest.mark.parametrize('part', [FORCES, LOCAL])
def test_what_is_sent_when_the_parameters_may_be_others_waits_for_them(part):
    """A node is killed and started with other parameters, and says so 4 s later."""
    weak = changed(SETTINGS, friction_coefficient=0.1, contact_names=('other', 'right'))
    records = ForceRecords()
    records.store(weak, 0.0)
    for other in (CONTACTS, QUALITY, FORCES, part):
        records.store(other, 10.0)
    records.store(NEXT, 10.2)
    assert records.judge(14.0, sure_s=8.0) == [] and not records.count.judged
    answered = SETTINGS, 14.0, 8.0
    records.store(*answered)
    records.store(changed(FORCES, stamp=7), 14.1)
    assert records.judge(14.1, sure_s=13.5) == [] and records.count.judged
    assert not records.count.unjudged


@pytest.mark.parametrize('part', [FORCES, LOCAL])
def test_where_parameters_are_not_told_objections_are_left(part):
    weak = changed(SETTINGS, friction_coefficient=0.1, contact_names=('other', 'right'))
    for sure_s, wrong in ((8.0, False), (10.0, True)):
        records = ForceRecords()
        records.store(weak, 0.0)
        for other in (CONTACTS, QUALITY, FORCES, part):
            records.store(other, 10.0)
        records.store(NEXT, 10.2)
        said = records.judge(10.0 + LATE_S, sure_s)
        assert bool(said) == wrong
        assert records.count.unjudged.get('parameters', 0) == (0 if wrong else 2)


def test_what_pulls_is_a_violation_by_parameters_that_are_not_told_too():
    records = ForceRecords()
    for part in (SETTINGS, CONTACTS, QUALITY, PULLING):
        records.store(part, 10.0)
    records.store(NEXT, 10.2)
    said = records.judge(10.0 + LATE_S, 8.0)
    assert len(said) == 1 and 'it pulls' in said[0]


def test_a_loss_of_long_before_excuses_nothing():
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    records.store(QUALITY, 1.0, 1.0, 0.9)
    for part in (QUALITY, 4.0):
        records.store(part, 3.0)
    records.store(NEXT, 3.2)
    assert records.judge(3.0 + 2.0 * GRACE_S) == ['alpha 4 stands in no OPTIMAL quality']


@pytest.mark.parametrize('parts, late', [
    ([QUALITY], 3.0),
    ([CONTACTS, QUALITY], FORCES),
    ([CONTACTS, QUALITY, FORCES], LOCAL)])
@pytest.mark.parametrize('again', [[FAILURE], LESS])
def test_what_was_read_late_may_belong_to_what_is_forgotten(parts, late, again):
    """All of it is true; the same sample was evaluated once more since."""
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    for part in parts:
        records.store(part, 1.0)
    now_s = 1.0 + MEMORY_S
    records.store(CONTACTS, now_s - 0.1)
    for part in again:
        records.store(part, now_s - 0.1)
    assert records.judge(now_s + 0.1) == []  # forgets
    records.store(late, now_s, 1.0)
    records.store(changed(NEXT, stamp=NEXT.stamp + 1), now_s + 0.2)
    assert records.judge(now_s + LATE_S + 1.0) == [] and records.count.violations == 0


def test_what_is_never_true_is_told_however_late_it_was_read():
    pulls = changed(FORCES, forces=[
        changed(LEFT_FORCE, wrench=-LEFT_FORCE.wrench), changed(RIGHT_FORCE)])
    for part in (-1.0, np.nan, pulls, changed(LOCAL, wrench=np.full(6, np.nan))):
        records = ForceRecords()
        records.store(SETTINGS, 0.0)
        records.store(part, 2.0 + UNREAD_S, 1.0)
        assert len(records.judge(2.0 + UNREAD_S + LATE_S)) == 1

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The audit joins parts by stamp in any order, and judges only what it has seen whole."""

import itertools

from audit_cases import (
    ALL, changed, CONTACTS, FORCES, judged, LEFT_FORCE, LOCAL, NEXT, QUALITY, RIGHT_FORCE,
    SETTINGS)
from grasp_quality_hand.audit_parts import limits_of, ReceivedJoint
from grasp_quality_hand.force_records import ForceRecords, GRACE_S, LATE_S, MEMORY_S
import numpy as np
import pytest

LATER = changed(RIGHT_FORCE, wrench=RIGHT_FORCE.wrench * 1.001)


@pytest.mark.parametrize('parts', itertools.islice(itertools.permutations(ALL), 0, None, 37))
def test_the_order_of_arrival_does_not_matter(parts):
    said, count = judged(*parts)
    assert said == [] and count.judged == 1 and not count.unjudged


@pytest.mark.parametrize('more, grace_s', [([], LATE_S), ([NEXT], GRACE_S)])
def test_nothing_is_judged_before_its_grace_is_over(more, grace_s):
    records = ForceRecords()
    for part in ALL:
        records.store(part, 0.0)
    for part in more:
        records.store(part, 0.2)
    assert records.judge(0.9 * grace_s) == [] and records.count.judged == 0
    assert records.judge(1.1 * grace_s) == [] and records.count.judged == 1


@pytest.mark.parametrize('missing', [SETTINGS, CONTACTS, QUALITY])
def test_what_lacks_a_part_is_counted_and_not_judged(missing):
    said, count = judged(*[part for part in ALL if part is not missing])
    assert said == [] and count.judged == 0 and count.unjudged


@pytest.mark.parametrize('part, words', [
    (changed(FORCES, forces=[FORCES.forces[0], LATER]), 'of stamp'),
    (changed(FORCES, age_s=0.2), 'after their contacts'),
    (changed(QUALITY, optimal=False, alpha=0.0, others=(0.0,)), 'not OPTIMAL'),
    (changed(QUALITY, optimal=False), 'not OPTIMAL and yet holds'),
    (changed(QUALITY, alpha=2.9), 'are missing'),
    (changed(QUALITY, load=np.zeros(6)), 'are missing'),
    (changed(QUALITY, others=(np.nan, 0.0)), 'not finite'),
    (changed(LOCAL, wrench=-LOCAL.wrench), 'is not the force beside it'),
    (changed(SETTINGS, friction_coefficient=0.49), 'outside its friction cone'),
    (changed(SETTINGS, max_normal_force=5.9), 'of the bound')])
def test_a_false_part_is_a_violation(part, words):
    parts = [part if type(part) is type(other) else other for other in ALL]
    said, count = judged(*parts)
    assert any(words in text for text in said), said
    assert count.violations == len(said)


def test_an_alpha_of_no_quality_is_a_violation():
    said, _ = judged(*ALL, 4.0)
    assert said == ['alpha 4 stands in no OPTIMAL quality']


def test_an_alpha_beside_nothing_but_failures_is_a_violation():
    failed = changed(QUALITY, optimal=False, alpha=0.0, others=(0.0,))
    said, _ = judged(SETTINGS, CONTACTS, failed, 3.0)
    assert said == ['alpha 3 stands in no OPTIMAL quality']


def test_forces_beside_a_failure_are_a_violation_without_their_contacts_too():
    failed = changed(QUALITY, optimal=False, alpha=0.0, others=(0.0,))
    said, _ = judged(SETTINGS, failed, FORCES)
    assert len(said) == 1 and 'not OPTIMAL' in said[0]


def test_holding_forces_balance_the_load_alone():
    """FORCES lift 6 N: three tasks and 3 N of load, or 6 N of load and no task."""
    holding = changed(FORCES, are_holding=True)
    said, _ = judged(SETTINGS, CONTACTS, changed(QUALITY, load=2.0 * QUALITY.load), holding)
    assert said == []
    said, _ = judged(SETTINGS, CONTACTS, QUALITY, holding)
    assert len(said) == 1 and 'are missing' in said[0]


def test_a_stamp_evaluated_twice_passes_with_either_quality():
    said, count = judged(*ALL, changed(QUALITY, alpha=1.5, task=2.0 * QUALITY.task), FORCES)
    assert said == [] and count.judged == 2


def test_another_frame_needs_a_transform_that_is_not_known_here():
    _, count = judged(*[changed(CONTACTS, frame='world') if p is CONTACTS else p for p in ALL])
    assert count.unjudged == {'transform': 1}


def test_memory_is_bounded_by_time():
    records = ForceRecords()
    for i in range(3_000):
        for part in ALL:
            stamped = changed(part, stamp=i) if hasattr(part, 'stamp') else part
            records.store(stamped, 0.01 * i)
        records.judge(0.01 * i)
    assert max(len(kept) for kept in records._kept.values()) < 100 * (MEMORY_S + 1.0)
    assert records.count.violations == 0 and records.count.judged > 2_800


def test_defaults_fill_what_messages_leave_open():
    limits = limits_of(changed(CONTACTS, are_poses=False), changed(
        SETTINGS, contact_model='SFCE', contact_fingers=('a', 'b')))
    assert list(limits) == ['contact_0', 'contact_1']
    assert (limits['contact_0'].friction, limits['contact_0'].torsional_friction) == (0.5, 0.005)
    assert limits['contact_1'].finger == 'contact_1'
    assert limits_of(CONTACTS, changed(SETTINGS, contact_model='FPC'))['left'].friction == 0.0


def test_joint_limits_that_came_with_the_contacts_are_kept():
    for limit, broken in ((0.61, []), (0.59, ['joint knuckle needs 0.6 N m of 0.59'])):
        columns = [np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]), np.zeros(6)]
        limited = changed(CONTACTS, joints=[ReceivedJoint('knuckle', limit, 0.0, columns)])
        said, count = judged(*[limited if p is CONTACTS else p for p in ALL])
        assert [text.split(': ', 1)[1] for text in said] == broken and count.judged == 1


PUSHED = np.array([6.0, 0.0, 3.0, 0.0, 0.0, 0.0])  # by the left contact


@pytest.mark.parametrize('missing', [CONTACTS, QUALITY])
@pytest.mark.parametrize('fields, words', [
    ({'wrench': 1e9 * PUSHED}, 'of the bound linf'),
    ({'wrench': np.array([10.1, 0.0, 0.0, 0.0, 0.0, 0.0]), 'cone_usage': 0.0}, 'of the bound'),
    ({'wrench': -PUSHED, 'cone_usage': 0.0}, 'it pulls'), ({'cone_usage': 1.5}, 'its cone usage'),
    ({'cone_usage': 0.5}, 'its cone usage is 1, not 0.5'), ({'cone_usage': np.nan}, 'not finite'),
    ({'normal': np.array([2.0, 0.0, 0.0])}, 'no unit vector'), ({'name': 'right'}, 'two forces'),
    ({'wrench': np.array([6.0, 0.0, 3.1, 0.0, 0.0, 0.0])}, 'outside its friction cone')])
def test_forces_that_are_wrong_whatever_is_missing_are_violations(missing, fields, words):
    bad = changed(FORCES, forces=[changed(LEFT_FORCE, **fields), RIGHT_FORCE])
    parts = [bad if part is FORCES else part for part in ALL if part is not missing]
    said, count = judged(*parts)
    assert any(words in text for text in said), said
    assert count.violations == len(said)


@pytest.mark.parametrize('others', [
    (changed(SETTINGS, contact_source=''), changed(CONTACTS, are_poses=False, stamp=7)),
    (changed(SETTINGS, contact_source='contact_array'),), ()])
def test_contacts_may_bring_limits_of_their_own_that_excuse_what_they_can(others):
    """A cap and a friction coefficient, but no pulling and no cone usage above one."""
    strong = changed(FORCES, forces=[changed(f, wrench=50.0 * f.wrench) for f in FORCES.forces])
    said, count = judged(*others, strong)
    assert said == [] and count.unjudged
    for fields, words in (({'wrench': -PUSHED}, 'it pulls'), ({'cone_usage': 1.5}, 'usage is 1.5'),
                          ({'wrench': np.full(6, np.nan)}, 'not finite')):
        said, _ = judged(*others, changed(FORCES, forces=[changed(LEFT_FORCE, **fields)]))
        assert len(said) == 1 and words in said[0]


def test_without_contacts_the_bound_of_a_finger_and_parameters_before_count():
    settings = changed(SETTINGS, force_bound='finger', contact_fingers=('hand', 'hand'))
    said, _ = judged(settings, FORCES)
    assert len(said) == 1 and '1.2 of the bound finger' in said[0]
    said, _ = judged(changed(SETTINGS, max_normal_force=5.0), SETTINGS, FORCES)
    assert said == []

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What bears one stamp is judged in bounded work, however much of it there is."""

import dataclasses

from audit_cases import (
    ALL, changed, CONTACTS, FORCES, judged, LEFT_FORCE, LOCAL, NEXT, QUALITY, SETTINGS)
from grasp_quality_hand.force_records import ForceRecords, GRACE_S, MEMORY_S, MOST_TRIED
import numpy as np
import pytest


def test_a_frozen_sensor_is_judged_like_any_other():
    said, count = judged(SETTINGS, *[CONTACTS, QUALITY, FORCES] * 300)
    assert said == [] and count.judged == 300


def test_where_nothing_has_a_stamp_of_its_own_nothing_false_is_said():
    many = [changed(CONTACTS, contacts=[
        changed(contact, position=contact.position + 1e-3 * i) for contact in CONTACTS.contacts])
        for i in range(1, 300)]
    said, count = judged(SETTINGS, CONTACTS, *many, QUALITY, FORCES)
    assert said == [] and count.unjudged == {'stamp of its own': 1}


class Counted(list):
    """Contacts that count how often they are gone through."""

    looks = 0

    def __iter__(self):
        Counted.looks += 1
        return super().__iter__()


def moved(i):
    return changed(CONTACTS, contacts=Counted(
        changed(contact, position=contact.position + 1e-3 * i, R=np.roll(contact.R, 1, axis=1))
        for contact in CONTACTS.contacts))


@pytest.mark.parametrize('times, unlike', [(300, 300), (100, 1)])
def test_a_wrench_of_no_stamp_of_its_own_is_judged_in_bounded_work(times, unlike):
    """300 contacts and force sets of one stamp: 90,000 pairs; or the same again and again."""
    sets = [changed(FORCES, forces=[changed(LEFT_FORCE, wrench=LEFT_FORCE.wrench * (1.0 + i))])
            for i in range(unlike)]
    parts = [part for i in range(times) for part in (moved(i % unlike), sets[i % unlike])]
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    for part in parts:
        records.store(dataclasses.replace(part), 1.0)
    records.store(LOCAL, 1.0)
    records.store(NEXT, 1.2)
    records._waiting = type(records._waiting)(
        entry for entry in records._waiting if entry[2] is LOCAL)
    Counted.looks = 0
    said = records.judge(3.0 * GRACE_S)
    assert Counted.looks <= MOST_TRIED
    assert records.count.unjudged == ({'stamp of its own': 1} if unlike > 1 else {})
    assert bool(said) == (unlike == 1)


def test_what_is_forgotten_leaves_nothing_behind():
    records = ForceRecords()
    for i in range(100):
        for part in ALL:
            records.store(part, 0.5 * i)
        records.judge(0.5 * i)
    for part in (changed(CONTACTS, stamp=5), changed(QUALITY, stamp=5, alpha=1.0),
                 changed(FORCES, stamp=5)):
        records.store(part, 100.0)
    records.judge(100.0 + 2.0 * MEMORY_S)
    assert {stamp for _, stamp in records._stamped} == {5} and dict(records._alphas) == {1.0: 1}

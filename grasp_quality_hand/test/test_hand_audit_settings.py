# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The audit goes by the parameters that were in force, and by the contacts that these name."""

from audit_cases import (
    ALL, changed, CONTACTS, FORCES, judged, LOCAL, NEXT, QUALITY, SETTINGS)
from grasp_quality_hand.force_records import ForceRecords, GRACE_S
import pytest


def test_parameters_of_the_moment_count_whichever_came_first():
    said, _ = judged(changed(SETTINGS, max_normal_force=5.0), *ALL)
    assert said == []
    said, _ = judged(*ALL, changed(SETTINGS, max_normal_force=5.0))
    assert said == []


@pytest.mark.parametrize('late_s', [0.0, 20.0])
def test_what_is_read_late_is_judged_by_the_parameters_of_its_sending(late_s):
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    for asked_s in range(100):  # the node was asked time and again
        records.store(SETTINGS, float(asked_s))
    records.store(changed(SETTINGS, friction_coefficient=0.1), 100.0)
    said = []
    for second in range(30):
        if second == late_s:
            for part in (CONTACTS, QUALITY, FORCES):
                records.store(part, 100.1 + late_s, 99.9)
        said += records.judge(100.2 + second)
    assert said == [] and records.count.judged == 1


def test_parameters_of_long_before_excuse_nothing():
    records = ForceRecords()
    records.store(SETTINGS, 0.0)
    records.store(changed(SETTINGS, friction_coefficient=0.1), 10.0)
    for part in (CONTACTS, QUALITY, FORCES):
        records.store(part, 13.0)
    records.store(NEXT, 13.2)
    assert records.judge(15.0)


@pytest.mark.parametrize('later_s', [0.3, 0.9])
def test_parameters_of_afterwards_excuse_nothing(later_s):
    """A node tells of a change before it goes by it."""
    records = ForceRecords()
    records.store(changed(SETTINGS, friction_coefficient=0.3), 0.0)
    for part in (CONTACTS, QUALITY, FORCES):
        records.store(part, 10.0)
    records.store(NEXT, 10.2)
    records.store(SETTINGS, 10.0 + later_s)
    assert records.judge(10.0 + 1.1 * GRACE_S)


ARRAY = changed(CONTACTS, are_poses=False, contacts=[
    changed(contact, name=name) for contact, name in zip(CONTACTS.contacts, ('left', 'right'))])


@pytest.mark.parametrize('source, received, missing', [
    ('pose_array', CONTACTS, False), ('pose_array', ARRAY, True),
    ('contact_array', CONTACTS, True), ('contact_array', ARRAY, False),
    ('', CONTACTS, False), ('', ARRAY, False)])
def test_only_contacts_of_the_kind_that_the_node_listens_to_count(source, received, missing):
    said, count = judged(changed(SETTINGS, contact_source=source), received, QUALITY, FORCES,
                         LOCAL)
    assert said == [] and count.judged == (0 if missing else 1)
    assert count.unjudged == ({'contacts': 2} if missing else {})


def test_strong_contacts_that_the_node_does_not_listen_to_excuse_nothing():
    strong = changed(FORCES, forces=[changed(f, wrench=50.0 * f.wrench) for f in FORCES.forces])
    said, _ = judged(SETTINGS, changed(CONTACTS, are_poses=False, stamp=7), strong)
    assert any('of the bound' in text for text in said), said

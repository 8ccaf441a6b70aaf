# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Each rule of the audit finds the force set that breaks it, and no other."""

from audit_cases import changed, CONTACTS, LEFT_FORCE, RIGHT_FORCE, SETTINGS
from grasp_quality_hand.audit_parts import joints_of, limits_of, ReceivedJoint
from grasp_quality_hand.force_rules import broken_balance, broken_forces, broken_joints
import numpy as np
import pytest

GOOD = [LEFT_FORCE, RIGHT_FORCE]
LIMITS = limits_of(CONTACTS, SETTINGS)
LIFT = np.array([0.0, 0.0, 6.0, 0.0, 0.0, 0.0])


def one(**fields):
    return [changed(LEFT_FORCE, **fields), RIGHT_FORCE]


def test_true_forces_break_no_rule():
    assert broken_forces(GOOD, LIMITS, 'linf') == []
    assert broken_balance(GOOD, LIMITS, LIFT) == []


@pytest.mark.parametrize('forces, words', [
    (one(wrench=np.full(6, np.nan)), 'not finite'),
    (one(cone_usage=np.inf), 'not finite'),
    (one(name='thumb'), 'no such contact'),
    ([LEFT_FORCE, LEFT_FORCE], 'two forces'),
    (one(position=np.array([-0.02, 1e-6, 0.0])), 'from where the contact was received'),
    (one(normal=np.array([0.0, 0.0, 1.0])), 'its normal is not'),
    (one(wrench=np.array([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]), cone_usage=0.0), 'it pulls'),
    (one(wrench=np.array([6.0, 0.0, 3.0, 0.0, 0.01, 0.0])), 'not about the normal'),
    (one(wrench=np.array([6.0, 0.0, 3.0, 0.01, 0.0, 0.0])), 'its contact model cannot'),
    (one(wrench=np.array([6.0, 0.0, 3.0001, 0.0, 0.0, 0.0])), 'outside its friction cone'),
    (one(cone_usage=0.9), 'its cone usage is 1'),
    (one(wrench=np.array([10.1, 0.0, 0.0, 0.0, 0.0, 0.0]), cone_usage=0.0), 'of the bound linf'),
])
def test_each_broken_rule_is_named(forces, words):
    said = broken_forces(forces, LIMITS, 'linf')
    assert any(words in text for text in said), said


@pytest.mark.parametrize('bound, fingers, use', [
    ('l1', (), 1.2), ('l2', (), 0.6 * np.sqrt(2.0)), ('finger', ('one', 'one'), 1.2),
    ('finger', ('one', 'two'), 0.6)])
def test_the_use_of_every_bound(bound, fingers, use):
    """The forces press with 0.6 of each cap: caps a hair below and above decide."""
    for scale, fits in ((1.0 + 1e-4, True), (1.0 - 1e-4, False)):
        limits = limits_of(CONTACTS, changed(
            SETTINGS, contact_fingers=fingers, max_normal_force=10.0 * use * scale))
        assert (broken_forces(GOOD, limits, bound) == []) == fits


@pytest.mark.parametrize('axis', range(6))
def test_a_wrench_that_is_not_the_sum_is_found(axis):
    """Off by a millionth of the caps' sum (20 N), times the lever arm (2 cm) for a moment."""
    off = LIFT.copy()
    off[axis] += 4e-5 * (1.0 if axis < 3 else 0.02)
    assert len(broken_balance(GOOD, LIMITS, off)) == 1
    off[axis] = LIFT[axis] + 1e-7 * (1.0 if axis < 3 else 0.02)
    assert broken_balance(GOOD, LIMITS, off) == []


@pytest.mark.parametrize('gravity, limit, fits', [
    (0.0, 0.6001, True), (0.0, 0.5999, False), (0.1, 0.7001, True), (0.1, 0.6999, False),
    (-1.3, 0.7001, True), (-1.3, 0.6999, False)])
def test_a_motor_that_is_asked_for_too_much_is_found(gravity, limit, fits):
    """A joint 0.1 m from the left contact carries its 6 N: 0.6 N m."""
    columns = [np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]), np.zeros(6)]
    received = changed(CONTACTS, joints=[ReceivedJoint('knuckle', limit, gravity, columns)])
    said = broken_joints(GOOD, joints_of(received, list(LIMITS)))
    assert (said == []) == fits and all('joint knuckle needs' in text for text in said)


def test_a_joint_without_a_column_for_a_contact_that_presses_is_found():
    received = changed(CONTACTS, joints=[ReceivedJoint('knuckle', 9.0, 0.0, [np.zeros(6)])])
    assert len(broken_joints(GOOD, joints_of(received, list(LIMITS)))) == 1

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A moved grasp is the grasp that would be made at the new places, down to the last digit."""

from functools import cached_property

from grasp_quality import Contact, ContactModel, evaluate, Grasp, InvalidContactError, TaskWrench
from grasp_quality import InvalidGraspError, JointLimits
from grasp_quality.moving import moved
from hypothesis import given, settings, strategies
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

CACHED = [name for name, value in vars(Grasp).items() if isinstance(value, cached_property)]
MODELS = list(ContactModel)


def places(seed, count):
    rng = np.random.default_rng(seed)
    return 0.05 * rng.standard_normal((count, 3)), Rotation.random(
        count, random_state=seed).as_matrix()


def grasp_at(seed, count, bound):
    positions, rotations = places(seed, count)
    return Grasp([Contact(
        p, rotation=R, model=MODELS[i % 3], friction=0.2 + 0.1 * i, max_normal_force=1.0 + i,
        name=f'tip_{i}', finger=f'finger_{i % 2}')
        for i, (p, R) in enumerate(zip(positions, rotations))], bound)


def assert_same(mine, other, name):
    if isinstance(other, tuple):
        assert len(mine) == len(other)
        for a, b in zip(mine, other):
            assert_same(a, b, name)
    else:
        np.testing.assert_array_equal(mine, other, err_msg=name, strict=True)


@settings(max_examples=40)
@given(strategies.integers(0, 2**31), strategies.integers(1, 9),
       strategies.sampled_from(['linf', 'l1', 'l2', 'finger']), strategies.booleans())
def test_nothing_of_the_old_places_is_left(seed, count, bound, is_used):
    old, new = grasp_at(seed, count, bound), grasp_at(seed + 1, count, bound)
    if is_used:
        for name in CACHED:
            getattr(old, name)
    there = moved(old, old.contacts.moved(*places(seed + 1, count)))
    assert there.names == new.names
    assert there.groups == new.groups
    for name in CACHED:
        assert_same(getattr(there, name), getattr(new, name), name)
    task = TaskWrench([0.0, 0.1, 1.0, 0.0, 0.0, 0.01])
    assert evaluate(there, task).alpha == evaluate(new, task).alpha


def test_the_old_grasp_stays_where_it_is():
    old = grasp_at(1, 3, 'linf')
    positions, matrix = old.positions.copy(), old.matrix.copy()
    moved(old, old.contacts.moved(*places(2, 3)))
    np.testing.assert_array_equal(old.positions, positions)
    np.testing.assert_array_equal(old.matrix, matrix)


@pytest.mark.parametrize('spoil, rule', [
    (lambda p, R: (p * np.nan, R), 'positions must be finite'),
    (lambda p, R: (p[:2], R), 'positions must have shape'),
    (lambda p, R: (p + 1e5, R), 'position must lie within'),
    (lambda p, R: (p, -R), 'rotation must be a right-handed'),
    (lambda p, R: (p, 1.1 * R), 'rotation must be a right-handed')])
def test_bad_places_are_refused(spoil, rule):
    with pytest.raises(InvalidContactError, match=rule):
        grasp_at(1, 3, 'linf').contacts.moved(*spoil(*places(2, 3)))


def test_joint_limits_do_not_move():
    contacts = grasp_at(1, 3, 'linf').contacts
    limits = JointLimits(('joint',), [1.0], np.ones((1, 3, 4)))
    with pytest.raises(InvalidGraspError, match='joint_limits cannot be moved: make a Grasp'):
        moved(Grasp(contacts, joint_limits=limits), contacts)

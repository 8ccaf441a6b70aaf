# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Many grasps as arrays: the same facts and the same rules as Grasp objects."""

import dataclasses

from benchmarks.random_grasps import random_grasp
from grasp_quality import (
    Contact, ContactModel, Grasp, GraspSet, InvalidContactError, InvalidGraspError)
from grasp_quality.frames import frames_of_normals
from known_grasps import antipodal, three_finger
import numpy as np
import pytest
from tolerances import EXACT


def same(one, other):
    """Whether two grasps state the same problem."""
    return one.groups == other.groups and (one.bound == 'l2') == (other.bound == 'l2') \
        and one.scaled_matrix == pytest.approx(other.scaled_matrix, abs=EXACT) \
        and one.force_units == pytest.approx(other.force_units, abs=EXACT)


def test_any_grasps_come_back():
    grasps = [random_grasp(np.random.default_rng(seed)) for seed in range(20)]
    many = GraspSet.of(grasps)
    assert len(many) == 20
    for one, other in zip(grasps, many):
        assert same(one, other)


@pytest.mark.parametrize('bound', ['linf', 'l1', 'l2', 'finger'])
def test_arrays_make_the_grasps_that_contacts_make(bound):
    rng = np.random.default_rng(1)
    positions, normals = rng.normal(size=(2, 4, 3, 3))
    friction, caps = rng.uniform(0.1, 1.0, (2, 4, 3))
    models, fingers = list(ContactModel), ['a', 'b', 'a']
    many = GraspSet.of_arrays(
        positions, normals, model=models, friction=friction, torsional_friction=0.1,
        max_normal_force=caps, bound=bound, fingers=fingers)
    for i, grasp in enumerate(many):
        assert same(grasp, Grasp([
            Contact(positions[i, j], normals[i, j], models[j], friction[i, j], 0.1, caps[i, j],
                    finger=fingers[j]) for j in range(3)], bound))


@pytest.mark.parametrize('model', ['FPC', 'SFCE', ['FPC', 'SFCE', 'PCWF', 'FPC']])
def test_models_may_be_given_by_their_names(model):
    """Four contacts: a name has as many letters, and must not be read letter by letter."""
    rng = np.random.default_rng(3)
    positions, normals = rng.normal(size=(2, 2, 4, 3))
    kinds = ContactModel(model) if isinstance(model, str) else [ContactModel(m) for m in model]
    named, plain = (GraspSet.of_arrays(positions, normals, model=m, torsional_friction=0.1)
                    for m in (model, kinds))
    assert all(same(one, other) for one, other in zip(named, plain))


def test_variations_keep_what_is_left_out():
    grasp = random_grasp(np.random.default_rng(2), count=5, bound='finger')
    assert all(same(grasp, other) for other in GraspSet.varied(grasp, count=3))
    friction = np.random.default_rng(0).uniform(0.1, 1.0, (2, 5))
    varied = GraspSet.varied(grasp, friction=friction)
    acts = grasp.contacts.effective_friction > 0.0
    assert varied.friction == pytest.approx((friction * acts).ravel())
    assert varied[1].positions == pytest.approx(grasp.positions)
    normals = np.tile(grasp.rotations[:, :, 2], (2, 1, 1))
    assert GraspSet.varied(grasp, normals=normals)[1].rotations == pytest.approx(
        frames_of_normals(normals[1]), abs=EXACT)


@pytest.mark.parametrize('make, error, words', [
    (lambda: GraspSet.of([]), InvalidGraspError, 'at least one'),
    (lambda: GraspSet.of([antipodal(), 'grasp']), InvalidGraspError, 'must be a Grasp'),
    (lambda: GraspSet.of_arrays(np.zeros((2, 3))), InvalidContactError, 'positions must have'),
    (lambda: GraspSet.of_arrays(np.zeros((1, 2, 3))), InvalidContactError, 'exactly one'),
    (lambda: GraspSet.of_arrays(np.zeros((1, 2, 3)), np.zeros((1, 2, 3))), InvalidContactError,
     'normals must not be zero, but row 0'),
    (lambda: GraspSet.of_arrays(np.zeros((1, 2, 3)), np.ones((1, 2, 3)), model=[]),
     InvalidGraspError, '0 models'),
    (lambda: GraspSet.of_arrays(np.zeros((1, 2, 3)), np.ones((1, 2, 3)), friction=[1, 2, 3]),
     InvalidContactError, r'friction must broadcast to \(1, 2\)'),
    (lambda: GraspSet.varied(three_finger(), friction=[[0.1, 0.2, 0.3], [0.1, -0.2, 0.3]]),
     InvalidContactError, 'grasp 1, contact 1: friction and .* at least 0'),
    (lambda: GraspSet.varied(three_finger(), max_normal_force=[[1e-9, 1.0, 1.0]]),
     InvalidGraspError, 'grasp 0: max_normal_force'),
])
def test_bad_input_is_named(make, error, words):
    with pytest.raises(error, match=words):
        make()


@pytest.mark.parametrize('fields, words', [
    ({'starts': [0, 0, 5]}, 'at least one contact'),
    ({'starts': [1, 2, 5]}, 'at least one contact'),
    ({'groups': [0, 1]}, 'one entry for each of 5 contacts'),
    ({'is_l2': [False]}, 'one for each of 2 grasps')])
def test_arrays_that_do_not_fit_each_other_are_refused(fields, words):
    with pytest.raises(InvalidGraspError, match=words):
        dataclasses.replace(GraspSet.of([antipodal(), three_finger()]), **fields)

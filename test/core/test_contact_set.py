# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts as a structure of arrays: the same facts and the same rules as single contacts."""

import dataclasses

from benchmarks.random_grasps import random_grasp
from grasp_quality import Contact, ContactModel, Grasp, InvalidContactError
from grasp_quality.contact_set import ContactSet
import numpy as np
import pytest


@pytest.fixture
def contacts():
    """Five contacts of all models."""
    return random_grasp(np.random.default_rng(3), count=5).contacts


def test_round_trip_through_single_contacts(contacts):
    again = ContactSet.of(list(contacts))
    for field in dataclasses.fields(ContactSet):
        assert np.array_equal(getattr(again, field.name), getattr(contacts, field.name))


def test_effective_coefficients_are_those_of_the_contacts(contacts):
    assert contacts.effective_friction.tolist() == [c.effective_friction for c in contacts]
    assert contacts.effective_torsional_friction.tolist() == [
        c.effective_torsional_friction for c in contacts]


def test_it_is_a_sequence(contacts):
    assert len(contacts) == 5 and len(list(contacts)) == 5
    assert isinstance(contacts[-1], Contact) and isinstance(contacts[1:3], ContactSet)
    assert contacts[1:3].fingers == contacts.fingers[1:3]
    assert contacts.subset([4, 0]).friction.tolist() == [
        contacts[4].friction, contacts[0].friction]
    with pytest.raises(IndexError):
        contacts[5]


def test_a_grasp_takes_either(contacts):
    assert (Grasp(contacts).matrix == Grasp(list(contacts)).matrix).all()


@pytest.mark.parametrize('field, value, message', [
    ('friction', -1.0, 'friction must be at least 0'),
    ('torsional_friction', -1.0, 'torsional_friction must be at least 0'),
    ('max_normal_forces', 0.0, 'max_normal_force must be greater than 0'),
    ('rotations', 2.0 * np.eye(3), 'rotation must be a right-handed'),
    ('rotations', np.diag([1.0, 1.0, -1.0]), 'rotation must be a right-handed'),
])
def test_error_names_contact_and_rule(contacts, field, value, message):
    values = getattr(contacts, field).copy()
    values[2] = value
    with pytest.raises(InvalidContactError, match=f'contact 2 .*{message}'):
        dataclasses.replace(contacts, **{field: values})


@pytest.mark.parametrize('field, value, message', [
    ('friction', [0.5] * 4, r'friction must have shape \(5\)'),
    ('positions', np.full((5, 3), np.nan), 'positions must be finite'),
    ('fingers', ['a'] * 4, 'fingers must have one entry for each of 5 contacts'),
    ('models', ['PCWF'] * 4 + ['RUBBER'], r"contact 4 .*model must be one of .* got 'RUBBER'"),
    ('models', [ContactModel.FPC] * 6, 'models must have one entry'),
])
def test_error_names_field_and_rule(contacts, field, value, message):
    with pytest.raises(InvalidContactError, match=message):
        dataclasses.replace(contacts, **{field: value})


def test_models_may_be_given_by_their_names(contacts):
    named = dataclasses.replace(contacts, models=[model.value for model in contacts.models])
    assert named.models == contacts.models

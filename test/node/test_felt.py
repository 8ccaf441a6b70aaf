# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What is doubtful about contacts and their forces is said with value, rule and way out."""

from grasp_quality.contact import ContactModel
from grasp_quality.contact_set import ContactSet
from grasp_quality.node_felt import doubts, Felt
from grasp_quality.node_settings import Settings
import numpy as np
import pytest

NAMES = ('left', 'right')


def felt(*normals, names=NAMES, caps=10.0, refused=(), side=0.01, mu=0.5):
    """Contacts with these measured normal forces; None where no fresh one came."""
    count = len(normals)
    contacts = ContactSet(
        side * np.arange(3.0 * count).reshape(count, 3), np.tile(np.eye(3), (count, 1, 1)),
        models=[ContactModel.PCWF] * count, friction=[mu] * count,
        torsional_friction=[0.0] * count, max_normal_forces=[caps] * count,
        names=names[:count], fingers=names[:count])
    forces = [None if n is None else np.array([0.0, 0.0, n, 0.0]) for n in normals]
    return Felt(contacts, forces, dict.fromkeys(refused, 'a reason'))


def said(felt, least=0.0, heard=NAMES, names=NAMES):
    return doubts(felt, Settings(contact_names=names, min_contact_force=least), heard)


@pytest.mark.parametrize('normals', [(5.0, 5.0), (None, None), (0.0, 5.0), (-0.05, 5.0)])
def test_what_is_usual_is_not_doubted(normals):
    """Loaded, without sensors, a finger in the air, and its sensor's noise."""
    assert said(felt(*normals)) == ()


def test_contacts_that_do_not_count_are_named_with_their_force():
    assert said(felt(5.0, 0.1), least=0.5) == (
        '1 of 2 contacts loaded: right is not (0.1 N of min_contact_force 0.5 N)',)
    first, _ = said(felt(5.0, None), least=0.5)
    assert first == '1 of 2 contacts loaded: right is not (no fresh measured wrench)'
    assert said(felt(5.0, None, refused=['right']), least=0.5) == (
        '1 of 2 contacts loaded: right is not (its wrench cannot be used)',)
    assert said(felt(0.1, 0.1), least=0.5)[0].startswith('0 of 2 contacts loaded: left is not')
    assert said(felt(0.5, 0.6), least=0.5) == ()


@pytest.mark.parametrize('caps, least, normal, doubted', [
    (10.0, 0.0, -0.21, True), (10.0, 0.0, -0.19, False), (1.0, 0.0, -0.021, True),
    (10.0, 0.5, -0.49, False), (10.0, 0.5, -0.5, True), (10.0, 0.1, -0.11, True)])
def test_a_finger_that_pulls_by_more_than_noise_was_measured_the_other_way(
        caps, least, normal, doubted):
    texts = [text for text in said(felt(5.0, normal, caps=caps), least) if 'below zero' in text]
    assert len(texts) == doubted
    for text in texts:
        assert f'right {normal:.3g} N' in text and 'left' not in text
        assert 'finger on the object' in text and 'negate' in text


def test_a_contact_without_a_wrench_is_named_once_another_has_one():
    """Never heard, too old, and without a topic of its own."""
    topic = '~/contact_wrenches/left'
    assert said(felt(None, 5.0), heard=['right']) == (
        f'no fresh measured wrench of left (none ever came on {topic})',)
    assert said(felt(None, 5.0)) == (
        f'no fresh measured wrench of left (the last on {topic} is older than max_contact_age '
        '0.1 s)',)
    text, = said(felt(None, 5.0), heard=['right'], names=('right',))
    assert 'contact_names' in text and f'{topic} is not listened to' in text
    assert len(said(felt(None, None, refused=['right']), heard=['right'])) == 1


def test_a_wrench_that_cannot_be_used_is_not_missing():
    assert said(felt(None, 5.0, refused=['left'])) == ()


def test_a_sentence_names_some_of_many():
    names = tuple(f'tip_{i}' for i in range(50))
    text, = said(felt(*[-5.0] * 50, names=names), heard=names, names=names)
    assert 'tip_7 -5 N and 42 more' in text and 'tip_8' not in text


@pytest.mark.parametrize('side, doubted', [(10.0, True), (1.01, True), (0.99, False)])
def test_contacts_further_apart_than_hands_reach_may_be_in_millimetres(side, doubted):
    texts = said(felt(5.0, 5.0, side=side))
    assert len(texts) == doubted
    for text in texts:
        assert f'{3.0 * side:.3g} m apart' in text and 'in metres' in text


@pytest.mark.parametrize('mu, doubted', [(30.0, True), (5.01, True), (5.0, False), (0.0, False)])
def test_a_friction_coefficient_that_no_material_has_may_be_an_angle(mu, doubted):
    texts = said(felt(5.0, None, mu=mu), heard=['left', 'right'], names=NAMES)[1:]
    assert len(texts) == doubted
    for text in texts:
        assert f'left {mu:.3g}, right {mu:.3g}' in text and 'no angle' in text

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts: both messages to core contacts in the object frame; what they leave open."""

from adapter_messages import any_float, BAD_NUMBERS, EXACT, pose, shuffled_axes
from geometry_msgs.msg import PoseArray, Quaternion
from grasp_quality import ContactModel
from grasp_quality.node_parameters import Settings
from grasp_quality_msgs.msg import Contact as ContactMsg, ContactArray
from hypothesis import given, strategies
from msg_adapters.contacts import ContactDefaults, contacts_from_array, contacts_from_poses
from msg_adapters.errors import InvalidMessageError
from msg_adapters.frames import Transform
import numpy as np
import pytest

DEFAULTS = ContactDefaults(ContactModel.SFCE, 0.7, 0.002, 25.0)
NUMBERS = ('friction_coefficient', 'torsional_friction_coefficient', 'max_normal_force')


def poses(count=2):
    return PoseArray(poses=[pose((float(i), 0.0, 0.0)) for i in range(count)])


def array(**fields):
    return ContactArray(contacts=[ContactMsg(pose=pose(), **fields)])


def test_plus_z_of_the_pose_is_the_inward_normal():
    contact, _ = contacts_from_poses(poses(), DEFAULTS)
    np.testing.assert_allclose(contact.normal, [1, 0, 0], atol=EXACT)
    contact, = contacts_from_array(array(), DEFAULTS)
    np.testing.assert_allclose(contact.normal, [1, 0, 0], atol=EXACT)


def test_a_pose_array_takes_the_rest_from_the_defaults():
    first, second = contacts_from_poses(poses(), DEFAULTS)
    for contact in (first, second):
        assert contact.model is ContactModel.SFCE
        assert contact.friction == 0.7
        assert contact.torsional_friction == 0.002
        assert contact.max_normal_force == 25.0
    assert (first.name, second.name) == ('contact_0', 'contact_1')
    assert (first.finger, second.finger) == ('contact_0', 'contact_1')
    assert second.position.tolist() == [1, 0, 0]


@pytest.mark.parametrize('place', [None, Transform(np.eye(3)[[1, 2, 0]], np.array([1.0, 2, 3]))])
def test_contacts_like_those_before_are_those_read_anew(place):
    before, now = poses(), PoseArray(poses=[
        pose((0.1 * i, 0.2, 0.3), Quaternion(x=0.6, w=0.8)) for i in range(2)])
    like = contacts_from_poses(before, DEFAULTS)
    for mine, other in zip(contacts_from_poses(now, DEFAULTS, place, like),
                           contacts_from_poses(now, DEFAULTS, place), strict=True):
        assert mine.name == other.name
        assert mine.max_normal_force == other.max_normal_force
        np.testing.assert_array_equal(mine.position, other.position)
        np.testing.assert_array_equal(mine.rotation, other.rotation)
    now.poses[1].position.y = float('nan')
    with pytest.raises(InvalidMessageError, match=r'^poses\[1\].position must be'):
        contacts_from_poses(now, DEFAULTS, place, like)
    now.poses[1].position.y = 2e4
    with pytest.raises(InvalidMessageError, match='contact 1 .* must lie within'):
        contacts_from_poses(now, DEFAULTS, place, like)


def test_contacts_like_others_of_another_number_are_read_anew():
    contacts = contacts_from_poses(poses(3), DEFAULTS, like=contacts_from_poses(poses(), DEFAULTS))
    assert contacts.names == ('contact_0', 'contact_1', 'contact_2')


def test_defaults_are_those_of_the_parameters_of_the_node():
    assert ContactDefaults() == Settings().contact_defaults


def test_poses_are_named_in_order_and_grouped_by_finger():
    defaults = ContactDefaults(names=('tip', 'pad'), fingers=('thumb', 'thumb'))
    first, second = contacts_from_poses(poses(), defaults)
    assert (first.name, second.name) == ('tip', 'pad')
    assert (first.finger, second.finger) == ('thumb', 'thumb')


def test_named_poses_without_fingers_are_each_their_own():
    contacts = contacts_from_poses(poses(), ContactDefaults(names=('a', 'b')))
    assert [c.finger for c in contacts] == ['a', 'b']


@pytest.mark.parametrize('count', [1, 3])
def test_a_wrong_number_of_poses_is_refused_with_the_way_out(count):
    with pytest.raises(InvalidMessageError, match=(
            rf"^poses must .*2 contact_names \['a', 'b'\], got {count}: .*leave contact_names "
            'empty, or use contact_source contact_array$')):
        contacts_from_poses(poses(count), ContactDefaults(names=('a', 'b')))


@pytest.mark.parametrize('defaults', [DEFAULTS, ContactDefaults(names=('a', 'b'))])
def test_no_contact_is_a_message_too(defaults):
    assert len(contacts_from_poses(PoseArray(), defaults)) == 0
    assert len(contacts_from_array(ContactArray(), defaults)) == 0


def test_zero_in_a_field_takes_the_default():
    contact, = contacts_from_array(array(), DEFAULTS)
    assert contact.model is ContactModel.SFCE
    assert (contact.friction, contact.torsional_friction) == (0.7, 0.002)
    assert contact.max_normal_force == 25.0
    assert (contact.name, contact.finger) == ('contact_0', 'contact_0')


@pytest.mark.parametrize('code, model', [
    (ContactMsg.MODEL_FPC, ContactModel.FPC), (ContactMsg.MODEL_PCWF, ContactModel.PCWF),
    (ContactMsg.MODEL_SFCE, ContactModel.SFCE)])
def test_fields_that_are_filled_in_count(code, model):
    contact, = contacts_from_array(array(
        name='tip', finger='thumb', model=code, friction_coefficient=0.25,
        torsional_friction_coefficient=0.01, max_normal_force=3.0), DEFAULTS)
    assert (contact.name, contact.finger, contact.model) == ('tip', 'thumb', model)
    assert (contact.friction, contact.torsional_friction) == (0.25, 0.01)
    assert contact.max_normal_force == 3.0


@pytest.mark.parametrize('read, message', [
    (contacts_from_poses, poses(1)),
    (contacts_from_array, ContactArray(contacts=[ContactMsg(pose=pose((0.0, 0.0, 0.0)))]))])
def test_another_frame_is_brought_into_the_object_frame(read, message):
    """+x of the source frame is +y of the object frame, its origin is at (1, 2, 3)."""
    contact, = read(message, DEFAULTS, shuffled_axes())
    np.testing.assert_allclose(contact.position, [1, 2, 3], atol=EXACT)
    np.testing.assert_allclose(contact.normal, [0, 1, 0], atol=EXACT)


def test_an_unknown_model_is_refused_with_the_choices():
    with pytest.raises(InvalidMessageError, match=(
            r'^contacts\[0\]\.model must be one of 0.*got 9$')):
        contacts_from_array(array(model=9), DEFAULTS)


@pytest.mark.parametrize('names', [('a', 'b', 'a'), ('contact_1', '')])
def test_a_name_given_twice_is_refused(names):
    message = ContactArray(contacts=[ContactMsg(name=name, pose=pose()) for name in names])
    last = len(names) - 1
    with pytest.raises(InvalidMessageError, match=(
            rf"^contacts\[{last}\]\.name must be unique, got '{names[0]}' twice")):
        contacts_from_array(message, DEFAULTS)


@pytest.mark.parametrize('field', NUMBERS)
@pytest.mark.parametrize('value', [*BAD_NUMBERS, -0.5, -1e-300, 1e-300])
def test_a_bad_coefficient_is_refused_by_field(field, value):
    with pytest.raises(InvalidMessageError, match=rf'contacts\[0\]\.{field} must be'):
        contacts_from_array(array(**{field: value}), DEFAULTS)


@pytest.mark.parametrize('field', NUMBERS)
def test_the_smallest_coefficient_is_the_one_that_the_error_names(field):
    contact, = contacts_from_array(array(**{field: 1e-12}), DEFAULTS)
    assert getattr(contact, field.replace('_coefficient', '')) == 1e-12
    with pytest.raises(InvalidMessageError, match=(
            rf'^contacts\[0\]\.{field} must be at least 1e-12, or 0 for the default, got 9e-13')):
        contacts_from_array(array(**{field: 9e-13}), DEFAULTS)


@pytest.mark.parametrize('defaults, words', [
    (ContactDefaults(friction=-0.5), 'friction.*-0.5'),
    (ContactDefaults(max_normal_force=0.0), 'max_normal_force.*0')])
def test_what_the_core_refuses_is_refused_in_its_words(defaults, words):
    with pytest.raises(InvalidMessageError, match=words):
        contacts_from_poses(poses(), defaults)


def test_a_bad_pose_is_refused_by_index():
    message = poses(3)
    message.poses[2].orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)
    with pytest.raises(InvalidMessageError, match=r'poses\[2\]\.orientation'):
        contacts_from_poses(message, DEFAULTS)
    item = ContactMsg(pose=message.poses[2])
    with pytest.raises(InvalidMessageError, match=r'contacts\[0\]\.pose\.orientation'):
        contacts_from_array(ContactArray(contacts=[item]), DEFAULTS)


@given(strategies.tuples(*[any_float] * 10), strategies.integers(0, 255), strategies.booleans())
def test_any_contact_is_finite_or_a_clear_error(numbers, model, moved):
    px, py, pz, x, y, z, w, mu, gamma, cap = numbers
    item = ContactMsg(
        pose=pose((px, py, pz), Quaternion(x=x, y=y, z=z, w=w)), model=model,
        friction_coefficient=mu, torsional_friction_coefficient=gamma, max_normal_force=cap)
    try:
        contact, = contacts_from_array(
            ContactArray(contacts=[item]), DEFAULTS, shuffled_axes() if moved else None)
    except InvalidMessageError:
        return
    assert np.isfinite(contact.position).all() and np.isfinite(contact.rotation).all()
    assert np.isfinite([contact.friction, contact.torsional_friction]).all()
    assert 0.0 < contact.max_normal_force < np.inf

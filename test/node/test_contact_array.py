# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Live contacts in the rich form: names, fingers, models, and a number that changes."""

from grasp_quality_msgs.msg import Contact, ContactArray, ResultCode
from grasps import ANTIPODAL, CIRCLE, contact_array, EIGHT, numbers, SINGLE, SOLVER
from harness import BEST_EFFORT
from outputs import Outputs
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters


@pytest.fixture(scope='module')
def client(start):
    return start(contact_source='contact_array', max_contact_age='2.0',
                 task_wrench='[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]').client


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of contacts."""
    publisher = client.publisher(ContactArray, 'contacts', BEST_EFFORT)
    return lambda poses, **fields: lambda: publisher.publish(
        contact_array(poses, client.now(), **fields))


@pytest.fixture(scope='module')
def outputs(client):
    return Outputs(client)


def count(number):
    return lambda quality: quality.alpha == pytest.approx(10.0 * number, rel=SOLVER)


def test_contacts_keep_their_names(client, outputs, feed):
    stream = feed(ANTIPODAL, name=['thumb', 'index'])
    found = outputs.answer(stream)
    assert [item.name for item in found.forces.forces] == ['thumb', 'index']
    named = Outputs(client, ['thumb', 'index'], stream).answer(stream)
    assert named.wrenches['thumb'].wrench.force.z == pytest.approx(10.0, rel=SOLVER)


def test_the_number_of_contacts_may_change_with_every_message(outputs, feed):
    """Faces of four, three contacts, none, one: along +x 40 N, 10 N, no answer, 10 N."""
    for poses, reached in ((EIGHT, 4), (CIRCLE, 1)):
        found = outputs.answer(feed(poses), count(reached))
        assert len(found.forces.forces) == len(poses)
    quality = outputs.failure(ResultCode.NO_CONTACTS, feed([]))
    assert 'holds no contacts' in quality.result.message
    found = outputs.answer(feed(SINGLE), count(1))
    assert len(found.forces.forces) == 1


def test_a_contact_that_is_gone_gets_a_zero_wrench(client, outputs, feed):
    gone = Outputs(client, ['contact_1'], feed(ANTIPODAL))
    assert gone.answer(feed(ANTIPODAL, friction_coefficient=[0.1, 0.2])).wrenches
    outputs.answer(feed(SINGLE))
    client.until(lambda: not numbers(gone.wrenches['contact_1'][-1].wrench).any(),
                 'a zero wrench', feed(SINGLE))


def test_a_name_that_makes_no_topic_is_on_contact_forces_alone(client, outputs, feed):
    found = outputs.answer(feed(ANTIPODAL, name=['left tip', 'über']))
    assert [item.name for item in found.forces.forces] == ['left tip', 'über']
    topics = dict(client.node.get_topic_names_and_types())
    wrenches = [topic for topic, kinds in topics.items() if 'optimal_wrenches' in topic]
    assert wrenches and not any('tip' in topic for topic in wrenches)


def test_a_finger_with_many_contacts_is_one_finger(client, outputs, feed):
    """Four contacts a face push 40 N each for itself, and 10 N when they are one finger."""
    def bound(value):
        answer = client.call(SetParameters, 'set_parameters', parameters=[Parameter(
            name='force_bound', value=ParameterValue(
                type=ParameterType.PARAMETER_STRING, string_value=value))])
        assert answer.results[0].successful

    stream = feed(EIGHT, finger=['left'] * 4 + ['right'] * 4)
    outputs.answer(stream, count(4))
    bound('finger')
    outputs.answer(stream, count(1))
    bound('linf')
    outputs.answer(stream, count(4))


@pytest.mark.parametrize('fields, words', [
    ({'name': ['a', 'a']}, 'contacts[1].name must be unique'),
    ({'model': [Contact.MODEL_PCWF, 8]}, 'contacts[1].model must be'),
    ({'friction_coefficient': [-1.0, 0.5]}, 'contacts[0].friction_coefficient must be'),
    ({'frame': ''}, 'header.frame_id of the contacts must not be empty')])
def test_bad_contacts_are_answered_and_the_next_good_ones_recover(outputs, feed, fields, words):
    quality = outputs.failure(ResultCode.INVALID_REQUEST, feed(ANTIPODAL, **fields))
    assert words in quality.result.message
    outputs.answer(feed(ANTIPODAL), count(1))


def test_the_plain_topic_is_not_listened_to(client):
    topics = [topic for topic, _ in client.node.get_subscriber_names_and_types_by_node(
        'grasp_quality', client.node.get_namespace())]
    assert f'{client.target}/contacts' in topics
    assert f'{client.target}/contact_poses' not in topics

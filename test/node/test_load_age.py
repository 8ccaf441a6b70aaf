# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Loads that stop: with ``max_load_age`` they are told like contacts that stop, and pass."""

import re
import time

from felt_contacts import felt_contacts
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ContactForceArray, GraspMargin, ResultCode
from grasps import ANTIPODAL, pose_array, SOLVER, total_wrench, wrench
from harness import BEST_EFFORT
from msg_adapters.stamps import stamp_ns
from outputs import Outputs
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

pytestmark = pytest.mark.alone  # silence is told within a time
MAX_AGE_S = 0.5
UP = wrench(fy=1.0)
TASK = '[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]'
STALE = ResultCode.STALE_CONTACTS


class Hand:
    """A node with its outputs, and what feeds it."""

    def __init__(self, start, **parameters):
        self.client = start(contact_names='[left, right]', task_wrench=TASK, **parameters).client
        self.outputs = Outputs(self.client)
        self.holding = self.client.listen(ContactForceArray, 'holding_forces')
        self._contacts = self.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
        self._loads = self.client.publisher(WrenchStamped, 'external_wrench')

    def contacts(self):
        """Publish fresh contacts."""
        self._contacts.publish(pose_array(ANTIPODAL, self.client.now()))

    def load(self, newtons=-3.0, ahead_s=0, stamped=True):
        """Publish a load along z."""
        message = WrenchStamped(wrench=wrench(fz=newtons))
        if stamped:
            message.header.stamp = self.client.now()
            message.header.stamp.sec += ahead_s
        self._loads.publish(message)

    def both(self):
        """Publish fresh contacts and a fresh load."""
        self.load()
        self.contacts()

    def change(self, **changes):
        """Set parameters."""
        results = self.client.call(SetParameters, 'set_parameters', parameters=[
            Parameter(name, value=value).to_parameter_msg() for name, value in changes.items()])
        assert all(result.successful for result in results.results)

    def set_task(self, **load):
        """Set the task anew, with a load or without."""
        answer = self.client.call(srv.SetTask, 'set_task', kind=1, task_wrench=UP,
                                  external_wrench=wrench(**load))
        assert answer.result.code == ResultCode.OPTIMAL

    def held(self, newtons, feed):
        """Wait for forces that hold so much, from now on."""
        begin = stamp_ns(self.client.now())
        return self.client.fresh(self.holding, lambda m: (
            stamp_ns(m.header.stamp) >= begin and m.forces
            and abs(total_wrench(m)[2] - newtons) <= SOLVER), f'{newtons} N held', feed)

    def feed_for(self, seconds):
        """Publish contacts for a while; return all qualities meanwhile."""
        self.outputs.forget()
        end = time.monotonic() + seconds
        self.client.until(lambda: time.monotonic() > end, 'time', self.contacts)
        return self.outputs.quality


@pytest.fixture(scope='module')
def hand(start):
    return Hand(start, max_contact_age=2.0, max_load_age=MAX_AGE_S)


@pytest.fixture
def streaming(hand):
    """Return the hand while a load streams."""
    hand.held(3.0, hand.both)
    return hand


def test_before_the_first_load_there_is_none(start):
    hand = Hand(start, max_contact_age=2.0, max_load_age=MAX_AGE_S)
    quality = hand.outputs.failure(STALE, hand.contacts)
    for words in ('no load received yet on ~/external_wrench', 'max_load_age is 0.5 s',
                  'publish loads steadily', '~/set_task'):
        assert words in quality.result.message
    hand.set_task()  # says nothing of a load
    hand.outputs.failure(STALE, hand.contacts)
    hand.held(3.0, hand.both)


def test_silence_of_loads_is_told_while_contacts_go_on_and_passes(streaming):
    hand = streaming
    for _ in range(3):
        hand.held(3.0, hand.both)
        silent = time.monotonic()
        quality = hand.outputs.failure(STALE, hand.contacts)
        assert time.monotonic() - silent < 2 * MAX_AGE_S
        age_s = float(re.search(
            r'^the load of ~/external_wrench is (\d+\.\d+) s old, max_load_age is 0.5 s: publish '
            'loads steadily', quality.result.message).group(1))
        assert MAX_AGE_S <= age_s < 2 * MAX_AGE_S
        hand.client.until(lambda: not hand.holding[-1].forces, 'no holding forces', hand.contacts)


def test_nothing_is_answered_with_a_load_that_is_too_old(streaming):
    streaming.load()
    newest_ns = stamp_ns(streaming.client.now())
    for quality in streaming.feed_for(3 * MAX_AGE_S):
        if quality.result.code == ResultCode.OPTIMAL:
            assert stamp_ns(quality.header.stamp) - newest_ns < 1e9 * MAX_AGE_S
    assert streaming.outputs.quality[-1].result.code == STALE


def test_silence_is_told_between_contacts_too(start):
    """Contacts live long and come once: only the watchdog can tell."""
    hand = Hand(start, max_contact_age=60.0, max_load_age=MAX_AGE_S)
    hand.held(3.0, hand.both)
    silent = time.monotonic()
    quality = hand.outputs.failure(STALE)
    assert time.monotonic() - silent < 2 * MAX_AGE_S
    assert 'max_load_age is 0.5 s' in quality.result.message
    hand.outputs.answer(hand.both)


def test_an_age_that_is_set_is_watched_at_once(start):
    hand = Hand(start, max_contact_age=60.0)
    hand.held(3.0, hand.both)
    hand.change(max_load_age=MAX_AGE_S)
    hand.held(3.0, hand.both)
    silent = time.monotonic()
    hand.outputs.failure(STALE)
    assert time.monotonic() - silent < 2 * MAX_AGE_S
    hand.change(max_load_age=0.0)
    hand.held(3.0, hand.contacts)


def test_a_load_of_a_request_does_not_age_until_one_streams(streaming):
    hand = streaming
    hand.set_task(fz=-2.0)
    hand.held(2.0, hand.contacts)
    qualities = hand.feed_for(3 * MAX_AGE_S)
    assert {m.result.code for m in qualities} == {ResultCode.OPTIMAL}
    hand.held(2.0, hand.contacts)
    hand.held(3.0, hand.both)
    hand.outputs.failure(STALE, hand.contacts)


def test_a_task_without_a_load_leaves_the_stream_and_its_age(streaming):
    hand = streaming
    hand.set_task()
    hand.load()
    hand.set_task()
    hand.held(3.0, hand.contacts)
    hand.outputs.failure(STALE, hand.contacts)
    hand.set_task()
    assert 's old' in hand.outputs.failure(STALE, hand.contacts).result.message


def test_a_load_of_a_request_is_taken_back_by_one_without(streaming):
    hand = streaming
    hand.set_task(fz=-2.0)
    hand.held(2.0, hand.contacts)
    hand.feed_for(2 * MAX_AGE_S)
    hand.set_task()
    hand.outputs.failure(STALE, hand.contacts)


@pytest.mark.parametrize('ahead_s, words', [(10, 'ahead of this clock'), (-10, 's old')])
def test_stamps_far_from_now_are_stale_however_often_they_come(streaming, ahead_s, words):
    def late():
        streaming.load(ahead_s=ahead_s)
        streaming.contacts()

    quality = streaming.outputs.failure(STALE, late)
    assert words in quality.result.message and 'max_load_age' in quality.result.message


def test_without_a_stamp_the_sending_counts(streaming):
    hand = streaming

    def both():
        hand.load(-4.0, stamped=False)
        hand.contacts()

    hand.held(4.0, both)
    quality = hand.outputs.failure(STALE, hand.contacts)
    assert '(not stamped: since it was sent' in quality.result.message


def test_margins_need_no_load(start):
    """Contacts come once; what the watchdog says of the load does not take back their margin."""
    hand = Hand(start, max_contact_age=60.0, max_load_age=MAX_AGE_S)
    felt = felt_contacts(hand.client)(left=wrench(fz=5.0), right=wrench(fz=5.0))
    margins = hand.client.listen(GraspMargin, 'margin')

    def all_three():
        hand.load()
        felt()

    hand.outputs.answer(all_three)
    hand.client.until(lambda: margins and margins[-1].result.code == ResultCode.OPTIMAL,
                      'a margin', all_three)
    hand.outputs.failure(STALE)
    assert margins[-1].result.code == ResultCode.OPTIMAL
    hand.client.fresh(margins, feed=felt)
    assert hand.outputs.failure(STALE, felt) and margins[-1].result.code == ResultCode.OPTIMAL


def test_by_default_loads_do_not_age_and_none_is_none(start):
    hand = Hand(start, max_contact_age=0.1)
    found = hand.outputs.answer(hand.contacts)
    assert found.quality.external_wrench == wrench()
    hand.held(3.0, hand.both)
    hand.feed_for(1.0)
    hand.held(3.0, hand.contacts)
    hand.set_task()
    hand.outputs.answer(hand.contacts, lambda quality: quality.external_wrench == wrench())

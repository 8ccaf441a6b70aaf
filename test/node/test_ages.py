# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""How old a message is, by the clock of arrival, the ROS clock and the clock of its sender."""

from grasp_quality import SolverTimeoutError
from grasp_quality.node_ages import Ages, Subject, until_stale
from grasp_quality.node_settings import Settings
from grasps import pose_array
from live_desk import Clocks
from msg_adapters.errors import StaleContactsError
import pytest
from rclpy.time import Time

MAX_AGE_S = 0.1
SUBJECT = Subject('it is', 'max_contact_age', 'send another')
HALF_S = MAX_AGE_S / 2


class Post:
    """Messages that are sent, wait and arrive, from a sender with a clock of its own."""

    def __init__(self, stamped, ahead_s=0.0):
        self.clocks = Clocks()
        settings = Settings(max_contact_age=MAX_AGE_S)
        self.ages = Ages(lambda: settings, lambda: self.clocks.ros, lambda: self.clocks.steady,
                         lambda: self.clocks.system)
        self._stamped, self._ahead_ns = stamped, round(ahead_s * 1e9)

    def arrived(self, wait_s=0.0):
        """Send a message that arrives so much later."""
        stamp = Time(nanoseconds=self.clocks.ros + self._ahead_ns).to_msg()
        sent_ns = self.clocks.system + self._ahead_ns
        self.clocks.wait(wait_s)
        return self.ages.received(pose_array([], stamp if self._stamped else None), sent_ns)

    def age_s(self, received):
        return self.ages.checked_s(received, SUBJECT)

    def refusal(self, received):
        with pytest.raises(StaleContactsError) as caught:
            self.age_s(received)
        return str(caught.value)


@pytest.fixture(params=[True, False], ids=['stamped', 'unstamped'])
def stamped(request):
    return request.param


def test_waiting_in_a_queue_counts_as_age(stamped):
    post = Post(stamped)
    received = post.arrived(HALF_S)
    assert post.age_s(received) == pytest.approx(HALF_S)
    post.clocks.wait(HALF_S / 2)
    assert post.age_s(received) == pytest.approx(1.5 * HALF_S)
    post.clocks.wait(HALF_S)
    assert 'it is 0.125 s old' in post.refusal(received)
    assert post.refusal(received).endswith('max_contact_age is 0.1 s: send another')


def test_a_sender_whose_clock_is_ahead_is_refused_and_cannot_hide_a_wait(stamped):
    post = Post(stamped, ahead_s=10.0)
    for wait_s, ahead_s in ((0.0, 10), (5.0, 5)):
        text = post.refusal(post.arrived(wait_s))
        assert f'{ahead_s}.000 s ahead of this clock: synchronise the clocks' in text
        assert ('not stamped, and by the clock of the sender' in text) != stamped
    received = post.arrived()
    for _ in range(300):  # until that moment has come, and after it
        post.clocks.wait(HALF_S)
        post.refusal(received)


def test_clocks_may_differ_by_less_than_the_age(stamped):
    post = Post(stamped, ahead_s=HALF_S)
    received = post.arrived()
    assert post.age_s(received) == 0.0
    post.clocks.wait(2.1 * HALF_S)
    assert 's old' in post.refusal(received)


def test_a_sender_whose_clock_is_behind_is_told_of_it(stamped):
    post = Post(stamped, ahead_s=-10.0)
    text = post.refusal(post.arrived())
    assert 'it is 10.000 s old' in text
    assert ('since it was sent by the clock of the sender, which must agree' in text) != stamped


def test_without_a_time_of_sending_arrival_counts():
    post = Post(stamped=False)
    received = post.ages.received(pose_array([]), None)
    post.clocks.wait(HALF_S)
    assert post.age_s(received) == pytest.approx(HALF_S)


@pytest.mark.parametrize('left_s, most_s, words', [
    (1e-9, 1.0, 'raise max_contact_age'), (1.0, 1e-9, 'raise solver_time_limit')])
def test_a_time_limit_names_what_is_to_be_raised(left_s, most_s, words):
    with pytest.raises(SolverTimeoutError, match=f'limit of 1e-09 s is over: .*{words}'):
        until_stale(left_s, most_s).remaining_s()

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured against possible, live: ~/margin, and the warning on /diagnostics."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from felt_contacts import felt_contacts, NAMES
from grasp_quality_msgs.msg import GraspMargin, ResultCode
from grasps import numbers, SOLVER, wrench
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter

# frames of ANTIPODAL have +z inward; left and right both push the object along +y by 2 N
EVEN = {'left': wrench(fy=2.0, fz=5.0), 'right': wrench(fy=2.0, fz=5.0)}


@pytest.fixture(scope='module')
def client(start):
    return start(contact_names='[left, right]', max_contact_age='0.5', wanted_margin='0.5').client


@pytest.fixture(scope='module')
def feed(client):
    """Return a function that makes a feed of the two poses and of wrenches by name."""
    return felt_contacts(client)


@pytest.fixture(scope='module')
def margins(client):
    return client.listen(GraspMargin, 'margin')


def nothing(message):
    return (message.slip_margin, message.load_alpha, message.load_share, message.largest_change,
            message.restorable, message.contacts) == (0.0, 0.0, 0.0, 0.0, False, [])


def test_share_in_use_and_the_change_that_restores_the_margin(client, feed, margins):
    """4 N along y of 10 N possible; usage 0.8; at margin 0.5 each finger needs n = 8 N."""
    found = client.fresh(
        margins, lambda m: m.result.code == ResultCode.OPTIMAL, 'a margin', feed(**EVEN))
    assert found.header.frame_id == 'object'
    assert found.slip_margin == pytest.approx(0.2, rel=SOLVER)
    assert abs(numbers(found.applied_wrench)[1]) == pytest.approx(4.0, rel=SOLVER)
    assert found.load_alpha == pytest.approx(2.5, rel=SOLVER)
    assert found.load_share == pytest.approx(0.4, rel=SOLVER)
    assert found.wanted_margin == 0.5 and found.restorable
    assert found.largest_change == pytest.approx(3.0, abs=1e-3)
    assert [c.name for c in found.contacts] == list(NAMES)
    left, right = (numbers(c.change) for c in found.contacts)
    assert left == pytest.approx([3.0, 0, 0, 0, 0, 0], abs=1e-3)
    assert right == pytest.approx([-3.0, 0, 0, 0, 0, 0], abs=1e-3)
    assert [c.slip_margin for c in found.contacts] == pytest.approx([0.2, 0.2], rel=SOLVER)


def test_a_margin_that_is_there_needs_no_change(client, feed, margins):
    easy = {name: wrench(fy=1.0, fz=8.0) for name in NAMES}
    found = client.fresh(margins, lambda m: m.slip_margin > 0.7, 'a margin', feed(**easy))
    assert found.restorable and found.largest_change == 0.0
    assert not any(numbers(c.change).any() for c in found.contacts)


def test_a_margin_out_of_reach_is_told(client, feed, margins):
    """8 N along y need 8 N and more of each finger; with half of the cone 16 N."""
    hard = {name: wrench(fy=4.0, fz=9.0) for name in NAMES}
    found = client.fresh(
        margins, lambda m: m.load_share == pytest.approx(0.8, rel=SOLVER), 'a margin',
        feed(**hard))
    assert not found.restorable and found.largest_change == 0.0


def test_outside_of_cones_the_share_is_more_than_one_or_the_margin_negative(
        client, feed, margins):
    slipping = {name: wrench(fy=3.0, fz=4.0) for name in NAMES}
    found = client.fresh(margins, lambda m: m.slip_margin < 0.0, 'a margin', feed(**slipping))
    assert found.slip_margin == pytest.approx(-0.5, rel=SOLVER)


@pytest.mark.parametrize('measured, words', [
    ({'left': EVEN['left']}, "no fresh measured wrench of ['right']"),
    ({}, "no fresh measured wrench of ['left', 'right']")])
def test_a_missing_measurement_is_a_failure(client, feed, margins, measured, words):
    found = client.fresh(
        margins, lambda m: words in m.result.message, words, feed(**measured))
    assert found.result.code == ResultCode.STALE_CONTACTS and nothing(found)


def test_silence_is_a_failure_too(client, feed, margins):
    client.fresh(margins, lambda m: m.result.code == ResultCode.OPTIMAL, 'one', feed(**EVEN))
    found = client.fresh(
        margins, lambda m: 'max_contact_age' in m.result.message, 'stale contacts')
    assert found.result.code == ResultCode.STALE_CONTACTS and nothing(found)


def test_a_low_margin_is_warned_of(client, feed):
    reports = client.listen(DiagnosticArray, '/diagnostics')
    answer = client.call(SetParameters, 'set_parameters', parameters=[
        Parameter('task_wrench', value=[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]).to_parameter_msg(),
        Parameter('margin_warning', value=0.3).to_parameter_msg()])
    assert all(result.successful for result in answer.results)
    status = client.fresh(
        reports, lambda m: 'below margin_warning' in m.status[0].message, 'a warning',
        feed(**EVEN)).status[0]
    assert status.level == DiagnosticStatus.WARN
    assert 'measured slip margin 0.2 is below margin_warning 0.3' in status.message
    easy = {name: wrench(fy=1.0, fz=8.0) for name in NAMES}
    client.fresh(reports, lambda m: m.status[0].level == DiagnosticStatus.OK, 'no warning',
                 feed(**easy))

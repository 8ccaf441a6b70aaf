# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the bridge follows, what makes it hold, and what it says."""

import dataclasses
import re

from grasp_quality_hand.contact_pushes import Pushes
from grasp_quality_hand.effort_bridge import EffortBridge, FramedPushes, Joints, ObjectPose
from grasp_quality_hand.effort_command import EffortCommand, Holding, Phase
from grasp_quality_hand.effort_inputs import Newest, Now, Unusable
from grasp_quality_hand.hand_kinematics import HandKinematics
from hypothesis import given, HealthCheck, settings, strategies
import numpy as np
import pytest
from two_fingers import LENGTH, urdf

EXACT = 1e-9
RATE_HZ = 200
LIFTED = ObjectPose('palm', np.eye(3), np.array([0.0, 0.0, LENGTH]))
anything = strategies.floats(allow_nan=True, allow_infinity=True)


def pinch(size=3.0, names=('left', 'right')):
    """Both fingers push inward, in the object's frame, whose origin lies between their tips."""
    return Pushes(names, np.array([[-0.05, 0, 0], [0.05, 0, 0]])[:len(names)],
                  size * np.array([[1.0, 0, 0], [-1.0, 0, 0]])[:len(names)],
                  np.zeros((len(names), 3)))


class Rig:
    """A bridge with a clock of its own; both clocks begin at 1 s."""

    def __init__(self, max_rate=1e6, period=0.0, **holding):
        hand = HandKinematics(urdf(), ['left_hinge', 'right_hinge'])
        command = EffortCommand(
            hand.effort_limits, max_rate, Holding(**{'ramp_time': 0.2, **holding}))
        self.bridge = EffortBridge(
            hand, {'left': 'left_finger', 'right': 'right_finger'}, command, 0.1, 0.1, 0.1,
            'object', period=period)
        self.now = Now(10 ** 9, 1.0)
        self.report = None
        self.tick()  # the first has no time before it

    def wait(self, seconds):
        self.now = Now(self.now.ros_ns + round(1e9 * seconds), self.now.steady_s + seconds)

    def joints(self, left=0.0, right=0.0, **fields):
        self.bridge.joints.put(Joints({'left_hinge': left, 'right_hinge': right}, **fields),
                               self.now.ros_ns, self.now)

    def forces(self, pushes=None, frame='object', **fields):
        self.bridge.forces.put(FramedPushes(frame, pushes or pinch(), **fields),
                               self.now.ros_ns, self.now)

    def feed(self, pushes=None):
        self.joints()
        self.forces(pushes)
        self.bridge.poses.put(LIFTED, self.now.ros_ns, self.now)

    def tick(self):
        self.wait(1.0 / RATE_HZ)
        efforts, self.report = self.bridge.tick(self.now)
        return efforts


@pytest.fixture
def rig():
    return Rig()


def test_forces_in_the_object_frame_go_through_its_pose(rig):
    rig.feed()
    assert rig.tick() == pytest.approx([0.3, -0.3], abs=EXACT)
    assert (rig.report.phase, rig.report.reason, rig.report.scale) == (Phase.FOLLOWING, '', 1.0)


def test_forces_in_a_third_frame_are_not_taken_for_those_of_the_object(rig):
    rig.feed()
    rig.tick()
    rig.forces(frame='camera')
    rig.tick()
    assert rig.report.phase is Phase.RAMPING and "'camera'" in rig.report.reason


def test_forces_in_the_base_frame_need_no_pose(rig):
    rig.joints()
    rig.forces(dataclasses.replace(pinch(), positions=pinch().positions + LIFTED.p), 'palm')
    assert rig.tick() == pytest.approx([0.3, -0.3], abs=EXACT)


def test_forces_beyond_the_limits_are_scaled_together_and_told(rig):
    rig.feed(pinch(40.0))
    assert rig.tick() == pytest.approx([2.0, -2.0], abs=EXACT)
    assert rig.report.scale == pytest.approx(0.5, abs=EXACT)


@pytest.mark.parametrize('spoil, words', [
    (lambda rig: rig.forces(Pushes((), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3)))),
     'are empty'),
    (lambda rig: rig.forces(pinch(names=('left', 'thumb'))), r"contacts \['thumb'\] have no link"),
    (lambda rig: rig.forces(problem='bad contact forces: nan'), 'bad contact forces'),
    (lambda rig: rig.bridge.joints.put(Joints({'left_hinge': 0.0}), 0, rig.now),
     r"joint states lack \['right_hinge'\]"),
    (lambda rig: rig.bridge.poses.put(dataclasses.replace(LIFTED, frame='camera'), 0, rig.now),
     "'camera', and not in the base frame 'palm'")])
def test_what_cannot_be_followed_makes_it_hold_at_once(rig, spoil, words):
    rig.feed()
    followed = rig.tick()
    rig.feed()
    spoil(rig)
    held = rig.tick()
    assert rig.report.phase is Phase.RAMPING
    assert re.search(words, rig.report.reason)
    assert held == pytest.approx(followed, abs=EXACT)  # the mean of those before


@pytest.mark.parametrize('silent, words, blind', [
    ('forces', 'newest contact forces are older', False),
    ('joints', 'newest joint states are older', True),
    ('poses', 'newest poses of the object are older', False)])
def test_silence_of_any_input_makes_it_hold_within_the_stated_time(silent, words, blind):
    """Age limit and ramp together: 0.3 s, and a tick."""
    rig = Rig(efforts=np.array([0.1, 0.0]))
    rig.feed()
    rig.tick()
    elapsed = 0.0
    while rig.report.phase is not Phase.HOLDING:
        if silent != 'forces':
            rig.forces()
        if silent != 'joints':
            rig.joints()
        if silent != 'poses':
            rig.bridge.poses.put(LIFTED, rig.now.ros_ns, rig.now)
        efforts = rig.tick()
        elapsed += 1.0 / RATE_HZ
        assert elapsed <= 0.3 + 2.0 / RATE_HZ
    assert words in rig.report.reason and rig.report.blind == blind
    assert efforts == pytest.approx([0.1, 0.0], abs=EXACT)


def test_nothing_is_commanded_before_everything_is_there(rig):
    assert rig.tick() is None and 'no joint states' in rig.report.reason
    rig.joints()
    assert rig.tick() is None and 'no contact forces' in rig.report.reason
    rig.forces()
    assert rig.tick() is None and 'no poses of the object' in rig.report.reason
    assert rig.report.phase is Phase.WAITING


def test_a_bridge_that_starts_again_begins_at_the_measured_efforts():
    rig = Rig(max_rate=10.0)
    rig.feed()
    rig.joints(efforts={'left_hinge': 0.5, 'right_hinge': -0.5})
    assert rig.tick() == pytest.approx([0.45, -0.45], abs=EXACT)


def test_good_forces_again_end_the_hold(rig):
    rig.feed()
    rig.tick()
    rig.wait(0.5)
    for _ in range(41):
        rig.tick()
    assert rig.report.phase is Phase.HOLDING
    rig.feed()
    assert rig.tick() == pytest.approx([0.3, -0.3], abs=EXACT)
    assert rig.report.phase is Phase.FOLLOWING


def test_the_end_is_a_hold(rig):
    rig.feed()
    rig.tick()
    rig.bridge.ending = 'the node is ending'
    for _ in range(41):
        rig.feed()
        rig.tick()
    assert rig.report.phase is Phase.HOLDING and rig.report.reason == 'the node is ending'


@settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
@given(strategies.lists(strategies.tuples(
    strategies.sampled_from(['forces', 'joints', 'pose', 'wait']),
    strategies.lists(anything, min_size=4, max_size=4)), max_size=12))
def test_whatever_comes_in_what_goes_out_is_finite_and_within_the_limits(events):
    """Even numbers that the message adapters would have refused."""
    rig = Rig(stiffness=5.0, damping=0.1)
    rig.feed()
    for kind, values in events:
        if kind == 'forces':
            rig.forces(Pushes(('left', 'right'), np.array([values[:3]] * 2),
                              np.array([values[1:]] * 2), np.array([values[:3]] * 2)))
        elif kind == 'joints':
            rig.joints(values[0], values[1], rates={'left_hinge': values[2],
                                                    'right_hinge': values[3]})
        elif kind == 'pose':
            rig.bridge.poses.put(ObjectPose('palm', values[3] * np.eye(3), np.array(values[:3])),
                                 rig.now.ros_ns, rig.now)
        else:
            rig.wait(0.06)
        with np.errstate(all='ignore'):
            efforts = rig.tick()
        if efforts is not None:
            assert efforts.shape == (2,) and np.isfinite(efforts).all()
            assert (np.abs(efforts) <= 2.0).all()


def at(seconds, steady=None):
    return Now(round(1e9 * seconds), seconds if steady is None else steady)


def test_late_messages_are_dropped():
    newest = Newest('things', 0.1)
    newest.put('new', 10 ** 9, at(1.0))
    newest.put('late', 10 ** 9 - 1, at(1.01))
    assert newest.fresh(at(1.02)) == 'new' and newest.dropped == 1
    newest.put('again', 10 ** 9, at(1.03))
    assert newest.fresh(at(1.04)) == 'again'


def test_a_clock_that_was_set_back_stops_nothing_for_long():
    newest = Newest('things', 0.1)
    newest.put('before', 10 * 10 ** 9, at(10.0))
    newest.put('after', 5 * 10 ** 9, at(5.0, 10.2))
    assert newest.fresh(at(5.05, 10.25)) == 'after'


@pytest.mark.parametrize('stamp, now, words', [
    (10 ** 9, at(1.2), 'older than'), (10 ** 9, at(1.2, 1.0), 'older than'),
    (10 ** 9, at(1.0, 1.2), 'older than'), (0, at(1.2), 'older than'),
    (2 * 10 ** 9, at(1.05), 'ahead of')])
def test_what_is_too_old_or_from_the_future_is_no_use(stamp, now, words):
    newest = Newest('things', 0.1)
    newest.put('thing', stamp, at(1.0))
    with pytest.raises(Unusable, match=words):
        newest.fresh(now)


def test_a_message_without_a_stamp_is_as_old_as_its_arrival():
    newest = Newest('things', 0.1)
    newest.put('thing', 0, at(1.0))
    assert newest.fresh(at(1.05)) == 'thing'

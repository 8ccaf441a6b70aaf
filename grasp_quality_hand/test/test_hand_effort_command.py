# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Efforts over time: slew limit, ramp, holding; always finite and within the limits."""

from grasp_quality_hand.effort_command import EffortCommand, Holding, Phase
from hypothesis import given, strategies
import numpy as np
import pytest

LIMITS = np.array([1.0, 2.0])
PERIOD = 0.005
EXACT = 1e-12
anything = strategies.floats(allow_nan=True, allow_infinity=True)
efforts = strategies.lists(anything, min_size=2, max_size=2).map(np.array)
steps = strategies.lists(strategies.tuples(
    strategies.sampled_from(['follow', 'hold', 'blind hold', 'begin']), efforts, efforts),
    max_size=30)


def command(max_rate=10.0, **holding):
    return EffortCommand(LIMITS, max_rate, Holding(**{'ramp_time': 0.2, **holding}))


@given(steps, strategies.sampled_from([None, np.array([0.5, -2.0])]))
def test_whatever_comes_in_what_goes_out_is_finite_and_within_the_limits(events, holding):
    commanded = command(efforts=holding, stiffness=3.0, damping=0.1)
    begun = False
    for kind, first, second in events:
        if kind == 'begin':
            commanded.begin(first)
            continue
        if kind == 'follow':
            out = commanded.follow(first, PERIOD)
            begun = True
        else:
            out = commanded.hold(PERIOD, *((first, second) if kind == 'hold' else ()))
        assert (out is not None) == begun
        if out is not None:
            assert out.shape == (2,) and np.isfinite(out).all() and (np.abs(out) <= LIMITS).all()


@given(strategies.lists(strategies.lists(
    strategies.floats(-3.0, 3.0), min_size=2, max_size=2).map(np.array), max_size=20))
def test_no_joint_is_faster_than_the_slew_limit(wanted):
    commanded, last = command(max_rate=10.0), np.zeros(2)
    for each in wanted:
        out = commanded.follow(each, PERIOD)
        assert (np.abs(out - last) <= 10.0 * PERIOD + EXACT).all()
        last = out


def test_it_gets_there_on_the_straight_way():
    """Between two efforts in balance everything commanded is in balance too."""
    commanded, goal = command(max_rate=10.0), np.array([0.3, -0.9])
    path = [commanded.follow(goal, PERIOD) for _ in range(30)]
    assert path[-1] == pytest.approx(goal, abs=EXACT)
    assert len([p for p in path if np.abs(p - goal).max() > EXACT]) == 17  # 0.9 / 0.05
    for p in path:
        assert p[0] * goal[1] == pytest.approx(p[1] * goal[0], abs=EXACT)


def test_nothing_is_commanded_before_there_were_good_forces():
    commanded = command()
    assert commanded.hold(PERIOD, np.zeros(2), np.zeros(2)) is None
    assert commanded.phase is Phase.WAITING


def test_the_first_command_is_no_jump_from_what_is_measured():
    commanded = command(max_rate=10.0)
    commanded.begin(np.array([0.8, -0.4]))
    assert commanded.follow(np.zeros(2), PERIOD) == pytest.approx([0.75, -0.375], abs=EXACT)


@pytest.mark.parametrize('efforts, goal', [(None, [0.4, 0.1]), (np.array([0.1, 0.2]), [0.1, 0.2])])
def test_a_hold_is_reached_within_the_ramp_time_on_the_straight_way(efforts, goal):
    """Without holding efforts: the mean of those before."""
    commanded = command(max_rate=1e6, efforts=efforts)
    for _ in range(400):
        start = commanded.follow(np.array([0.4, 0.1]), PERIOD)
    phases, path = [], []
    for _ in range(41):
        path.append(commanded.hold(PERIOD))
        phases.append(commanded.phase)
    assert phases[0] is Phase.RAMPING and phases[39] is Phase.HOLDING
    assert path[-1] == pytest.approx(goal, abs=EXACT)
    assert path[19] == pytest.approx(start + 0.5 * (np.array(goal) - start), abs=1e-9)


def test_a_hold_takes_the_mean_of_what_was_followed():
    commanded = command(max_rate=1e6)
    for i in range(4000):
        commanded.follow(np.array([0.4 + 0.2 * (-1) ** i, 0.0]), PERIOD)
    for _ in range(41):
        out = commanded.hold(PERIOD)
    assert out == pytest.approx([0.4, 0.0], abs=0.01)


def test_a_hold_keeps_the_posture_and_when_blind_lets_the_spring_go():
    commanded = command(max_rate=1e6, stiffness=2.0, damping=0.5)
    commanded.follow(np.zeros(2), PERIOD)
    for _ in range(41):
        commanded.hold(PERIOD, np.array([1.0, 1.0]), np.zeros(2))
    assert commanded.hold(PERIOD, np.array([0.9, 1.1]), np.array([0.2, 0.0])) == pytest.approx(
        [2.0 * 0.1 - 0.5 * 0.2, -0.2], abs=EXACT)
    assert commanded.hold(PERIOD) == pytest.approx([0.0, 0.0], abs=EXACT)


def test_good_forces_end_a_hold_without_a_jump():
    commanded = command(max_rate=10.0, efforts=np.zeros(2))
    for _ in range(100):
        commanded.follow(np.array([0.5, 0.5]), PERIOD)
    for _ in range(50):
        commanded.hold(PERIOD)
    assert commanded.follow(np.array([0.5, 0.5]), PERIOD) == pytest.approx([0.05, 0.05], abs=EXACT)
    assert commanded.phase is Phase.FOLLOWING
    assert commanded.hold(PERIOD) == pytest.approx([0.05 * 0.975] * 2, abs=EXACT)


def test_joint_states_that_become_stale_in_a_hold_change_nothing_at_once():
    commanded = command(ramp_time=0.0, stiffness=2.0, efforts=np.array([0.3, 0.3]))
    commanded.follow(np.zeros(2), PERIOD)
    commanded.hold(PERIOD, np.zeros(2), np.zeros(2))
    for _ in range(8):  # 0.4 N m
        seen = commanded.hold(PERIOD, np.array([-0.2, 0.1]), np.zeros(2))
    assert seen == pytest.approx([0.7, 0.1], abs=EXACT)
    assert commanded.hold(PERIOD) == pytest.approx([0.65, 0.15], abs=EXACT)
    for _ in range(8):
        blind = commanded.hold(PERIOD)
    assert blind == pytest.approx([0.3, 0.3], abs=EXACT)


@given(strategies.lists(strategies.tuples(strategies.booleans(), efforts, efforts), max_size=30))
def test_in_a_hold_no_sample_of_the_joints_moves_an_effort_faster_than_the_slew_limit(samples):
    commanded = command(ramp_time=0.0, stiffness=10.0, damping=0.1, efforts=np.array([0.3, -1.9]))
    commanded.follow(np.zeros(2), PERIOD)
    last = commanded.hold(PERIOD)
    for seen, positions, rates in samples:
        out = commanded.hold(PERIOD, *((positions, rates) if seen else ()))
        assert (np.abs(out - last) <= 10.0 * PERIOD + EXACT).all()
        last = out


def test_one_outlier_before_the_joint_states_end_is_forgotten():
    commanded = command(max_rate=50.0, stiffness=10.0, damping=0.1, efforts=np.array([0.3, 0.3]))
    commanded.follow(np.zeros(2), PERIOD)
    for _ in range(41):
        commanded.hold(PERIOD, np.zeros(2), np.zeros(2))
    for _ in range(400):  # 2 s: it must not wind up either
        commanded.hold(PERIOD, np.array([6.3, 0.0]), np.array([1e3, 0.0]))
    for _ in range(6):    # from the limit, 1.3 N m away
        held = commanded.hold(PERIOD)
    assert held == pytest.approx([0.3, 0.3], abs=EXACT)

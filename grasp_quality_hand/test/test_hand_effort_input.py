# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of the effort commands that a hand's driver gets."""

from grasp_quality_hand.effort_input import BadCommand, EffortInput, HANDOVER_TIME
import numpy as np
import pytest

NAMES = ('a', 'b')
OWN = np.array([1.0, -1.0])
TIMEOUT, STEP = 0.1, 0.001


def run(efforts, begin, duration):
    """Return the torques of every time step, shape (steps, 2)."""
    times = begin + STEP * np.arange(round(duration / STEP))
    return np.array([efforts.mix(OWN, time, STEP) for time in times])


def test_without_commands_the_torques_are_the_hands_own():
    assert np.array_equal(run(EffortInput(NAMES, TIMEOUT), 0.0, 0.3), np.tile(OWN, (300, 1)))


def test_commands_take_over_within_the_handover_time_and_silence_gives_back():
    efforts, command = EffortInput(NAMES, 0.2), np.array([3.0, 5.0])
    efforts.put(command, 0.0)
    torques = run(efforts, 0.0, 0.5)
    taken = round(HANDOVER_TIME / STEP)
    assert np.allclose(torques[taken:200], command)
    assert np.allclose(torques[200 + taken + 1:], OWN)
    assert np.abs(np.diff(torques, axis=0)).max() <= (
        np.abs(command - OWN).max() * STEP / HANDOVER_TIME + 1e-12)


@pytest.mark.parametrize('bad, rule', [
    ([1.0], '1 efforts came for 2 joints'), ([], '0 efforts'),
    ([1.0, np.nan], 'effort of b is not finite'), ([np.inf, 1.0], 'effort of a is not finite')])
def test_an_unusable_command_is_refused_and_the_one_before_stays(bad, rule):
    efforts = EffortInput(NAMES, TIMEOUT)
    efforts.put([2.0, 2.0], 0.0)
    with pytest.raises(BadCommand, match=rule):
        efforts.put(bad, 0.05)
    assert efforts.is_fresh(TIMEOUT) and not efforts.is_fresh(TIMEOUT + STEP)


def test_forgotten_commands_are_without_effect_at_once():
    efforts = EffortInput(NAMES, TIMEOUT)
    efforts.put([2.0, 2.0], 0.0)
    run(efforts, 0.0, TIMEOUT)
    efforts.forget()
    assert np.array_equal(efforts.mix(OWN, 0.0, STEP), OWN)

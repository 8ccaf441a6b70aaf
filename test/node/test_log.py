# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Refusals in the log: no reason hides another, none is repeated, and there is no flood."""

from grasp_quality.node_log import MOST, PERIOD_S, Refusals


def test_each_reason_is_said_once_a_period():
    said, time = [], [0.0]
    refusals = Refusals(said.append, lambda: time[0])
    for moment in (0.0, 0.5 * PERIOD_S, PERIOD_S):
        time[0] = moment
        for text in ('a', 'b', 'a'):
            refusals.tell(text)
    assert said == ['a', 'b', 'a', 'b']


def test_a_flood_of_reasons_is_cut():
    said, time = [], [0.0]
    refusals = Refusals(said.append, lambda: time[0])
    for i in range(1000):
        refusals.tell(f'reason {i}')
    assert len(said) == MOST
    time[0] = PERIOD_S
    refusals.tell('the next second')
    assert said[-1] == 'the next second'

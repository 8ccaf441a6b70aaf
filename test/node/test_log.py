# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The log: no reason hides another, none is repeated, and there is no flood."""

from grasp_quality.node_log import Changes, MOST, PERIOD_S, Refusals


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


def test_a_code_is_said_when_it_changes():
    said = []
    changes = Changes(lambda code, words: said.append((code, words)))
    for code, words in ((1, 'a'), (1, 'b'), (2, 'c')):
        changes.note(code, words)
        changes.end_period()
    assert said == [(1, 'a'), (2, 'c')]


def test_what_was_so_before_is_not_said_later():
    said = []
    changes = Changes(lambda code, words: said.append(words))
    for code, words in ((1, 'a'), (2, 'b'), (1, 'gone')):
        changes.note(code, words)
    changes.forget()
    changes.end_period()
    changes.note(2, 'anew')
    assert said == ['a', 'b', 'anew']


def test_codes_that_take_turns_are_said_once_a_period_and_the_last_one_at_its_end():
    said = []
    changes = Changes(lambda code, words: said.append((code, words)))
    for period in range(3):
        for turn in range(100):
            changes.note(1, f'one {period} {turn}')
            changes.note(2, f'two {period} {turn}')
        changes.note(1, f'end {period}')
        changes.end_period()
    assert len(said) <= 3 * 3 and said[:3] == [(1, 'one 0 0'), (2, 'two 0 0'), (1, 'end 0')]
    assert said[-1] == (1, 'end 2')

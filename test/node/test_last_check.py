# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever becomes too old until the moment of publishing has no forces."""

from grasp_quality import node_holding, node_outputs
from grasp_quality_msgs.msg import ResultCode
from grasps import SOLVER, total_wrench
from live_desk import LiveDesk, MAX_AGE_S
import pytest


def then(monkeypatch, module, name, happens):
    """Let something happen whenever a function of a module has done its work."""
    work = getattr(module, name)

    def worked(*args, **options):
        result = work(*args, **options)
        happens()
        return result
    monkeypatch.setattr(module, name, worked)


@pytest.fixture
def desk():
    desk = LiveDesk()
    desk.store(desk.contacts())
    desk.store(desk.wrench(fz=-3.0))
    return desk


def test_in_time_they_are_published(desk):
    heard = desk.evaluate()
    assert total_wrench(heard['holding_forces'])[2] == pytest.approx(3.0, abs=SOLVER)
    assert len(heard['contact_forces'].forces) == 2


def jump_of_the_clock(desk):
    desk.clocks.ros += round(2e9 * MAX_AGE_S)


def pause_of_the_process(desk):
    desk.clocks.wait(2 * MAX_AGE_S)


@pytest.mark.parametrize('happens', [jump_of_the_clock, pause_of_the_process])
@pytest.mark.parametrize('module, name', [
    (node_holding, 'hold_forces'), (node_outputs, 'force_array')])
def test_what_became_stale_is_not_held_with(desk, monkeypatch, module, name, happens):
    """During the search, and while its forces are made a message."""
    quality = desk.evaluate()['quality']
    publish = node_holding.HoldingForces.publish

    def after_the_answer(*args):
        then(monkeypatch, module, name, lambda: happens(desk))
        publish(*args)

    monkeypatch.setattr(node_holding.HoldingForces, 'publish', after_the_answer)
    desk.store(desk.contacts())
    heard = desk.evaluate()
    assert heard['holding_forces'].forces == []
    assert heard['holding_forces'].header.stamp == quality.header.stamp
    assert heard['quality'].result.code == ResultCode.OPTIMAL  # it had been in time


@pytest.mark.parametrize('happens', [jump_of_the_clock, pause_of_the_process])
def test_what_became_stale_before_the_answer_has_no_forces_at_all(desk, monkeypatch, happens):
    then(monkeypatch, node_outputs, 'force_array', lambda: happens(desk))
    heard = desk.evaluate()
    assert heard['quality'].result.code == ResultCode.STALE_CONTACTS
    assert heard['contact_forces'].forces == heard['holding_forces'].forces == []

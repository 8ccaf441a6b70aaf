# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever becomes too old until the moment of publishing has no forces."""

from grasp_quality import node_holding, node_live, node_outputs
from grasp_quality.warm_up import warm_up
from grasp_quality_msgs.msg import ResultCode
from grasps import SOLVER, total_wrench
from live_desk import LiveDesk, MAX_AGE_S, NAMES
from msg_adapters.errors import StaleContactsError
import pytest


def then(monkeypatch, module, name, happens):
    """Let something happen whenever a function of a module has done its work."""
    work = getattr(module, name)

    def worked(*args, **options):
        result = work(*args, **options)
        happens()
        return result
    monkeypatch.setattr(module, name, worked)


@pytest.fixture(scope='module', autouse=True)
def compiled():
    """Leave the time limits to the solves, as the node does."""
    warm_up('linf')


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


def measured(desk, left_ago_s, newtons=(5.0, 5.0)):
    """Take fresh contacts and what they feel, the left one a while ago."""
    for name, ago_s, force in zip(NAMES, (left_ago_s, 0.0), newtons):
        desk.inputs.store_wrench(name, desk.wrench(ago_s, name, fz=force))
    desk.store(desk.contacts())


@pytest.mark.parametrize('module, name', [
    (node_live, 'evaluate'), (node_outputs, 'force_array')])
def test_forces_do_not_rest_on_a_measurement_that_became_stale(monkeypatch, module, name):
    desk = LiveDesk(min_contact_force=1.0)
    measured(desk, 0.9 * MAX_AGE_S)
    assert len(desk.evaluate()['contact_forces'].forces) == 2
    then(monkeypatch, module, name, lambda: desk.clocks.wait(0.2 * MAX_AGE_S))
    measured(desk, 0.9 * MAX_AGE_S)
    heard = desk.evaluate()
    assert heard['quality'].result.code == ResultCode.STALE_CONTACTS
    assert 'the measured wrench of left is 22.000 s old' in heard['quality'].result.message
    assert heard['contact_forces'].forces == heard['holding_forces'].forces == []


@pytest.mark.parametrize('least, newtons, count', [(0.0, 5.0, 2), (1.0, 0.5, 1)])
def test_a_measurement_that_no_force_rests_on_may_become_stale(monkeypatch, least, newtons, count):
    """All contacts count, or the one that it is of does not count with it or without."""
    desk = LiveDesk(min_contact_force=least)
    desk.inputs.set_task_wrench((-1.0, 0.0, 0.0, 0.0, 0.0, 0.0))  # the right one can alone
    then(monkeypatch, node_live, 'evaluate', lambda: desk.clocks.wait(0.2 * MAX_AGE_S))
    measured(desk, 0.9 * MAX_AGE_S, (newtons, 5.0))
    heard = desk.evaluate()
    assert len(heard['contact_forces'].forces) == count


def test_the_time_limit_is_what_is_left_of_the_oldest_measurement():
    desk = LiveDesk(min_contact_force=1.0)
    measured(desk, 0.9 * MAX_AGE_S)
    desk.inputs.scene()
    assert desk.inputs.left_s() == pytest.approx(0.1 * MAX_AGE_S)
    measured(desk, 0.2 * MAX_AGE_S)
    desk.clocks.wait(0.1 * MAX_AGE_S)
    desk.inputs.scene()
    assert desk.inputs.left_s() == pytest.approx(0.7 * MAX_AGE_S)


def test_a_service_answers_no_forces_for_a_measurement_that_became_stale():
    """Newer ones of the same contact do not make it fresh."""
    desk = LiveDesk(min_contact_force=1.0)
    measured(desk, 0.9 * MAX_AGE_S)
    desk.inputs.scene()
    asked = desk.inputs.contacts, desk.inputs.loaded_by
    desk.inputs.check_answered(*asked)
    desk.clocks.wait(0.2 * MAX_AGE_S)
    measured(desk, 0.0)
    desk.inputs.scene()
    with pytest.raises(StaleContactsError, match='the measured wrench of left is 22.000 s old'):
        desk.inputs.check_answered(*asked)

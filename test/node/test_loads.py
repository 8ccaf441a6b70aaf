# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Which load counts: of two publishers the one stamped later, of a task one that is not zero."""

from geometry_msgs.msg import WrenchStamped
from grasps import wrench
from live_desk import LiveDesk
from msg_adapters.errors import StaleContactsError
from msg_adapters.tasks import HeldLoad
import pytest
from std_msgs.msg import Header

AGE_S = 0.5


@pytest.fixture
def desk():
    return LiveDesk(max_load_age=AGE_S)


def newest(desk):
    return desk.inputs.loads.newest().wrench.force.z


def give(desk, newtons):
    desk.inputs.loads.give(HeldLoad(wrench(fz=newtons), Header()))


def test_one_stamped_earlier_does_not_replace_a_fresh_one(desk):
    desk.store(desk.wrench(ago_s=0.1, fz=-1.0))
    desk.store(desk.wrench(ago_s=0.2, fz=-2.0))
    assert newest(desk) == -1.0
    desk.store(desk.wrench(ago_s=0.1, fz=-3.0))
    assert newest(desk) == -3.0
    desk.store(WrenchStamped(wrench=wrench(fz=-4.0)))  # not stamped: as it comes
    assert newest(desk) == -4.0


def test_it_replaces_one_that_is_stale(desk):
    desk.store(desk.wrench(fz=-1.0))
    late = desk.wrench(ago_s=0.1, fz=-2.0)
    desk.clocks.wait(0.9 * AGE_S)
    desk.clocks.steady += round(0.2e9 * AGE_S)  # stale by its arrival, and not yet by its stamp
    desk.store(late)
    with pytest.raises(StaleContactsError):
        newest(desk)
    desk.clocks.ros -= round(0.2e9)
    assert newest(desk) == -2.0


def test_after_the_clock_was_set_back_the_next_one_counts(desk):
    desk.store(desk.wrench(fz=-1.0))
    desk.clocks.ros -= 3600 * 10 ** 9
    desk.store(desk.wrench(fz=-2.0))
    assert newest(desk) == -2.0


def test_one_stamped_earlier_does_not_take_back_that_of_a_task(desk):
    desk.store(desk.wrench(fz=-1.0))
    give(desk, -5.0)
    desk.store(desk.wrench(ago_s=0.1, fz=-2.0))
    assert newest(desk) == -5.0
    desk.store(desk.wrench(fz=-3.0))
    assert newest(desk) == -3.0


def test_loads_that_do_not_age_count_as_they_come():
    desk = LiveDesk()
    desk.store(desk.wrench(fz=-1.0))
    desk.store(desk.wrench(ago_s=0.1, fz=-2.0))
    assert newest(desk) == -2.0
    desk.clocks.ros -= 3600 * 10 ** 9
    desk.store(desk.wrench(fz=-3.0))
    assert newest(desk) == -3.0


@pytest.mark.parametrize('newtons', [0.0, 1e-17, -9e-13])
def test_a_task_with_less_than_the_smallest_load_leaves_the_stream_and_its_age(desk, newtons):
    desk.store(desk.wrench(fz=-1.0))
    give(desk, newtons)
    assert newest(desk) == -1.0
    desk.clocks.wait(1.1 * AGE_S)
    with pytest.raises(StaleContactsError, match='max_load_age is 0.5 s: publish loads steadily'):
        newest(desk)


def test_the_smallest_load_of_a_task_is_one(desk):
    give(desk, -1e-12)
    assert newest(desk) == -1e-12

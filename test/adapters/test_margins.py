# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured margins in messages: changes in the object frame's axes, and nothing of no answer."""

from adapter_messages import EXACT
from grasp_quality import Contact, ContactModel, Grasp, measured_margin
from grasp_quality_msgs.msg import GraspMargin, ResultCode
from msg_adapters.margins import margin_message
from msg_adapters.wrenches import wrench_array
import numpy as np
import pytest
from std_msgs.msg import Header

HEADER = Header(frame_id='object')
PAIR = Grasp([
    Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), ContactModel.SFCE, 0.5, 0.1, 10.0, name=name)
    for x, name in ((-1.0, 'left'), (1.0, 'right'))])


def local(*forces):
    """Turn forces [N] and moments about x [N m] of the object frame into contact frames."""
    rows = np.array(forces, dtype=float)
    R = PAIR.rotations
    return np.column_stack([np.einsum('kij,ki->kj', R, rows[:, :3]), rows[:, 3] * R[:, 0, 2]])


def told(forces, wanted):
    found = measured_margin(PAIR, forces, wanted)
    return found, margin_message(HEADER, PAIR, found)


def test_share_in_use_and_the_change_by_hand():
    """4 N along y of 10 N possible; usage 0.8; at margin 0.5 each finger needs n = 8 N."""
    _, message = told(local([5, 2, 0, 0], [-5, 2, 0, 0]), 0.5)
    assert message.header == HEADER and message.result.code == ResultCode.OPTIMAL
    assert message.slip_margin == pytest.approx(0.2, abs=1e-6)
    assert wrench_array(message.applied_wrench, '') == pytest.approx([0, 4, 0, 0, 0, 0], abs=EXACT)
    assert message.load_alpha == pytest.approx(2.5, rel=1e-6)
    assert message.load_share == pytest.approx(0.4, rel=1e-6)
    assert message.wanted_margin == 0.5 and message.restorable
    assert message.largest_change == pytest.approx(3.0, abs=1e-3)
    assert [c.name for c in message.contacts] == ['left', 'right']
    assert [c.slip_margin for c in message.contacts] == pytest.approx([0.2, 0.2], abs=1e-6)
    left, right = (wrench_array(c.change, '') for c in message.contacts)
    assert left == pytest.approx([3, 0, 0, 0, 0, 0], abs=1e-3)
    assert right == pytest.approx([-3, 0, 0, 0, 0, 0], abs=1e-3)


def test_changes_of_moments_stand_along_the_normals():
    """The changes leave the wrench as it was and end inside the smaller cones."""
    forces = local([5, 1, 0, 0.4], [-5, 0, 1, 0.3])
    found, message = told(forces, 0.5)
    changes = np.array([wrench_array(c.change, '') for c in message.contacts])
    assert np.abs(changes[:, 3]).min() > 1e-3
    assert changes[:, 4:] == pytest.approx(np.zeros((2, 2)), abs=EXACT)
    total = np.append(changes[:, :3].sum(axis=0), (
        changes[:, 3:] + np.cross(PAIR.positions, changes[:, :3])).sum(axis=0))
    assert total == pytest.approx(np.zeros(6), abs=1e-5)
    after = forces + local(*changes[:, :4])
    friction = np.hypot(np.linalg.norm(after[:, :2], axis=1) / 0.5, after[:, 3] / 0.1)
    assert (friction <= 0.5 * after[:, 2] + 1e-5).all()
    assert message.largest_change == found.sizes.max()


def test_the_worst_contact_counts_and_margins_end_at_slip_of_everything():
    """A tangential force without any pressure is infinitely outside of its cone."""
    _, message = told(local([5, 1, 0, 0], [0, 3, 0, 0]), 0.2)
    assert message.slip_margin == -1.0
    assert [c.slip_margin for c in message.contacts] == pytest.approx([0.6, -1.0], abs=1e-6)


def test_a_margin_out_of_reach_changes_nothing():
    _, message = told(local([9, 4, 0, 0], [-9, 4, 0, 0]), 0.5)
    assert not message.restorable and message.largest_change == 0.0
    assert message.load_share == pytest.approx(0.8, rel=1e-6)
    assert len(message.contacts) == 2
    assert not any(wrench_array(c.change, '').any() for c in message.contacts)


def test_what_no_admissible_forces_apply_is_infeasible_and_says_where_to_look():
    """One finger that pulls."""
    alone = Grasp([Contact((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), name='alone')])
    found = measured_margin(alone, [[0.0, 0.0, -2.0, 0.0]])
    message = margin_message(HEADER, alone, found)
    assert message.result.code == ResultCode.INFEASIBLE
    assert 'check friction coefficients and sensors' in message.result.message
    assert message == GraspMargin(header=HEADER, result=message.result)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The page shows what the node says, and nothing of an answer when there is none."""

from geometry_msgs.msg import Pose, PoseArray, WrenchStamped
from grasp_quality_hand.viewer_heard import Heard
from grasp_quality_hand.viewer_picture import defaults_from, PARAMETERS, take_picture
from grasp_quality_hand.viewer_words import legend, number, status, table
from grasp_quality_msgs.msg import ContactForce, ContactForceArray, GraspQuality, ResultCode
from msg_adapters.contacts import ContactDefaults
from msg_adapters.force_map import force_map
import numpy as np
import pytest
from std_msgs.msg import Header

SIDES = {'left': -0.02, 'right': 0.02}
DEFAULTS = ContactDefaults(friction=0.5, names=tuple(SIDES))
HEADER = Header(frame_id='object')
NOW = 10.0


def pose(x):
    message = Pose()
    message.position.x = x
    message.orientation.y, message.orientation.w = -np.sign(x) * np.sqrt(0.5), np.sqrt(0.5)
    return message


def force(name, x):
    item = ContactForce(name=name, cone_usage=1.0)
    item.position.x, item.normal.x = x, -float(np.sign(x))
    item.wrench.force.x, item.wrench.force.z = -10.0 * float(np.sign(x)), 5.0
    return item


def heard(code=ResultCode.OPTIMAL, message=''):
    """Two fingers that can lift 2 N five times; the left one feels 4 N."""
    quality = GraspQuality(header=HEADER, result=ResultCode(code=code, message=message))
    quality.task_wrench.force.z = 2.0
    forces = ContactForceArray(header=HEADER)
    if code == ResultCode.OPTIMAL:
        quality.alpha, quality.limiting_contact, quality.holdable = 5.0, 'right', True
        forces.forces = [force(name, x) for name, x in SIDES.items()]
    felt = WrenchStamped(header=Header(frame_id='left'))
    felt.wrench.force.x, felt.wrench.force.z = 1.0, 4.0
    everything = Heard(
        quality=quality, forces=forces, measured={'left': (felt, NOW)},
        contacts=PoseArray(header=HEADER, poses=[pose(x) for x in SIDES.values()]),
        force_map=force_map(HEADER, 2, np.ones(8)))
    everything.freshness.note(NOW)
    return everything


def test_forces_of_the_answer_stand_beside_the_measured_ones():
    picture = take_picture(heard(), DEFAULTS, NOW)
    assert picture.grasp.names == ('left', 'right') and not picture.stale
    np.testing.assert_array_equal(picture.optimal, [[10.0, 0, 5.0], [-10.0, 0, 5.0]])
    np.testing.assert_allclose(picture.measured[0] @ [1.0, 0, 0], 4.0)
    assert picture.margins[0] == pytest.approx(1.0 - 1.0 / (0.5 * 4.0))
    assert np.isnan(picture.measured[1]).all() and np.isnan(picture.margins[1])
    np.testing.assert_array_equal(picture.alpha_task, [0, 0, 10.0, 0, 0, 0])
    assert picture.force_map.resolution == 2 and picture.metres_per_newton == 0.002


def test_silence_leaves_nothing_on_the_page():
    picture = take_picture(heard(), DEFAULTS, NOW + 0.9)
    assert picture.stale and picture.age == pytest.approx(0.9)
    assert picture.grasp is None and picture.force_map is None and picture.quality is None
    words = status(picture, '/grasp_quality')
    assert 'data-kind="stale"' in words and 'nothing heard for 0.9 s' in words
    assert 'no contacts' in table(picture)
    assert 'nothing was heard yet' in status(take_picture(Heard(), DEFAULTS, NOW), '/it')


@pytest.mark.parametrize('code, contacts', [
    (ResultCode.INFEASIBLE, 2), (ResultCode.INVALID_REQUEST, 2), (ResultCode.NO_CONTACTS, 0),
    (ResultCode.STALE_CONTACTS, 0), (ResultCode.SOLVER_FAILED, 2), (ResultCode.NOT_ACTIVE, 2)])
def test_a_failure_has_its_words_and_no_forces(code, contacts):
    picture = take_picture(heard(code, 'because <so>'), DEFAULTS, NOW)
    assert np.isnan(picture.optimal).all() and picture.force_map is None
    assert (0 if picture.grasp is None else len(picture.grasp)) == contacts
    assert not picture.alpha_task.any()
    words = status(picture, '/grasp_quality')
    assert 'data-kind="failure"' in words and 'because &lt;so&gt;' in words


def test_an_answer_in_words():
    words = status(take_picture(heard(), DEFAULTS, NOW), '/grasp_quality')
    assert 'alpha 5.000' in words and 'can apply 5 times the task, limited by right' in words
    weak = heard()
    weak.quality.alpha, weak.quality.holdable = 0.5, False
    words = status(take_picture(weak, DEFAULTS, NOW), '/grasp_quality')
    assert 'can only apply 0.5 times' in words and 'would not hold the load' in words
    weak.quality.alpha = 2e-25
    words = status(take_picture(weak, DEFAULTS, NOW), '/grasp_quality')
    assert 'can only apply 0 times' in words and 'e-25' not in words


def test_the_table_has_a_row_for_each_contact():
    picture = take_picture(heard(), DEFAULTS, NOW)
    rows = table(picture).split('<tr>')[2:]
    assert len(rows) == 2
    assert 'left' in rows[0] and '>10.00<' in rows[0] and '>4.00<' in rows[0]
    assert '>50<' in rows[0] and '>&ndash;<' in rows[1] and 'right<br>(limits)' in rows[1]
    assert '2 mm/N' in legend(picture) and '1 N in its best direction' in legend(picture)
    assert number(float('nan'), 2) == '&ndash;'


def test_a_contact_that_counts_not_has_no_force():
    partly = heard()
    partly.forces.forces = partly.forces.forces[1:]
    picture = take_picture(partly, DEFAULTS, NOW)
    assert np.isnan(picture.optimal[0]).all() and not np.isnan(picture.optimal[1]).any()


def test_without_contacts_the_forces_tell_where_they_act():
    blind = heard()
    blind.contacts = None
    picture = take_picture(blind, DEFAULTS, NOW)
    np.testing.assert_array_equal(picture.grasp.positions[:, 0], list(SIDES.values()))
    np.testing.assert_array_equal(picture.optimal[:, 2], 5.0)


def test_contacts_that_cannot_be_read_are_told():
    odd = heard()
    odd.contacts.poses.append(pose(0.03))
    picture = take_picture(odd, DEFAULTS, NOW)
    assert picture.grasp is None and 'contact_names' in picture.problem
    assert 'contact_names' in status(picture, '/grasp_quality')


def test_parameters_of_the_node_become_defaults():
    values = dict.fromkeys(PARAMETERS)
    values.update(contact_model='SFCE', friction_coefficient=0.7, max_normal_force=3.0,
                  torsional_friction_coefficient=0.01, contact_names=['a', 'b'])
    defaults = defaults_from(values)
    assert (defaults.friction, defaults.max_normal_force) == (0.7, 3.0)
    assert defaults.names == ('a', 'b') and defaults.fingers == ()

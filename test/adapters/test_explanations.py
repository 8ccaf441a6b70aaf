# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Explanations in messages: every number of the core in its field, and nothing of no answer."""

from adapter_messages import xyz
from grasp_quality import Contact, explain, Grasp, JointLimits, TaskWrench
from grasp_quality_msgs.msg import ResultCode
from grasp_quality_msgs.srv import Explain
from msg_adapters.explanations import fill_explanation
import numpy as np
import pytest

CAPS = (10.0, 3.0)
FIELDS = ('max_force', 'friction', 'position', 'rotation')


def pair(limits=None):
    """Return two fingers that face each other along x, the right one the weaker."""
    return Grasp([
        Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), friction=0.5, max_normal_force=cap, name=name)
        for x, cap, name in ((-1.0, CAPS[0], 'left'), (1.0, CAPS[1], 'right'))],
        joint_limits=limits)


def told(found):
    response = Explain.Response()
    fill_explanation(response, found)
    return response


def test_the_weaker_finger_of_a_pair_by_hand():
    """Alpha = 2 mu min(f) along y; a newton more for the weaker finger gives 2 mu more."""
    response = told(explain(pair(), TaskWrench([0, 1, 0, 0, 0, 0])))
    assert (response.result.code, response.result.message) == (ResultCode.OPTIMAL, '')
    assert response.alpha == pytest.approx(3.0, rel=1e-6)
    assert response.alpha_upper >= response.alpha
    assert (response.limiting_contact, response.limiting_reason) == ('right', 'slip')
    assert [c.name for c in response.contacts] == ['left', 'right']
    assert [c.limit for c in response.contacts] == ['', 'slip']
    assert (response.best_contact, response.best_kind, response.best_size) == (
        'right', 'max_force', 1.0)
    assert response.best_alpha == pytest.approx(4.0, rel=1e-6)
    assert not response.smooth
    assert (response.joints, list(response.joint_shares)) == ([], [])


@pytest.mark.parametrize('wrench', [[0.3, 1, 0.2, 0.1, 0.2, 0.1], [0, 1, 0, 0, 0, 0]])
def test_slopes_to_both_sides_stand_in_the_fields_of_their_names(wrench):
    grasp = Grasp([
        Contact((np.cos(a), np.sin(a), 0.1 * a), (-np.cos(a), -np.sin(a), 0.0), friction=0.6,
                max_normal_force=1.0 + a, name=f'finger {a}') for a in (0.0, 2.0, 4.0)])
    found = explain(grasp, TaskWrench(wrench))
    response = told(found)
    assert response.smooth == found.uniqueness.smooth and response.text == found.text
    assert [c.share for c in response.contacts] == found.shares.tolist()
    assert response.alpha == found.solution.alpha
    assert response.alpha_upper == found.solution.alpha_upper
    for i, item in enumerate(response.contacts):
        for field in FIELDS:
            for side, end in ((found.forward, ''), (found.backward, '_backward')):
                value = getattr(item, f'dalpha_d{field}{end}')
                value = value if isinstance(value, float) else xyz(value)
                assert value == getattr(side, field)[i].tolist()
    assert response.best_contact == found.best_change.contact
    assert response.best_size == found.best_change.size
    assert xyz(response.best_direction) == found.best_change.direction.tolist()


def test_a_joint_that_limits_is_told_by_name():
    """0.1 N m at 0.1 m is 1 N, so that the right finger's motor limits alpha to 2 mu 1 N."""
    matrix = np.zeros((2, 2, 4))
    matrix[0, 0, 2] = matrix[1, 1, 2] = 0.1
    limits = JointLimits(('strong', 'weak'), np.array([2.0, 0.1]), matrix, np.zeros(2))
    response = told(explain(pair(limits), TaskWrench([0, 1, 0, 0, 0, 0])))
    assert response.alpha == pytest.approx(1.0, rel=1e-6)
    assert response.joints == ['strong', 'weak']
    assert list(response.joint_shares) == pytest.approx([0.0, 1.0], abs=1e-5)
    assert (response.limiting_contact, response.limiting_reason) == ('weak', 'joint')


def test_a_pinned_alpha_that_nothing_changes_has_no_best_change():
    """No point contact turns the object about its own normal: the load alone decides alpha."""
    alone = Grasp([Contact((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), name='alone')])
    response = told(explain(alone, TaskWrench([0, 0, 0, 1, 0, 0]), [0, 0, 0, 1, 0, 0]))
    assert response.result.code == ResultCode.OPTIMAL
    assert response.result.message.startswith('alpha is pinned')
    assert response.alpha == pytest.approx(1.0, rel=1e-6)
    assert (response.best_contact, response.best_kind, response.best_size) == ('', '', 0.0)
    assert response.best_alpha == 0.0 and response.text


def test_of_an_infeasible_answer_only_the_result_is_told():
    found = explain(pair(), TaskWrench([0, 1, 0, 0, 0, 0]), [0, 0, -99, 0, 0, 0])
    response = told(found)
    assert response.result.code == ResultCode.INFEASIBLE and response.result.message
    assert response == Explain.Response(result=response.result)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The force bound: groups, gauge and support, which are dual to each other."""

from grasp_quality import InvalidGraspError
from grasp_quality.bounds import gauge, group_maxima, groups_of, support
import numpy as np
import pytest
from tolerances import EXACT

FINGERS = ('thumb', 'index', 'thumb', 'middle')


@pytest.mark.parametrize('bound, groups', [
    ('linf', (0, 1, 2, 3)), ('l1', (0, 0, 0, 0)), ('l2', (0, 0, 0, 0)),
    ('finger', (0, 1, 0, 2))])
def test_groups(bound, groups):
    assert groups_of(bound, FINGERS) == groups


def test_unknown_bound_lists_the_known_ones():
    with pytest.raises(InvalidGraspError, match=(
            r"^bound must be one of \['l1', 'l2', 'linf', 'finger'\], got 'l3'$")):
        groups_of('l3', FINGERS)


def test_finger_bound_says_which_contacts_have_no_finger():
    with pytest.raises(InvalidGraspError, match=(
            r"^bound 'finger' needs .* contacts \[1, 2\] have none: set Contact.finger, or use "
            "bound 'linf'$")):
        groups_of('finger', ['thumb', '', ''])


def test_group_maxima():
    assert group_maxima(np.array([1.0, 2.0, 3.0, -1.0]), (0, 1, 0, 2)).tolist() == [3.0, 2.0, -1.0]


@pytest.mark.parametrize('bound', ['l1', 'l2', 'linf', 'finger'])
def test_support_is_the_largest_work_inside_the_gauge(bound):
    rng = np.random.default_rng(1)
    groups = groups_of(bound, FINGERS)
    worth = rng.normal(size=4)
    most = support(worth, bound, groups)
    normals = rng.uniform(size=(2000, 4)) ** 3
    works = [n @ worth / gauge(n, bound, groups) for n in normals]
    assert max(works) <= most + EXACT
    assert max(works) >= 0.8 * most
    assert support(-np.abs(worth), bound, groups) == 0.0


def test_gauge_by_hand():
    shares = np.array([0.3, 0.4, 0.2, 0.1])
    expected = {'l1': 1.0, 'l2': np.sqrt(0.3), 'linf': 0.4, 'finger': 0.5}
    for bound, value in expected.items():
        assert gauge(shares, bound, groups_of(bound, FINGERS)) == pytest.approx(value, rel=EXACT)

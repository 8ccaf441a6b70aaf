# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What is no grasp, no task or no time limit is refused with the way out."""

import math

import grasp_quality as gq
from known_grasps import antipodal, FX, FY, FZ
import numpy as np
import pytest

TASK = gq.TaskWrench(FY)


@pytest.mark.parametrize('ask', [
    lambda g: gq.evaluate(g, TASK), lambda g: gq.minimum_forces(g, FY),
    lambda g: gq.hold_forces(g, FY), lambda g: gq.wrench_map(g, [FY]),
    lambda g: gq.slip_margin(g, np.zeros((2, 4))),
    lambda g: gq.measured_margin(g, np.zeros((2, 4))), lambda g: gq.explain(g, TASK),
    gq.ball_radius, lambda g: gq.ellipsoid_scale(g, gq.TaskEllipsoid(np.eye(6))), gq.volume,
    gq.grasp_indices, gq.force_closure, lambda g: gq.robust_alpha(g, TASK)])
def test_contacts_are_no_grasp_yet(ask):
    with pytest.raises(gq.InvalidGraspError, match=r'grasp must be a Grasp, got list: .*Grasp\('):
        ask([gq.Contact((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))])


def test_many_grasps_are_several_grasps():
    for grasps, words in ((antipodal(), r'give \[grasp\]'), ([antipodal(), None], r'grasps\[1\]'),
                          ([], 'at least one')):
        with pytest.raises(gq.InvalidGraspError, match=words):
            gq.evaluate_many(grasps, FY)


@pytest.mark.parametrize('limit', [math.nan, math.inf, 'soon'])
def test_a_time_limit_is_a_finite_number(limit):
    with pytest.raises(gq.InvalidTaskError, match='time_limit_s must be'):
        gq.evaluate(antipodal(), TASK, time_limit_s=limit)


def test_a_cone_solved_by_itself_claims_nothing_about_its_axis():
    cone = gq.TaskCone(FY, FX, FZ, 0.2)
    assert gq.explain(antipodal(), cone).solution.alpha_axis is None
    assert gq.evaluate(antipodal(), cone).alpha_axis == pytest.approx(1.0)

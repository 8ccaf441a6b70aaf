# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What is no grasp, no task or no time limit is refused with the way out."""

import math

import grasp_quality as gq
from grasp_quality.follow import follow
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest

TASK = gq.TaskWrench(FY)


@pytest.mark.parametrize('ask', [
    lambda g: gq.evaluate(g, TASK), lambda g: gq.minimum_forces(g, FY),
    lambda g: gq.hold_forces(g, FY), lambda g: gq.wrench_map(g, [FY]),
    lambda g: gq.slip_margin(g, np.zeros((2, 4))),
    lambda g: gq.measured_margin(g, np.zeros((2, 4))), lambda g: gq.explain(g, TASK),
    gq.ball_radius, lambda g: gq.ellipsoid_scale(g, gq.TaskEllipsoid(np.eye(6))), gq.volume,
    gq.grasp_indices, gq.force_closure,
    lambda g: gq.build_problem(g, TASK), lambda g: gq.robust_alpha(g, TASK)])
def test_contacts_are_no_grasp_yet(ask):
    with pytest.raises(gq.InvalidGraspError, match=r'grasp must be a Grasp, got list: .*Grasp\('):
        ask([gq.Contact((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))])


def test_many_grasps_are_several_grasps():
    for grasps, words in ((antipodal(), r'give \[grasp\]'), ([antipodal(), None], r'grasps\[1\]'),
                          ([], 'at least one')):
        with pytest.raises(gq.InvalidGraspError, match=words):
            gq.evaluate_many(grasps, FY)
    with pytest.raises(gq.InvalidGraspError, match='several, got int: give a list of Grasp'):
        gq.evaluate_many(5, FY)


@pytest.mark.parametrize('start', ['x', 5, [], {}, object(), TASK])
def test_a_search_starts_from_an_answer_or_from_nothing(start):
    pair = antipodal()
    kind = type(start).__name__
    with pytest.raises(gq.InvalidTaskError,
                       match=f'start must be a HoldForces, got {kind}: .*hold_forces, or leave'):
        gq.hold_forces(pair, 0.1 * FY, start=start)
    for reserve in (0.0, 0.1):
        with pytest.raises(gq.InvalidTaskError,
                           match=f'start must be a Solution, got {kind}: .*evaluate.*, or leave'):
            gq.evaluate(pair, TASK, alpha_reserve=reserve, start=start)


def test_a_problem_is_built_before_it_is_solved():
    with pytest.raises(gq.InvalidTaskError, match='must be a ConicProblem, got TaskWrench'):
        gq.solve(TASK)


@pytest.mark.parametrize('change, words', [
    ({'problem': TASK}, r'problem must be a ConicProblem, got TaskWrench: .*build_problem\('),
    ({'goal': 'x'}, r'goal must be a Solution, got str: .*evaluate\('),
    ({'goal': gq.evaluate(antipodal(), TASK, 9.0 * FX)}, 'goal .* all 2 .* got 0 .* INFEASIBLE: '),
    ({'goal': gq.evaluate(three_finger(), TASK)}, 'goal must have .* all 2 .* got 3 .*: give'),
    ({'forces': 'x'}, r'forces must be an array of \(2, 4\) numbers'),
    ({'forces': 1.0}, r'forces must have shape \(2, 4\)'),
    ({'forces': np.full((2, 4), math.nan)}, 'forces must be finite'),
    ({'allowed_change': math.nan}, 'allowed_change must be finite'),
    ({'allowed_change': -1.0}, 'allowed_change must be at least 0, got -1'),
    ({'time_limit': 'soon'}, 'time_limit_s must be a number')])
def test_what_cannot_be_followed_is_named(change, words):
    pair = antipodal()
    arguments = {'problem': gq.build_problem(pair, TASK), 'goal': gq.evaluate(pair, TASK),
                 'forces': np.zeros((2, 4)), 'allowed_change': 0.1}
    assert follow(**arguments, time_limit=20.0).limited
    with pytest.raises(gq.InvalidTaskError, match=words):
        follow(**{**arguments, **change})


@pytest.mark.parametrize('subspace', ['both', [], {}, None])
def test_a_subspace_is_one_of_the_names(subspace):
    for ask in (gq.ball_radius, gq.volume):
        with pytest.raises(gq.InvalidTaskError, match='subspace must be one of'):
            ask(antipodal(), subspace=subspace)


def test_joint_names_are_a_list():
    with pytest.raises(gq.InvalidGraspError, match='joint names must be a list, got 5'):
        gq.JointLimits(5, [1.0], np.ones((1, 2, 4)))


@pytest.mark.parametrize('limit', [math.nan, math.inf, 'soon'])
def test_a_time_limit_is_a_finite_number(limit):
    with pytest.raises(gq.InvalidTaskError, match='time_limit_s must be'):
        gq.evaluate(antipodal(), TASK, time_limit_s=limit)


def test_a_cone_solved_by_itself_claims_nothing_about_its_axis():
    cone = gq.TaskCone(FY, FX, FZ, 0.2)
    assert gq.explain(antipodal(), cone).solution.alpha_axis is None
    assert gq.evaluate(antipodal(), cone).alpha_axis == pytest.approx(1.0)

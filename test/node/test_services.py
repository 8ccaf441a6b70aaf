# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The services, asked about contacts in the request: closed forms, forces, sensitivities."""

import math

from builtin_interfaces.msg import Time
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import Contact, ResultCode
from grasps import (
    ANTIPODAL, check_forces, CIRCLE, contact_array, EIGHT, numbers, SINGLE, SOLVER, total_wrench,
    wrench)
import numpy as np
import pytest

SQRT3 = math.sqrt(3.0)
GRAVITY = wrench(fz=-3.0)


@pytest.fixture(scope='module')
def client(start):
    return start().client


def evaluate(client, poses, task, **fields):
    contacts = fields.pop('contacts', contact_array(poses))
    return client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench', contacts=contacts,
                       task_wrench=task, **fields)


@pytest.mark.parametrize('poses, task, alpha', [
    (ANTIPODAL, wrench(fx=1.0), 10.0), (ANTIPODAL, wrench(fy=1.0), 10.0),
    (ANTIPODAL, wrench(fz=-2.0), 5.0), (ANTIPODAL, wrench(tx=1.0), 0.0),
    (CIRCLE, wrench(fx=1.0), 10.0), (CIRCLE, wrench(fx=-1.0), 10.0 + 5.0 * SQRT3),
    (CIRCLE, wrench(fz=1.0), 15.0), (EIGHT, wrench(fx=1.0), 40.0),
    (EIGHT, wrench(fy=1.0), 40.0), (SINGLE, wrench(fx=1.0), 10.0), (SINGLE, wrench(fx=-1.0), 0.0)])
def test_task_wrench_has_its_closed_form(client, poses, task, alpha):
    answer = evaluate(client, poses, task)
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.alpha == pytest.approx(alpha, rel=SOLVER, abs=1e-7)
    assert answer.alpha <= answer.alpha_upper <= answer.alpha + 1e-5
    assert ("0 (to the solver's accuracy)" in answer.result.message) == (alpha == 0.0)
    assert (answer.limiting_contact == '') == (alpha == 0.0)
    assert 'external wrench' not in answer.result.message
    assert (answer.alpha_lower, answer.holdable) == (0.0, True)
    assert 0.0 < answer.solve_time.sec + 1e-9 * answer.solve_time.nanosec < 1.0


def test_forces_apply_the_task_inside_their_cones(client):
    contacts = contact_array(CIRCLE, Time(sec=12, nanosec=34), name=['a', 'b', 'c'])
    task = wrench(-1.0, 0.5, 2.0, 0.1, -0.2, 0.3)
    answer = evaluate(client, CIRCLE, task, contacts=contacts, external_wrench=GRAVITY)
    np.testing.assert_allclose(
        total_wrench(answer.forces) + numbers(GRAVITY), answer.alpha * numbers(task), atol=1e-6)
    check_forces(answer.forces)
    assert [item.name for item in answer.forces.forces] == ['a', 'b', 'c']
    assert answer.forces.header.stamp == Time(sec=12, nanosec=34)
    assert answer.forces.header.frame_id == 'object'
    assert answer.limiting_contact in ('a', 'b', 'c')


@pytest.mark.parametrize('names', [['left', 'right'], ['right', 'left']])
def test_of_contacts_that_limit_alike_the_first_is_named(client, names):
    contacts = contact_array(ANTIPODAL, name=names)
    answer = evaluate(client, ANTIPODAL, wrench(fy=1.0), contacts=contacts)
    assert answer.limiting_contact == names[0]
    told = client.call(srv.Explain, 'explain', contacts=contacts, task_wrench=wrench(fy=1.0))
    assert told.limiting_contact == names[0]
    assert [c.share for c in told.contacts] == pytest.approx([0.5, 0.5], rel=1e-3)


def test_the_sensitivity_agrees_with_a_small_change_of_the_load(client):
    task = wrench(fy=1.0)
    slope = numbers(evaluate(client, ANTIPODAL, task, external_wrench=GRAVITY)
                    .dalpha_dexternal_wrench)
    step = 1e-3
    higher, lower = (evaluate(client, ANTIPODAL, task, external_wrench=wrench(fz=-3.0 + change))
                     .alpha for change in (step, -step))
    assert slope[2] == pytest.approx((higher - lower) / (2 * step), rel=1e-4)
    assert slope[2] == pytest.approx(3.0 / math.sqrt(91.0), rel=1e-4)  # alpha = sqrt(100 - fz^2)


def test_a_load_beyond_the_grasp_is_infeasible(client):
    answer = evaluate(client, ANTIPODAL, wrench(fy=1.0), external_wrench=wrench(fz=-10.1))
    assert answer.result.code == ResultCode.INFEASIBLE and answer.result.message
    assert (answer.alpha, answer.alpha_upper, answer.holdable) == (0.0, 0.0, False)
    assert not answer.forces.forces and not numbers(answer.dalpha_dexternal_wrench).any()


def test_an_interval_that_does_not_hold_the_load_by_itself(client):
    """One finger pushes 10 N up: at a load of 3 N up, alpha down must be at least 3."""
    up = contact_array(SINGLE)
    answer = evaluate(client, SINGLE, wrench(fx=1.0), contacts=up, external_wrench=wrench(fx=3.0))
    assert answer.result.code == ResultCode.OPTIMAL
    assert (answer.alpha_lower, answer.alpha) == pytest.approx((3.0, 13.0), rel=1e-5)
    assert not answer.holdable


@pytest.mark.parametrize('tilt', [0, 20])
def test_task_cone_of_the_paper(client, tilt):
    """Fig. 5: the wrench reached stays along -x, whatever the tilt of the axis."""
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    answer = client.call(
        srv.EvaluateTaskCone, 'evaluate_task_cone', contacts=contact_array(CIRCLE),
        axis=wrench(-c, s), lateral_x=wrench(s, c), lateral_y=wrench(fz=1.0),
        half_angle=math.radians(60))
    assert answer.result.code == ResultCode.OPTIMAL
    np.testing.assert_allclose(
        numbers(answer.optimal_wrench), [-10 - 5 * SQRT3, 0, 0, 0, 0, 0], atol=1e-3)
    assert answer.alpha == pytest.approx((10 + 5 * SQRT3) * c, rel=SOLVER)
    assert answer.alpha <= answer.alpha_upper <= answer.alpha * (1 + 1e-5)
    assert answer.alpha_worst <= answer.alpha_axis * (1 + SOLVER)
    assert answer.alpha_axis <= answer.alpha * (1 + SOLVER)
    np.testing.assert_allclose(
        total_wrench(answer.forces), numbers(answer.optimal_wrench), atol=1e-6)
    check_forces(answer.forces)


def test_task_polytope_and_what_it_does_not_guarantee(client):
    """Counter-example to eq. (19): both alphas are 1, the corner is held at 1 / sqrt(2)."""
    contacts = contact_array(ANTIPODAL, max_normal_force=[1.0, 1.0])
    tasks = [wrench(fy=1.0), wrench(fz=1.0)]
    answer = client.call(srv.EvaluateTaskPolytope, 'evaluate_task_polytope', contacts=contacts,
                         task_wrenches=tasks, weights=[1.0, 3.0])
    assert answer.result.code == ResultCode.OPTIMAL
    np.testing.assert_allclose(answer.alphas, [1, 1], rtol=SOLVER)
    assert answer.quality == pytest.approx(4.0, rel=SOLVER)
    assert answer.alpha_min == pytest.approx(1.0, rel=SOLVER)
    assert answer.parallelotope_scale == pytest.approx(math.sqrt(0.5), rel=SOLVER)
    for task, alpha, forces in zip(tasks, answer.alphas, answer.forces):
        np.testing.assert_allclose(total_wrench(forces), alpha * numbers(task), atol=1e-6)


def test_minimum_forces_carry_the_load(client):
    """Two fingers with mu = 0.5 hold 3 N with 3 N each."""
    answer = client.call(srv.MinimumForces, 'minimum_forces', contacts=contact_array(ANTIPODAL),
                         external_wrench=GRAVITY)
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.peak == pytest.approx(0.3, rel=SOLVER)
    np.testing.assert_allclose(total_wrench(answer.forces), -numbers(GRAVITY), atol=1e-6)
    check_forces(answer.forces, cap=3.0 * (1 + 1e-5))


def test_minimum_forces_without_a_load_are_zero(client):
    answer = client.call(srv.MinimumForces, 'minimum_forces', contacts=contact_array(ANTIPODAL))
    assert (answer.result.code, answer.peak) == (ResultCode.OPTIMAL, 0.0)
    assert not total_wrench(answer.forces).any()


@pytest.mark.parametrize('load, peak, words', [
    (wrench(fz=-12.0), 1.2, '1.2 times the caps'), (wrench(tx=1.0), 0.0, '(1, 0, 0) N m')])
def test_minimum_forces_say_how_much_is_missing(client, load, peak, words):
    answer = client.call(srv.MinimumForces, 'minimum_forces', contacts=contact_array(ANTIPODAL),
                         external_wrench=load)
    assert answer.result.code == ResultCode.INFEASIBLE and words in answer.result.message
    assert answer.peak == pytest.approx(peak, rel=SOLVER) and not answer.forces.forces


def test_wrench_map_of_given_directions(client):
    directions = [wrench(fx=1.0), wrench(fx=-1.0), wrench(fz=2.0)]
    answer = client.call(srv.WrenchMap, 'wrench_map', contacts=contact_array(CIRCLE),
                         directions=directions)
    assert answer.result.code == ResultCode.OPTIMAL
    np.testing.assert_allclose(answer.alphas, [10, 10 + 5 * SQRT3, 7.5], rtol=SOLVER)
    assert answer.directions == directions


@pytest.mark.parametrize('resolution, count', [(0, 2592), (3, 18)])
def test_wrench_map_of_its_own_grid(client, resolution, count):
    """Antipodal pair: a force x along it and t across reaches 10 / (x + t)."""
    answer = client.call(srv.WrenchMap, 'wrench_map', contacts=contact_array(ANTIPODAL),
                         resolution=resolution)
    assert answer.result.code == ResultCode.OPTIMAL
    assert len(answer.alphas) == len(answer.directions) == count
    for direction, alpha in list(zip(answer.directions, answer.alphas))[::7]:
        force = numbers(direction)
        assert np.linalg.norm(force[:3]) == pytest.approx(1.0) and not force[3:].any()
        x, t = abs(force[0]), math.hypot(force[1], force[2])
        # each finger takes half of t, also the one that presses with 10 - alpha x
        assert alpha == pytest.approx(10.0 / (x + t), rel=SOLVER)


def test_contacts_bring_their_own_models_and_caps(client):
    """A soft finger turns 2 gamma F about x, a frictionless one nothing sideways."""
    soft = contact_array(ANTIPODAL, model=[Contact.MODEL_SFCE] * 2,
                         torsional_friction_coefficient=[0.01] * 2, max_normal_force=[4.0] * 2)
    answer = evaluate(client, ANTIPODAL, wrench(tx=1.0), contacts=soft)
    assert answer.alpha == pytest.approx(0.08, rel=SOLVER)
    smooth = contact_array(ANTIPODAL, model=[Contact.MODEL_FPC] * 2)
    answer = evaluate(client, ANTIPODAL, wrench(fy=1.0), contacts=smooth)
    assert answer.alpha == pytest.approx(0.0, abs=1e-7)
    slippery = contact_array(ANTIPODAL, friction_coefficient=[0.1, 0.1])
    answer = evaluate(client, ANTIPODAL, wrench(fy=1.0), contacts=slippery)
    assert answer.alpha == pytest.approx(2.0, rel=SOLVER)

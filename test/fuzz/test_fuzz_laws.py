# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The laws of alpha on grasps that hypothesis looks for, with load and joint limits.

``test/core/test_laws.py`` has them on fixed random grasps of many contacts.
"""

from answer_checks import check_forces, check_task_wrench
from grasp_quality import Grasp, JointLimits, minimum_forces, SolverError, Status
from grasp_quality.wrench import transform
from hypothesis import given, reject, settings, strategies as st
from laws import (
    alpha, changed, close, contacts, grasps, load_within, natural, part, points, rotations, solved,
    wrenches)
import numpy as np
import pytest
from tolerances import SOLVER

settings.load_profile('the same every time')
few = settings(max_examples=25)
factors = st.floats(0.01, 100.0)


@few
@given(st.data(), grasps(), wrenches)
def test_an_answer_holds_by_its_own_forces_and_multipliers(data, grasp, wrench):
    load = load_within(data.draw, grasp)
    answer = solved(grasp, wrench, external_wrench=load)
    if grasp.joint_limits is None:
        check_task_wrench(answer, wrench, load)
        assert answer.feasible
    elif answer.feasible:
        check_forces(grasp, answer.forces, answer.alpha * wrench, load)
        assert grasp.joint_limits.usage(answer.forces).max() <= 1.0 + SOLVER
        low, high = answer.alpha_interval
        assert 0.0 <= low <= high <= answer.alpha_upper


@few
@given(st.data(), grasps(), wrenches, factors)
def test_all_forces_times_c_gives_alpha_times_c(data, grasp, wrench, c):
    load = load_within(data.draw, grasp)
    limits = grasp.joint_limits and grasp.joint_limits.scaled(c)
    larger = changed(grasp, limits, max_normal_force=lambda x: c * x.max_normal_force)
    size = c * natural(grasp, wrench)
    assert alpha(larger, wrench, c * load) == close(c * alpha(grasp, wrench, load), size)


@few
@given(st.data(), grasps(), wrenches, factors)
def test_all_lengths_times_c_changes_nothing(data, grasp, wrench, c):
    load = load_within(data.draw, grasp)
    longer = np.repeat([1.0, c], 3)
    limits = grasp.joint_limits and JointLimits(
        grasp.joint_limits.names, c * grasp.joint_limits.max_torques,
        grasp.joint_limits.torque_matrix * [c, c, c, 1.0],
        c * grasp.joint_limits.gravity_torques)
    larger = changed(grasp, limits, position=lambda x: c * x.position,
                     torsional_friction=lambda x: c * x.torsional_friction)
    assert alpha(larger, longer * wrench, longer * load) == close(
        alpha(grasp, wrench, load), natural(grasp, wrench))


@few
@given(st.data(), grasps(), wrenches, rotations, points)
def test_a_rigid_motion_of_everything_changes_nothing(data, grasp, wrench, R, p):
    load = load_within(data.draw, grasp)
    p = 3.0 * np.array(p)
    moved = changed(grasp, position=lambda c: R @ c.position + p,
                    rotation=lambda c: R @ c.rotation)
    before = solved(grasp, wrench, external_wrench=load)
    after = solved(moved, transform(wrench, R, p), external_wrench=transform(load, R, p))
    assert after.status is before.status
    assert after.alpha == close(before.alpha, natural(grasp, wrench))
    assert after.alpha_lower == close(before.alpha_lower, natural(grasp, wrench))


@few
@given(st.data(), grasps(), wrenches)
def test_the_order_of_contacts_changes_nothing(data, grasp, wrench):
    load = load_within(data.draw, grasp)
    order = data.draw(st.permutations(range(len(grasp))))
    limits = grasp.joint_limits and grasp.joint_limits.subset(order)
    other = Grasp([grasp.contacts[i] for i in order], grasp.bound, limits)
    assert alpha(other, wrench, load) == close(
        alpha(grasp, wrench, load), natural(grasp, wrench))


@few
@given(st.data(), grasps(bounds=('linf',), limited=False), wrenches, contacts())
def test_one_more_contact_never_lowers_alpha_under_linf(data, grasp, wrench, another):
    load = load_within(data.draw, grasp)
    more = Grasp([*grasp.contacts, another], 'linf')
    size = natural(grasp, wrench)
    assert alpha(more, wrench, load) >= alpha(grasp, wrench, load) * (1.0 - 4.0 * SOLVER) - (
        0.02 * SOLVER * size)


@few
@given(st.data(), grasps(), wrenches)
def test_the_order_of_the_bounds(data, grasp, wrench):
    load = load_within(data.draw, grasp)
    slack = 0.02 * SOLVER * natural(grasp, wrench)

    def under(bound, external=load):
        return alpha(Grasp(grasp.contacts, bound, grasp.joint_limits), wrench, external)

    l1, l2, finger, linf = (under(bound) for bound in ('l1', 'l2', 'finger', 'linf'))
    for less, more in ((l1, l2), (l2, linf), (l1, finger), (finger, linf)):
        assert less <= more * (1.0 + 4.0 * SOLVER) + slack
    if grasp.joint_limits is None:
        assert under('linf', None) <= len(grasp) * under('l1', None) * (1.0 + 4.0 * SOLVER) + slack


@few
@given(grasps(limited=False), wrenches)
def test_alpha_times_the_smallest_peak_is_one(grasp, wrench):
    found = alpha(grasp, wrench)
    try:
        held = minimum_forces(grasp, -wrench)
    except SolverError:
        reject()
    if found > 1e-3 * natural(grasp, wrench):
        assert found * held.peak == pytest.approx(1.0, rel=10.0 * SOLVER)
    else:
        assert not held.peak < 1.0 / (found + 1e-5 * natural(grasp, wrench))


@few
@given(st.data(), grasps(), wrenches, st.floats(1.0, 5.0))
def test_more_friction_never_lowers_alpha(data, grasp, wrench, factor):
    load = load_within(data.draw, grasp)
    rougher = changed(grasp, friction=lambda c: factor * c.friction,
                      torsional_friction=lambda c: factor * c.torsional_friction)
    assert alpha(rougher, wrench, load) >= alpha(grasp, wrench, load) * (1.0 - 4.0 * SOLVER) - (
        0.02 * SOLVER * natural(grasp, wrench))


@few
@given(grasps(), wrenches, wrenches, st.floats(0.0, 1.0))
def test_inverse_alpha_is_convex_in_the_direction(grasp, first, second, t):
    middle = (1.0 - t) * first + t * second
    ends = alpha(grasp, first), alpha(grasp, second)
    if np.abs(middle).max() < 1e-3 or min(ends) < 1e-3 * natural(grasp, first):
        return
    assert 1.0 / alpha(grasp, middle) <= (
        (1.0 - t) / ends[0] + t / ends[1]) * (1.0 + 10.0 * SOLVER)


@few
@given(st.data(), grasps(), wrenches, st.floats(0.0, 3.0))
def test_a_load_along_the_task_adds_to_alpha(data, grasp, wrench, more):
    """From G x + F_ext = alpha F follows G x + F_ext + c F = (alpha + c) F."""
    load, size = load_within(data.draw, grasp), natural(grasp, wrench)
    before = solved(grasp, wrench, external_wrench=load)
    after = solved(grasp, wrench, external_wrench=load + more * size * wrench)
    if before.feasible:
        assert after.feasible
        assert after.alpha == close(before.alpha + more * size, size)


@few
@given(grasps(limited=True), wrenches, st.floats(1.0, 10.0))
def test_stronger_joints_never_lower_alpha(grasp, wrench, factor):
    own = grasp.joint_limits
    stronger = JointLimits(
        own.names, factor * own.max_torques, own.torque_matrix, own.gravity_torques)
    slack = 0.02 * SOLVER * natural(grasp, wrench)
    weak, strong, free = (alpha(Grasp(grasp.contacts, grasp.bound, limits), wrench)
                          for limits in (own, stronger, None))
    assert weak <= strong * (1.0 + 4.0 * SOLVER) + slack
    assert strong <= free * (1.0 + 4.0 * SOLVER) + slack


@few
@given(grasps(limited=False), wrenches, part)
def test_what_is_infeasible_has_no_forces_and_no_number(grasp, wrench, spread):
    load = (10.0 + spread) * grasp.max_normal_forces.sum() * wrench[::-1]
    answer = solved(grasp, wrench, external_wrench=load)
    if answer.status is Status.INFEASIBLE:
        assert (answer.alpha, answer.alpha_upper, len(answer.forces)) == (0.0, 0.0, 0)
        assert not answer.holdable
    else:
        check_task_wrench(answer, wrench, load)

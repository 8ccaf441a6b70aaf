# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Derivatives of alpha against central differences, on random grasps away from kinks."""

import dataclasses

from benchmarks.random_grasps import BOUNDS, random_grasp, random_joint_limits, random_load
from grasp_quality import Contact, ContactModel, evaluate, Grasp, JointLimits, TaskWrench
from known_grasps import antipodal, FX, FY, single, three_finger, TX
import numpy as np
import pytest
from tolerances import SOLVER

STEP = 2e-5
AGREEMENT = 2e-4  # of the largest derivative: solver tolerance over step


def problem(seed, bound):
    """Grasp, task and load of a seed."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=int(rng.integers(5, 9)), bound=bound)
    return grasp, TaskWrench(grasp.wrench(
        rng.uniform(0.3, 1.0, (len(grasp), 4)) * [0.2, 0.2, 1.0, 0.2] * grasp.scales)), (
            random_load(rng, grasp))


def central(f, size=1.0):
    """Central difference of f(step) at zero."""
    return (f(STEP * size) - f(-STEP * size)) / (2.0 * STEP * size)


def with_field(grasp, i, field, step):
    """Return the grasp with a field of contact i changed by a step."""
    contacts = list(grasp.contacts)
    contacts[i] = dataclasses.replace(
        contacts[i], normal=None, **{field: getattr(contacts[i], field) + step})
    return Grasp(contacts, grasp.bound, grasp.joint_limits)


def with_torque(grasp, j, step):
    """Return the grasp with the limit of joint j changed by a step."""
    limits = grasp.joint_limits
    return dataclasses.replace(grasp, joint_limits=dataclasses.replace(
        limits, max_torques=limits.max_torques + step * np.eye(len(limits))[j]))


@pytest.mark.parametrize('seed', range(5))
@pytest.mark.parametrize('bound', BOUNDS)
def test_derivatives_agree_with_central_differences(bound, seed):
    grasp, task, load = problem(seed, bound)
    solution = evaluate(grasp, task, external_wrench=load)
    assert solution.alpha > 1e-3

    def alpha(g, w):
        return evaluate(g, task, external_wrench=w).alpha

    found = np.concatenate([
        solution.dalpha_dexternal_wrench, solution.dalpha_dmax_force, solution.dalpha_dfriction])
    expected = [central(lambda h: alpha(grasp, load + h * axis)) for axis in np.eye(6)]
    for field in ('max_normal_force', 'friction'):
        expected += [central(lambda h: alpha(with_field(grasp, i, field, h), load))
                     for i in range(len(grasp))]
    assert found == pytest.approx(np.array(expected), abs=AGREEMENT * np.abs(found).max())


@pytest.mark.parametrize('seed', range(5))
@pytest.mark.parametrize('bound', BOUNDS)
def test_derivatives_with_joint_limits_agree_with_central_differences(bound, seed):
    grasp, task, load = problem(seed, bound)
    grasp = dataclasses.replace(grasp, joint_limits=random_joint_limits(
        np.random.default_rng(seed), grasp, tightness=1.0))
    solution = evaluate(grasp, task, external_wrench=load)
    assert solution.alpha > 1e-3

    def alpha(g, w):
        return evaluate(g, task, external_wrench=w).alpha

    found = np.concatenate([
        solution.dalpha_dexternal_wrench, solution.dalpha_dmax_force, solution.dalpha_dfriction,
        solution.dalpha_dmax_torque])
    expected = [central(lambda h: alpha(grasp, load + h * axis)) for axis in np.eye(6)]
    for field in ('max_normal_force', 'friction'):
        expected += [central(lambda h: alpha(with_field(grasp, i, field, h), load))
                     for i in range(len(grasp))]
    expected += [central(lambda h: alpha(with_torque(grasp, j, h), load), 0.1)
                 for j in range(len(grasp.joint_limits))]
    assert found == pytest.approx(np.array(expected), abs=AGREEMENT * np.abs(found).max())
    assert (solution.limiting_reason == 'joint') == (
        solution.limiting_contact in grasp.joint_limits.names)


def test_antipodal_pair_by_hand():
    solution = evaluate(antipodal(0.5), TaskWrench(FY))
    assert solution.dalpha_dexternal_wrench @ FY == pytest.approx(1.0, rel=SOLVER)
    # alpha = 2 mu f: each finger's friction gives n, both caps together 2 mu
    assert solution.dalpha_dfriction.sum() == pytest.approx(2.0, rel=SOLVER)
    assert solution.dalpha_dmax_force.sum() == pytest.approx(2 * 0.5, rel=SOLVER)
    assert solution.limiting_reason == 'slip'


def test_weaker_finger_limits_a_push():
    solution = evaluate(antipodal(0.5, caps=(1.0, 0.3)), TaskWrench(-FX))
    assert solution.limiting_contact == 'right'
    assert solution.limiting_reason == 'cap'
    assert solution.dalpha_dmax_force == pytest.approx([0.0, 1.0], abs=SOLVER)


def test_weaker_finger_limits_a_lift():
    solution = evaluate(antipodal(0.5, caps=(1.0, 0.3)), TaskWrench(FY))
    assert solution.limiting_contact == 'right'
    assert solution.limiting_reason == 'slip'


@pytest.mark.parametrize('task', [FY, FY + 0.3 * FX])
def test_what_is_alike_is_told_together_in_any_order(task):
    """Two fingers share a lift; the solver's rounding must not choose between them."""
    pair = antipodal(0.5)
    for contacts in (list(pair.contacts), list(pair.contacts)[::-1]):
        solution = evaluate(Grasp(contacts), TaskWrench(task))
        assert set(solution.limited_by) <= {'left', 'right'}
        assert solution.limiting_contact == next(iter(solution.limited_by))
    assert evaluate(pair, TaskWrench(FY)).limited_by == {'left': 'slip', 'right': 'slip'}
    assert evaluate(pair, TaskWrench(FY)).limiting_contact == 'left'


def test_ties_are_told_in_the_order_of_the_contacts_and_joints_last():
    """What limits alike is named in an order that the user chose, whatever the solver says."""
    pair = list(antipodal(0.5).contacts)
    for contacts in (pair, pair[::-1]):
        solution = evaluate(Grasp(contacts), TaskWrench(FY))
        assert list(solution.limited_by) == [c.name for c in contacts]
        assert solution.limiting_contact == contacts[0].name
        presses = np.zeros((1, 2, 4))
        presses[0, [c.name for c in contacts].index('right'), 2] = 0.1
        knuckle = JointLimits(['a knuckle'], [0.1], presses)  # as strong as the caps, 1 N
        tie = evaluate(Grasp(contacts, 'linf', knuckle), TaskWrench(FY)).limited_by
        assert list(tie) == [n for n in (*(c.name for c in contacts), 'a knuckle') if n in tie]


@pytest.mark.parametrize('seed', range(8))
def test_a_tighter_limit_takes_its_part_of_alpha_or_more(seed):
    """Alpha is concave in the caps, at kinks too: what is said to limit does."""
    grasp, task, load = problem(seed, 'linf')
    if seed % 2:
        grasp, task, load = three_finger(0.5), TaskWrench(FY + 0.2 * seed * FX), None
    solution = evaluate(grasp, task, external_wrench=load)
    assert solution.limited_by
    for name in solution.limited_by:
        i = grasp.names.index(name)
        for share in (0.05, 0.5):
            step = -share * grasp.max_normal_forces[i]
            tighter = evaluate(
                with_field(grasp, i, 'max_normal_force', step), task, external_wrench=load)
            assert tighter.alpha <= solution.alpha + solution.dalpha_dmax_force[i] * step + (
                SOLVER * solution.size)


@pytest.mark.parametrize('force, length', [(1.0, 1.0), (1e-3, 1e-3), (1e3, 10.0)])
@pytest.mark.parametrize('size', [1e-6, 1.0, 1e6])
def test_powerless_is_what_applies_nothing_in_any_units(force, length, size):
    pair = antipodal(0.5, caps=(force, force), reach=length)
    for wrench, powerless, pinned in ((TX, True, True), (FY, False, False)):
        solution = evaluate(pair, TaskWrench(size * wrench))
        assert (solution.powerless, solution.pinned) == (powerless, pinned)
        assert bool(solution.remark) == powerless == (not solution.limited_by)
        assert 'external wrench' not in solution.remark
    away = evaluate(single(cap=force), TaskWrench(-size * FX))
    assert away.powerless and not away.pinned and 'apply any' in away.remark


def test_an_alpha_of_the_load_alone_is_pinned_and_not_powerless():
    solution = evaluate(antipodal(0.5), TaskWrench(TX), external_wrench=0.3 * TX)
    assert not solution.powerless and 'external wrench alone decides' in solution.remark
    infeasible = evaluate(single(), TaskWrench(FX), external_wrench=-2.0 * FX)
    assert not infeasible.powerless and infeasible.remark == ''


def test_nothing_limits_where_nothing_helps():
    solution = evaluate(single(), TaskWrench(FY))
    assert solution.limiting_contact == '' and solution.limiting_reason == ''


def test_caps_alone_fix_alpha_by_eulers_rule():
    """Alpha is homogeneous of degree one in the caps and the load together."""
    for bound in BOUNDS:
        grasp, task, load = problem(11, bound)
        solution = evaluate(grasp, task, external_wrench=load)
        euler = (solution.dalpha_dmax_force @ grasp.max_normal_forces
                 + solution.dalpha_dexternal_wrench @ load)
        assert euler == pytest.approx(solution.alpha, rel=1e-5)


def test_frictionless_contact_gains_from_its_first_friction_unless_its_model_has_none():
    """At mu = 0 the derivative is one-sided: the force is not at the edge but at the tip."""
    plain = tuple(three_finger(0.5).contacts)
    for model, gains in ((ContactModel.PCWF, True), (ContactModel.FPC, False)):
        smooth = dataclasses.replace(plain[0], normal=None, model=model, friction=0.0)
        solution = evaluate(Grasp([smooth, *plain[1:]]), TaskWrench(-FX + 0.2 * FY))
        forward = 0.0
        if gains:
            rough = dataclasses.replace(smooth, normal=None, friction=1e-4)
            forward = (evaluate(Grasp([rough, *plain[1:]]), TaskWrench(-FX + 0.2 * FY)).alpha
                       - solution.alpha) / 1e-4
        assert solution.dalpha_dfriction[0] == pytest.approx(forward, abs=1e-3)


def test_infeasible_has_no_sensitivity():
    solution = evaluate(single(), TaskWrench(FX), external_wrench=-2.0 * FX)
    assert not solution.dalpha_dexternal_wrench.any()
    assert not solution.dalpha_dmax_force.any()
    assert not solution.dalpha_dfriction.any()
    assert solution.limiting_contact == ''


def test_names_of_contacts_without_a_name():
    grasp = Grasp([Contact(position=(0, 0, 0), normal=(1, 0, 0))])
    assert evaluate(grasp, TaskWrench(FX)).limiting_contact == 'contact_0'

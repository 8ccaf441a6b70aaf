# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Joint limits: closed forms, laws, and what is refused."""

import dataclasses

from benchmarks.random_grasps import BOUNDS, random_grasp, random_joint_limits, random_load
from grasp_quality import (
    evaluate, evaluate_many, force_closure, GraspSet, hold_forces, InvalidGraspError, JointLimits,
    minimum_forces, robust_alpha, Status, TaskWrench, wrench_map)
from grasp_quality.proof import JOINT_TOLERANCE
from known_grasps import antipodal, FX, FY, single
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER

RIGHT_PRESSES = np.array([[[0, 0, 0, 0], [0, 0, 0.1, 0]]])  # one joint, lever arm 0.1 m


def limited(grasp, *arguments):
    """Return the grasp with joint limits."""
    return dataclasses.replace(grasp, joint_limits=JointLimits(*arguments))


def random_problem(seed, bound='linf', **options):
    """Grasp with joint limits, a task in its reach, a load that it holds without them."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=int(rng.integers(3, 9)), bound=bound)
    load = random_load(rng, grasp)
    limits = random_joint_limits(rng, grasp, **options)
    return dataclasses.replace(grasp, joint_limits=limits), TaskWrench(-random_load(rng, grasp)), (
        load)


def test_a_weak_motor_caps_a_push():
    """-x: the right finger pushes with n = (tau_max - tau_g) / 0.1."""
    for gravity, reached in ((0.0, 0.3), (0.01, 0.2), (-0.01, 0.4)):
        solution = evaluate(
            limited(antipodal(), ['knuckle'], [0.03], RIGHT_PRESSES, [gravity]), TaskWrench(-FX))
        assert solution.alpha == pytest.approx(reached, rel=SOLVER)
        assert solution.joint_torques == pytest.approx([0.03], rel=SOLVER)
        assert solution.dalpha_dmax_torque == pytest.approx([10.0], rel=SOLVER)
        assert (solution.limiting_contact, solution.limiting_reason) == ('knuckle', 'joint')


def test_a_weak_motor_caps_a_lift_of_both_fingers():
    """+y: the left finger cannot press harder than the right one, 2 mu n."""
    solution = evaluate(limited(antipodal(), ['knuckle'], [0.03], RIGHT_PRESSES), TaskWrench(FY))
    assert solution.alpha == pytest.approx(2 * 0.5 * 0.3, rel=SOLVER)
    assert solution.dalpha_dfriction.sum() == pytest.approx(2 * 0.3, rel=SOLVER)


def test_limits_hold_in_both_directions():
    for sign in (1.0, -1.0):
        grasp = limited(antipodal(), ['knuckle'], [0.03], sign * RIGHT_PRESSES)
        solution = evaluate(grasp, TaskWrench(-FX))
        assert solution.alpha == pytest.approx(0.3, rel=SOLVER)
        assert solution.joint_torques == pytest.approx([sign * 0.03], rel=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_answers_keep_the_limits_and_no_limit_helps(bound):
    for seed in range(8):
        grasp, task, load = random_problem(seed, bound)
        free = dataclasses.replace(grasp, joint_limits=None)
        solution, unlimited = (evaluate(g, task, external_wrench=load) for g in (grasp, free))
        assert solution.alpha <= unlimited.alpha + SOLVER
        if solution.feasible:
            usage = np.abs(solution.joint_torques) / grasp.joint_limits.max_torques
            assert usage.max() <= 1.0 + JOINT_TOLERANCE
            assert np.abs(grasp.wrench(solution.forces) + load
                          - solution.alpha * task.wrench).max() <= SOLVER


@pytest.mark.parametrize('bound', BOUNDS)
def test_alpha_grows_with_the_limits_up_to_that_without_any(bound):
    grasp, task, _ = random_problem(3, bound, tightness=0.1, gravity=0.0)
    limits = grasp.joint_limits
    alphas = [evaluate(dataclasses.replace(grasp, joint_limits=dataclasses.replace(
        limits, max_torques=limits.max_torques * factor)), task).alpha
        for factor in (0.01, 0.1, 1.0, 10.0, 1e3, 1e9)]
    assert (np.diff(alphas) >= -SOLVER).all()
    assert alphas[0] == pytest.approx(0.1 * alphas[1], rel=SOLVER)
    unlimited = evaluate(dataclasses.replace(grasp, joint_limits=None), task).alpha
    assert alphas[-1] == pytest.approx(unlimited, rel=SOLVER)


def test_forces_caps_and_torques_scale_together():
    grasp, task, load = random_problem(5)
    one = evaluate(grasp, task, external_wrench=load)
    contacts = [dataclasses.replace(c, normal=None, max_normal_force=7.0 * c.max_normal_force)
                for c in grasp.contacts]
    strong = dataclasses.replace(
        grasp, contacts=contacts, joint_limits=grasp.joint_limits.scaled(7.0))
    assert evaluate(strong, task, external_wrench=7.0 * load).alpha == pytest.approx(
        7.0 * one.alpha, rel=SOLVER)


def test_order_of_joints_and_of_contacts_does_not_matter():
    grasp, task, load = random_problem(8)
    limits, order = grasp.joint_limits, np.arange(len(grasp))[::-1]
    turned = dataclasses.replace(
        grasp, contacts=grasp.contacts.subset(order), joint_limits=JointLimits(
            limits.names[::-1], limits.max_torques[::-1], limits.torque_matrix[::-1][:, order],
            limits.gravity_torques[::-1]))
    expected = evaluate(grasp, task, external_wrench=load)
    found = evaluate(turned, task, external_wrench=load)
    assert found.alpha == pytest.approx(expected.alpha, rel=SOLVER)


def test_a_hand_that_cannot_carry_itself_holds_nothing():
    """Gravity alone is beyond the limit, and no contact helps the joint."""
    grasp = limited(antipodal(), ['knuckle'], [0.03], 0.0 * RIGHT_PRESSES, [0.04])
    solution = evaluate(grasp, TaskWrench(-FX))
    assert solution.status is Status.INFEASIBLE and not solution.holdable
    assert (solution.alpha, solution.alpha_upper) == (0.0, 0.0)
    assert evaluate(grasp, TaskWrench(FY), [0, -0.1, 0, 0, 0, 0]).status is Status.INFEASIBLE
    held = minimum_forces(grasp, np.zeros(6))
    assert held.status is Status.INFEASIBLE and held.peak == np.inf == held.violation
    assert not force_closure(grasp).closed
    assert not wrench_map(grasp, [FX, FY]).feasible.any()


def test_a_hand_that_leans_on_the_object_must_press():
    """Gravity is beyond the limit by 0.01 N m, which a push of 0.1 N at -0.1 m takes away."""
    grasp = limited(antipodal(), ['knuckle'], [0.03], -RIGHT_PRESSES, [0.04])
    solution = evaluate(grasp, TaskWrench(-FX))
    assert solution.alpha == pytest.approx(0.7, rel=SOLVER)  # tau = 0.04 - 0.07
    assert solution.holdable
    # along -x with a single finger, nothing else balances that push: alpha is at least 0.1
    alone = limited(single(), ['knuckle'], [0.03], [[[0, 0, -0.1, 0]]], [0.04])
    solution = evaluate(alone, TaskWrench(FX))
    assert solution.alpha_interval == pytest.approx((0.1, 0.7), rel=SOLVER)
    assert not solution.holdable
    assert minimum_forces(grasp, np.zeros(6)).peak == pytest.approx(0.1, rel=SOLVER)
    assert force_closure(antipodal(0.5, 0.1)).closed
    soft = antipodal(0.5, 0.1)
    closure = force_closure(limited(soft, ['knuckle'], [0.03], -RIGHT_PRESSES, [0.04]))
    # |0.04 - 0.1 n| <= 0.03 (1 - m) and n >= m: both meet where 0.1 m - 0.04 = 0.03 - 0.03 m
    assert closure.closed and closure.margin == pytest.approx(7.0 / 13.0, rel=SOLVER)


def test_minimum_forces_stay_inside_the_limits_or_say_so():
    """Without limits both fingers press alike; with them a load of 0.3 N is the most."""
    grasp = limited(antipodal(), ['knuckle'], [0.03], RIGHT_PRESSES)
    held = minimum_forces(grasp, -0.2 * FY)
    assert held.peak == pytest.approx(0.2, rel=SOLVER)
    assert (grasp.joint_limits.usage(held.forces) <= 1.0 + JOINT_TOLERANCE).all()
    beyond = minimum_forces(grasp, -0.4 * FY)
    assert beyond.status is Status.INFEASIBLE and beyond.peak == np.inf
    # the left finger presses e = 1/30 harder: e^2 + (0.1 - e/2)^2 + (e/2)^2 is least
    assert beyond.violation == pytest.approx(np.sqrt(1.0 / 120.0), rel=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_margin_forces_stay_inside_the_limits(bound):
    for seed in range(4):
        grasp, task, load = random_problem(seed, bound, tightness=1.0)
        best = evaluate(grasp, task, external_wrench=load)
        for weight in (1e-4, 0.05):
            solution = evaluate(grasp, task, external_wrench=load, barrier_weight=weight)
            assert solution.alpha <= best.alpha + SOLVER
            assert solution.status is best.status
            if solution.feasible:
                usage = grasp.joint_limits.usage(solution.forces)
                assert usage.max() <= 1.0 + JOINT_TOLERANCE


def test_what_is_refused():
    fine = (['a'], [1.0], np.zeros((1, 2, 4)))
    for place, value, words in (
            (0, [''], 'names must be words'), (0, [], 'at least one'),
            (1, [0.0], 'max_torques must be greater than 0'), (1, [np.inf], 'finite'),
            (1, [1.0, 2.0], 'shape'), (2, np.zeros((2, 2, 4)), 'shape'),
            (2, np.full((1, 2, 4), np.nan), 'finite')):
        with pytest.raises(InvalidGraspError, match=words):
            JointLimits(*[value if i == place else given for i, given in enumerate(fine)])
    with pytest.raises(InvalidGraspError, match='unique'):
        JointLimits(['a', 'a'], [1.0, 1.0], np.zeros((2, 2, 4)))
    with pytest.raises(InvalidGraspError, match='for the 2 contacts'):
        limited(antipodal(), ['a'], [1.0], np.zeros((1, 3, 4)))
    with pytest.raises(InvalidGraspError, match='must not share a name'):
        limited(antipodal(), ['left'], [1.0], np.zeros((1, 2, 4)))
    with pytest.raises(InvalidGraspError, match='must be a JointLimits'):
        dataclasses.replace(antipodal(), joint_limits=3.0)


def test_jacobians_give_the_torques_whose_power_is_that_of_the_contacts():
    rng = np.random.default_rng(5)
    jacobians, rates = rng.normal(size=(3, 2, 6)), rng.normal(size=3)
    frames, forces = antipodal(torsional_friction=0.1).rotations, rng.normal(size=(2, 4))
    gravity = rng.normal(size=3)
    limits = JointLimits.of_jacobians('abc', np.ones(3), jacobians, frames, gravity)
    twists = np.einsum('j,jkx->kx', rates, jacobians)
    power = sum(f[:3] @ R.T @ v[:3] + f[3] * R[:, 2] @ v[3:]
                for f, R, v in zip(forces, frames, twists))
    assert rates @ (limits.torques(forces) - gravity) == pytest.approx(power, rel=CLOSED_FORM)


def test_arrays_are_copied_and_read_only():
    given = np.ones(1)
    limits = JointLimits(['a'], given, np.zeros((1, 2, 4)))
    given[0] = 5.0
    assert limits.max_torques[0] == 1.0
    with pytest.raises(ValueError, match='read-only'):
        limits.max_torques[0] = 2.0
    assert limits.gravity_torques == pytest.approx([0.0], abs=CLOSED_FORM)


def test_who_does_not_know_joint_limits_says_so():
    grasp = limited(antipodal(), ['knuckle'], [0.03], RIGHT_PRESSES)
    with pytest.raises(InvalidGraspError, match='joint_limits'):
        evaluate_many([grasp], FX)
    with pytest.raises(InvalidGraspError, match='joint_limits'):
        GraspSet.varied(grasp, friction=np.full((3, 2), 0.4))
    with pytest.raises(InvalidGraspError, match='uncertainty .* joint_limits'):
        robust_alpha(grasp, TaskWrench(FX), friction_noise=0.1)


def test_holding_forces_keep_off_the_limits():
    """Both fingers press alike, in the middle between slip, caps and the joint's limit."""
    free = hold_forces(antipodal(), -0.05 * FY)
    grasp = limited(antipodal(), ['knuckle'], [0.03], RIGHT_PRESSES)
    held = hold_forces(grasp, -0.05 * FY)
    assert held.status is Status.OPTIMAL
    assert held.forces[0, 2] == pytest.approx(held.forces[1, 2], rel=SOLVER)
    assert held.forces[1, 2] < 0.3 < free.forces[1, 2]
    assert grasp.joint_limits.usage(held.forces).max() < 1.0
    assert hold_forces(grasp, -0.4 * FY).status is Status.INFEASIBLE


@pytest.mark.parametrize('seed', range(3))
def test_contacts_that_carry_nothing_can_be_left_out(seed):
    grasp, _, _ = random_problem(seed)
    kept = [len(grasp) - 1, 0]
    forces = np.zeros((len(grasp), 4))
    forces[kept] = np.random.default_rng(seed).normal(size=(2, 4))
    assert grasp.joint_limits.subset(kept).torques(forces[kept]) == pytest.approx(
        grasp.joint_limits.torques(forces), rel=CLOSED_FORM)

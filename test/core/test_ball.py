# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The largest ball in W: closed forms, laws, and both ends of the interval checked apart."""

import dataclasses

from benchmarks.random_grasps import BOUNDS, degenerate_grasp, random_grasp
from grasp_quality import (
    ball_radius, Contact, ellipsoid_scale, evaluate, Grasp, InvalidGraspError, InvalidTaskError,
    JointLimits, SolverError, TaskEllipsoid, TaskWrench, wrench_map)
from grasp_quality.ball import WIDTH
from known_grasps import antipodal, cube_of_eight, FX, single, three_finger
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tolerances import CLOSED_FORM, EXACT, SOLVER

each_bound = pytest.mark.parametrize('bound', BOUNDS)
STEP = 1e-4  # of a cap
SPHERE = np.random.default_rng(5).normal(size=(300, 6))
SPHERE /= np.linalg.norm(SPHERE, axis=1)[:, None]


def assert_holds(found, radius):
    """Check that the interval holds a radius and is as narrow as asked."""
    assert found.lower <= radius * (1.0 + CLOSED_FORM)
    assert found.upper >= radius * (1.0 - CLOSED_FORM)
    assert found.reached and found.width <= WIDTH + CLOSED_FORM


def closed_grasp(seed, bound, count=5):
    """Return the first random grasp from this seed on whose ball has a radius."""
    for s in range(seed, seed + 100):
        grasp = random_grasp(np.random.default_rng(s), count, bound)
        if ball_radius(grasp).lower > 0.0:
            return grasp
    raise AssertionError('no grasp closes')


@pytest.mark.parametrize('mu, gamma', [(0.5, 0.5), (0.5, 0.1), (1.2, 0.4), (0.1, 0.02)])
def test_antipodal_soft_fingers(mu, gamma):
    found = ball_radius(antipodal(mu, gamma, bound='l1'))
    assert_holds(found, min(mu / np.sqrt(2.0 + mu ** 2), gamma))
    assert found.upper == pytest.approx(min(mu / np.sqrt(2.0 + mu ** 2), gamma), rel=SOLVER)


@pytest.mark.parametrize('mu', [0.1, 0.3, 0.5])
def test_three_fingers(mu):
    found = ball_radius(three_finger(mu))
    assert_holds(found, 3.0 * mu / np.sqrt(5.0))
    assert found.upper == pytest.approx(3.0 * mu / np.sqrt(5.0), rel=SOLVER)
    assert np.abs(found.weakest_wrench[[2, 3, 4]]).max() > 0.1  # fz with a torque across


@pytest.mark.parametrize('grasp', [antipodal(0.5), single(), antipodal(0.5, bound='l2')])
def test_a_flat_wrench_space_holds_no_ball(grasp):
    found = ball_radius(grasp)
    assert (found.lower, found.upper, found.cells) == (0.0, 0.0, 0)
    assert found.reached and found.width == 0.0 and found.limiting_contacts == ()
    assert found.direction @ found.weakest_wrench == pytest.approx(1.0)
    assert evaluate(grasp, TaskWrench(found.weakest_wrench)).alpha <= EXACT


def test_contacts_on_one_side_hold_no_ball_either():
    grasp = Grasp([Contact(position=(np.cos(a), np.sin(a), 0.0), normal=(0.0, 0.0, 1.0))
                   for a in np.deg2rad([0.0, 120.0, 240.0])])
    found = ball_radius(grasp)
    assert found.lower == 0.0 and found.upper <= SOLVER and found.reached


@each_bound
@pytest.mark.parametrize('seed, count', [(0, 3), (10, 5), (20, 8)])
def test_no_wrench_of_the_ball_is_out_of_reach(bound, seed, count):
    grasp = closed_grasp(seed, bound, count)
    found = ball_radius(grasp)
    alphas = wrench_map(grasp, SPHERE).alpha
    assert (alphas >= found.lower).all()
    weakest = evaluate(grasp, TaskWrench(found.weakest_wrench)).alpha
    assert found.lower <= weakest <= found.upper * (1.0 + SOLVER)


@each_bound
def test_the_upper_bound_is_the_support_function(bound):
    grasp = closed_grasp(30, bound)
    found = ball_radius(grasp, torque_length=0.5)
    lengths = np.array([1.0, 1.0, 1.0, 0.5, 0.5, 0.5])
    h = np.einsum('i,ijk->jk', found.direction, grasp.matrix) * grasp.scales
    worth = grasp.max_normal_forces * np.maximum(
        0.0, h[:, 2] + np.linalg.norm(h[:, (0, 1, 3)], axis=1))
    groups = np.array(grasp.groups)
    sigma = np.linalg.norm(worth) if bound == 'l2' else sum(
        worth[groups == g].max() for g in set(grasp.groups))
    assert np.linalg.norm(found.direction * lengths) == pytest.approx(1.0, rel=CLOSED_FORM)
    assert sigma == pytest.approx(found.upper, rel=CLOSED_FORM)
    assert found.direction * lengths ** 2 == pytest.approx(found.weakest_wrench, abs=CLOSED_FORM)


@each_bound
def test_shares_are_what_more_cap_gives(bound):
    grasp = closed_grasp(40, bound)
    found = ball_radius(grasp)
    assert found.shares.sum() == pytest.approx(1.0)
    assert set(found.limiting_contacts) == {
        grasp.name_of(i) for i in range(len(grasp)) if found.shares[i] > 0.01}
    for i in range(len(grasp)):
        contacts = [dataclasses.replace(c, normal=None, max_normal_force=c.max_normal_force * (
            1.0 + STEP * (j == i))) for j, c in enumerate(grasp.contacts)]
        more = ball_radius(Grasp(contacts, bound)).upper
        assert more / found.upper - 1.0 <= STEP * (found.shares[i] + STEP) + CLOSED_FORM


@each_bound
def test_size_and_force_only_change_the_units(bound):
    grasp = closed_grasp(50, bound)
    found = ball_radius(grasp)
    for size, force in ((1e-3, 1e-3), (10.0, 1e3)):
        other = Grasp([dataclasses.replace(
            c, normal=None, position=size * c.position,
            torsional_friction=size * c.torsional_friction,
            max_normal_force=force * c.max_normal_force) for c in grasp.contacts], bound)
        scaled = ball_radius(other, torque_length=size)
        assert scaled.upper == pytest.approx(force * found.upper, rel=SOLVER)
        assert scaled.lower <= force * found.upper and scaled.reached


@pytest.mark.parametrize('length', [1e-3, 0.05, 1.0, 50.0, 1e4])
def test_any_torque_length(length):
    found = ball_radius(closed_grasp(60, 'linf'), torque_length=length)
    assert found.reached and found.lower > 0.0


def test_short_lengths_leave_pure_forces_and_long_ones_pure_torques():
    grasp = three_finger(0.5)
    short, long = (ball_radius(grasp, torque_length=length).upper for length in (1e-6, 1e6))
    assert short == pytest.approx(ball_radius(grasp, subspace='force').upper, rel=1e-5)
    assert 1e6 * long == pytest.approx(ball_radius(grasp, subspace='torque').upper, rel=1e-5)


@each_bound
def test_turning_the_frame_changes_nothing(bound):
    grasp = closed_grasp(70, bound)
    R = Rotation.from_rotvec([0.3, -1.0, 0.5]).as_matrix()
    turned = Grasp([dataclasses.replace(c, normal=None, position=R @ c.position,
                                        rotation=R @ c.rotation) for c in grasp.contacts], bound)
    assert ball_radius(turned).upper == pytest.approx(ball_radius(grasp).upper, rel=SOLVER)


def test_a_narrower_interval_lies_in_the_wider_one():
    grasp = closed_grasp(80, 'linf')
    wide, narrow = (ball_radius(grasp, relative_width=w) for w in (0.2, 1e-3))
    assert wide.lower <= narrow.lower <= narrow.upper <= wide.upper * (1.0 + SOLVER)
    assert narrow.width <= 1e-3 + CLOSED_FORM


def test_the_order_of_the_bounds():
    grasp = closed_grasp(90, 'l1')
    found = {b: ball_radius(Grasp(grasp.contacts, b)) for b in BOUNDS}
    assert found['l1'].lower <= found['l2'].upper and found['l2'].lower <= found['linf'].upper
    assert found['l1'].lower <= found['finger'].upper <= found['linf'].upper * (1.0 + SOLVER)


@pytest.mark.parametrize('subspace, rows', [('force', slice(0, 3)), ('torque', slice(3, 6))])
@each_bound
def test_subspaces_are_pure_forces_and_pure_torques(bound, subspace, rows):
    grasp = closed_grasp(100, bound)
    directions = np.zeros((300, 6))
    directions[:, rows] = SPHERE[:, :3] / np.linalg.norm(SPHERE[:, :3], axis=1)[:, None]
    alphas = wrench_map(grasp, directions).alpha
    found = ball_radius(grasp, subspace=subspace)
    assert found.reached and (alphas >= found.lower).all()
    assert found.upper <= alphas.min() * (1.0 + SOLVER)
    weakest = evaluate(grasp, TaskWrench(found.weakest_wrench)).alpha
    assert found.weakest_wrench[rows].any() and weakest <= found.upper * (1.0 + SOLVER)


def test_pure_forces_of_a_flat_grasp():
    """Antipodal PCWF pair: |fx| + |ft| <= 1 for mu = 0.5, whose ball has radius 1 / sqrt(2)."""
    assert_holds(ball_radius(antipodal(0.5), subspace='force'), np.sqrt(0.5))
    assert ball_radius(antipodal(0.5), subspace='torque').upper == 0.0


@each_bound
def test_an_ellipsoid_of_one_axis_is_two_task_wrenches(bound):
    grasp = closed_grasp(110, bound)
    axis = np.random.default_rng(0).normal(size=6)
    least = min(evaluate(grasp, TaskWrench(s * axis)).alpha for s in (1.0, -1.0))
    found = ellipsoid_scale(grasp, TaskEllipsoid([axis]))
    assert found.lower <= least * (1.0 + SOLVER) and found.upper >= least * (1.0 - SOLVER)
    assert found.upper == pytest.approx(least, rel=SOLVER)


@pytest.mark.parametrize('count', [2, 4, 5, 6, 8])
def test_every_wrench_of_an_ellipsoid_is_in_reach(count):
    grasp = closed_grasp(120, 'linf')
    axes = np.random.default_rng(count).normal(size=(count, 6))
    points = np.random.default_rng(1).normal(size=(200, count))
    points /= np.linalg.norm(points, axis=1)[:, None]
    found = ellipsoid_scale(grasp, TaskEllipsoid(axes))
    assert found.reached and found.lower > 0.0
    assert (wrench_map(grasp, points @ axes).alpha >= found.lower).all()
    guaranteed = evaluate(grasp, TaskEllipsoid(axes)).guaranteed_scale
    assert count > 6 or guaranteed <= found.upper * (1.0 + SOLVER)


@pytest.mark.parametrize('seed', range(0, 400, 20))
def test_degenerate_grasps_are_never_promised_more_than_the_dual_allows(seed):
    rng = np.random.default_rng(seed)
    grasp = degenerate_grasp(rng)
    found = ball_radius(grasp, torque_length=grasp.lever_arm)
    assert 0.0 <= found.lower <= found.upper
    directions = SPHERE[:10] * np.repeat([1.0, grasp.lever_arm], 3)
    for direction in (found.weakest_wrench, *directions):
        try:
            bound = evaluate(grasp, TaskWrench(direction)).alpha_upper
        except SolverError:
            continue
        assert found.lower <= bound * (1.0 + CLOSED_FORM)


def test_out_of_time_is_an_honest_interval():
    found = ball_radius(cube_of_eight(), relative_width=1e-5, time_limit_s=1e-9)
    assert not found.reached and found.width > 1e-5
    assert 0.0 <= found.lower <= ball_radius(cube_of_eight()).upper <= found.upper * (1 + SOLVER)


@pytest.mark.parametrize('arguments, words', [
    ({'torque_length': 0.0}, 'torque_length'), ({'torque_length': np.nan}, 'torque_length'),
    ({'subspace': 'forces'}, "one of .*'all'.*got 'forces'"),
    ({'relative_width': 0.0}, 'relative_width'), ({'relative_width': 1.0}, 'relative_width')])
def test_refusals(arguments, words):
    with pytest.raises(InvalidTaskError, match=words):
        ball_radius(three_finger(), **arguments)


def test_only_an_ellipsoid_scales():
    with pytest.raises(InvalidTaskError, match='TaskEllipsoid'):
        ellipsoid_scale(three_finger(), TaskWrench(FX))


def test_joint_limits_are_refused():
    grasp = three_finger()
    limits = JointLimits(('knuckle',), [1.0], np.zeros((1, 3, 4)))
    with pytest.raises(InvalidGraspError, match='joint_limits'):
        ball_radius(Grasp(grasp.contacts, joint_limits=limits))

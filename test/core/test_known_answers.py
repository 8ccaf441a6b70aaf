# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Closed forms of the paper's figures and of small grasps."""

from grasp_quality import ContactModel, evaluate, TaskCone, TaskWrench
from known_grasps import antipodal, cube_of_eight, FX, FY, FZ, single, three_finger, TX, TZ
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def alpha(grasp, wrench, **arguments):
    """Alpha of a task wrench."""
    return evaluate(grasp, TaskWrench(wrench), **arguments).alpha


@pytest.mark.parametrize('mu', [0.05, 0.3, 0.5, 1.7])
@pytest.mark.parametrize('bound, factor', [('linf', 2.0), ('l2', np.sqrt(2.0)), ('l1', 1.0)])
def test_antipodal_pair(mu, bound, factor):
    grasp = antipodal(mu, bound=bound)
    assert alpha(grasp, FX) == pytest.approx(1.0, abs=SOLVER)
    assert alpha(grasp, FY) == pytest.approx(factor * mu, rel=SOLVER)
    assert alpha(grasp, FZ) == pytest.approx(factor * mu, rel=SOLVER)
    assert alpha(grasp, TZ) == pytest.approx(factor * mu, rel=SOLVER)
    assert alpha(grasp, TX) == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('gamma', [0.003, 0.2, 0.5])
def test_soft_fingers_twist_with_both_moments(gamma):
    assert alpha(antipodal(0.5, gamma), TX) == pytest.approx(2.0 * gamma, rel=SOLVER)


@pytest.mark.parametrize('rho', [0.0, 0.1, 0.3, 2.0])
def test_soft_fingers_share_friction_between_force_and_moment(rho):
    mu, gamma = 0.5, 0.2
    expected = 2.0 / np.hypot(1.0 / mu, rho / gamma)
    assert alpha(antipodal(mu, gamma), FY + rho * TX) == pytest.approx(expected, rel=SOLVER)


@pytest.mark.parametrize('caps', [(1.0, 0.5), (0.2, 3.0)])
def test_unequal_caps(caps):
    grasp = antipodal(0.5, caps=caps)
    assert alpha(grasp, FX) == pytest.approx(caps[0], rel=SOLVER)
    assert alpha(grasp, -FX) == pytest.approx(caps[1], rel=SOLVER)
    assert alpha(grasp, FY) == pytest.approx(2 * 0.5 * min(caps), rel=SOLVER)


@pytest.mark.parametrize('mu', [0.2, 0.5, 0.57])
def test_three_fingers_on_the_equator(mu):
    grasp = three_finger(mu)
    assert alpha(grasp, FX) == pytest.approx(1.0, rel=SOLVER)
    assert alpha(grasp, -FX) == pytest.approx(1.0 + np.sqrt(3.0) * mu, rel=SOLVER)
    assert alpha(grasp, FZ) == pytest.approx(3.0 * mu, rel=SOLVER)


@pytest.mark.parametrize('mu, bound, across, along', [
    (0.25, 'linf', 2.0, 4.0), (0.4, 'linf', 3.2, 4.0), (0.5, 'l1', 0.5, 1.0)])
def test_fig_3(mu, bound, across, along):
    grasp = cube_of_eight(mu, bound)
    assert alpha(grasp, FX) == pytest.approx(along, rel=SOLVER)
    assert alpha(grasp, FY) == pytest.approx(across, rel=SOLVER)
    assert alpha(grasp, FZ) == pytest.approx(across, rel=SOLVER)


def test_fingers_count_once_however_many_contacts_they_have():
    grasp = cube_of_eight(0.25, 'finger')
    assert alpha(grasp, FX) == pytest.approx(1.0, rel=SOLVER)
    assert alpha(grasp, FY) == pytest.approx(2 * 0.25, rel=SOLVER)


@pytest.mark.parametrize('degrees, single_direction', [
    (0, 1.866), (10, 1.482), (20, 1.262), (30, 1.128), (40, 1.048), (50, 1.008)])
def test_fig_5_cone_keeps_its_optimum_while_the_axis_tilts(degrees, single_direction):
    tilt = np.deg2rad(degrees)
    axis = -np.cos(tilt) * FX + np.sin(tilt) * FY
    cone = TaskCone(axis, np.sin(tilt) * FX + np.cos(tilt) * FY, FZ, np.deg2rad(60.0))
    solution = evaluate(three_finger(), cone)
    assert solution.wrench == pytest.approx(-(1.0 + np.sqrt(3.0) / 2.0) * FX, abs=1e-5)
    assert solution.alpha == pytest.approx((1.0 + np.sqrt(3.0) / 2.0) * np.cos(tilt), rel=SOLVER)
    assert solution.alpha_axis == pytest.approx(single_direction, abs=5e-4)


@pytest.mark.parametrize('eps', [1e-6, 1e-3, 0.01, 0.05, 0.5, 2.0, 50.0, 1e3])
@pytest.mark.parametrize('mu', [0.2, 0.5, 1.3])
def test_barrier_weight_on_the_antipodal_pair(mu, eps):
    solution = evaluate(antipodal(mu), TaskWrench(FY), barrier_weight=eps)
    expected = 2.0 * mu ** 2 / (np.sqrt(mu ** 2 + eps ** 2) + eps)
    assert solution.alpha == pytest.approx(expected, abs=CLOSED_FORM)
    assert solution.alpha_upper == pytest.approx(2.0 * mu, rel=SOLVER)


def test_one_contact():
    assert alpha(single(), FX) == pytest.approx(1.0, rel=SOLVER)
    assert alpha(single(), -FX) == pytest.approx(0.0, abs=SOLVER)
    assert alpha(single(), FY) == pytest.approx(0.0, abs=SOLVER)
    assert alpha(single(), FX + 0.5 * FY) == pytest.approx(1.0, rel=SOLVER)
    assert alpha(single(), FX + 0.51 * FY) == pytest.approx(0.0, abs=SOLVER)


def test_one_soft_finger_pushes_and_twists():
    grasp = single(0.5, ContactModel.SFCE, 0.1)
    assert alpha(grasp, FX + 0.1 * TX) == pytest.approx(1.0, rel=SOLVER)
    assert alpha(grasp, FX + 0.101 * TX) == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('load, task, expected', [
    (-0.5 * FX, FX, (0.0, 0.5)), (-0.5 * FX, -FX, (0.0, 0.5)), (0.5 * FX, FX, (0.5, 1.5))])
def test_one_contact_against_a_load(load, task, expected):
    solution = evaluate(single(), TaskWrench(task), external_wrench=load)
    assert solution.alpha_interval == pytest.approx(expected, abs=SOLVER)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Alpha under uncertainty: closed forms of its distribution, and laws."""

import math
from statistics import NormalDist

from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, InvalidTaskError, robust_alpha, SolverTimeoutError,
    TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench)
from grasp_quality.bounds import BOUNDS
from grasp_quality.uncertainty import draw, Uncertainty
from known_grasps import antipodal, cube_of_eight, FX, FY, FZ, single, three_finger, TX
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER

NOISE = {'contact_noise': 0.02, 'normal_noise': 0.05, 'friction_noise': 0.05}
LOAD = [0.0, 0.0, -0.2, 0.0, 0.01, 0.0]


def true_quantile(level, mu=0.5, deviation=0.05):
    """2 min(mu_1, mu_2) of an antipodal pair, both normal: P(min > x) = (1 - Phi)^2."""
    return 2.0 * (mu + deviation * NormalDist().inv_cdf(1.0 - math.sqrt(1.0 - level)))


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('load', [None, LOAD])
def test_without_noise_every_sample_is_alpha(bound, load):
    grasp, task = three_finger(0.5, bound), TaskWrench(FX + 0.3 * FZ)
    answer = robust_alpha(grasp, task, load, samples=60, quantile=[0.1, 0.5])
    alpha = evaluate(grasp, task, load).alpha
    assert answer.alpha == pytest.approx(np.full(60, alpha), rel=CLOSED_FORM)
    for values in (answer.quantile, answer.quantile_lower, answer.quantile_upper):
        assert values == pytest.approx([alpha, alpha], rel=CLOSED_FORM)
    assert (answer.infeasible, answer.unproved) == (0, 0)


def test_friction_noise_of_an_antipodal_pair_has_a_closed_form():
    """Sample by sample alpha = 2 min(mu_1, mu_2), and its quantiles lie in their intervals."""
    levels = [0.01, 0.05, 0.5]
    answer = robust_alpha(antipodal(0.5), TaskWrench(FY), friction_noise=0.05, samples=4000,
                          quantile=levels, confidence=0.999)
    truth = [true_quantile(level) for level in levels]
    assert (answer.quantile_lower <= truth).all() and (truth <= answer.quantile_upper).all()
    assert answer.quantile == pytest.approx(truth, abs=0.02)
    # P(2 min(mu_1, mu_2) >= 1) = P(mu >= 0.5)^2
    assert answer.probability_lower <= 0.25 <= answer.probability_upper
    assert answer.probability == (answer.alpha >= 1.0).mean()


def test_the_intervals_hold_the_truth_as_often_as_they_say():
    """100 seeds at 90 %: between 81 and 98 of them, a chance below 1e-3 of being outside."""
    quantiles = probabilities = 0
    for seed in range(100):
        answer = robust_alpha(antipodal(0.5), TaskWrench(FY), friction_noise=0.05, samples=200,
                              quantile=0.2, confidence=0.9, seed=seed)
        quantiles += answer.quantile_lower <= true_quantile(0.2) <= answer.quantile_upper
        probabilities += answer.probability_lower <= 0.25 <= answer.probability_upper
    assert 81 <= quantiles <= 98 and 81 <= probabilities <= 98


def test_load_noise_of_one_finger_has_a_closed_form():
    """It pushes 1 N along x, and the load helps with 0.3 N: alpha = 1.3, give or take."""
    answer = robust_alpha(single(), TaskWrench(FX), 0.3 * FX, load_noise=0.1 * FX, samples=2000,
                          quantile=0.1, confidence=0.999)
    truth = 1.3 + 0.1 * NormalDist().inv_cdf(0.1)
    assert answer.quantile_lower <= truth <= answer.quantile_upper


def test_infeasible_samples_count_as_zero():
    """A pair holds 1 N of weight; the load is 1 N give or take: half of it is too much."""
    answer = robust_alpha(antipodal(0.5), TaskWrench(FY), -FZ, load_noise=0.2 * FZ, samples=500,
                          quantile=[0.05, 0.9])
    assert 200 <= answer.infeasible <= 300
    assert (answer.alpha == 0.0).sum() >= answer.infeasible
    assert answer.quantile[0] == answer.quantile_lower[0] == answer.quantile_upper[0] == 0.0
    assert answer.quantile[1] > 0.0


def test_quantiles_grow_with_their_level_and_lie_in_their_intervals():
    levels = [0.02, 0.1, 0.3, 0.5, 0.8, 0.95]
    answer = robust_alpha(three_finger(), TaskWrench(FZ), LOAD, samples=300, quantile=levels,
                          **NOISE)
    for values in (answer.quantile, answer.quantile_lower, answer.quantile_upper):
        assert (np.diff(values) >= 0.0).all()
    assert (answer.quantile_lower <= answer.quantile).all()
    assert (answer.quantile <= answer.quantile_upper).all()
    assert answer.level.tolist() == levels


def test_a_seed_decides_everything():
    grasp, task = three_finger(), TaskWrench(FX)
    first, again, other = (
        robust_alpha(grasp, task, LOAD, samples=50, seed=seed, **NOISE) for seed in (5, 5, 6))
    assert (first.alpha == again.alpha).all() and first.quantile == again.quantile
    assert (first.alpha != other.alpha).any()


def test_more_caps_and_load_scale_alpha():
    """Three times all forces, or a third of the task: three times alpha, sample by sample."""
    task = TaskWrench(FX + FZ)
    grasp = three_finger()
    strong = Grasp([Contact(c.position, rotation=c.rotation, friction=c.friction,
                            max_normal_force=3.0) for c in grasp.contacts])
    base = robust_alpha(grasp, task, LOAD, samples=60, load_noise=0.05, **NOISE)
    forces = robust_alpha(strong, task, 3.0 * np.array(LOAD), samples=60, load_noise=0.15, **NOISE)
    small = robust_alpha(grasp, TaskWrench((FX + FZ) / 3.0), LOAD, samples=60, load_noise=0.05,
                         **NOISE)
    assert forces.alpha == pytest.approx(3.0 * base.alpha, rel=SOLVER, abs=SOLVER)
    assert small.alpha == pytest.approx(3.0 * base.alpha, rel=SOLVER, abs=SOLVER)


def test_lengths_scale_out():
    """A grasp of 10 m with ten times the position noise is that of 1 m: forces have no length."""
    near, far = (robust_alpha(
        antipodal(0.5, reach=reach), TaskWrench(FY), contact_noise=0.01 * reach, samples=60)
        for reach in (1.0, 10.0))
    assert far.alpha == pytest.approx(near.alpha, rel=SOLVER, abs=SOLVER)


@pytest.mark.parametrize('model', list(ContactModel))
def test_samples_are_the_grasps_that_evaluate_solves(model):
    """Every sample by itself, for all models: alpha of the same draws."""
    grasp = Grasp([Contact(c.position, rotation=c.rotation, model=model, torsional_friction=0.05)
                   for c in cube_of_eight(0.5).contacts])
    task, load = TaskWrench(FX + 0.2 * TX), np.array(LOAD)
    answer = robust_alpha(grasp, task, load, load_noise=0.05, samples=30, seed=2, **NOISE)
    (drawn, loads), = draw(grasp, load, Uncertainty(0.02, 0.05, 0.05, 0.05, 8), 30, 2)
    single_answers = [evaluate(drawn[i], task, loads[i]).alpha for i in range(30)]
    assert answer.alpha == pytest.approx(single_answers, rel=SOLVER, abs=SOLVER)


def test_friction_alone_lowers_the_quantile_with_its_noise():
    """The same draws at twice the noise: the low quantile falls, as 2 min(mu) says."""
    low = [robust_alpha(antipodal(0.5), TaskWrench(FY), friction_noise=noise, samples=200).quantile
           for noise in (0.0, 0.02, 0.04)]
    assert low[0] == pytest.approx(1.0, rel=SOLVER)
    assert 1.0 - low[2] == pytest.approx(2.0 * (1.0 - low[1]), rel=1e3 * SOLVER)


def test_of_a_polytope_the_weakest_wrench_counts_and_of_a_cone_alpha_z():
    grasp = three_finger()
    both = robust_alpha(grasp, TaskPolytope([FX, FZ]), samples=30, **NOISE).alpha
    each = [robust_alpha(grasp, TaskWrench(w), samples=30, **NOISE).alpha for w in (FX, FZ)]
    assert both == pytest.approx(np.minimum(*each), rel=SOLVER)
    cone = TaskCone(-FX, FY, FZ, np.deg2rad(30))
    answer = robust_alpha(grasp, cone, samples=20)
    assert answer.alpha == pytest.approx(np.full(20, evaluate(grasp, cone).alpha), rel=SOLVER)


@pytest.mark.parametrize('arguments, words', [
    ({'samples': 0}, 'samples must be a whole number from 1 to 1000000, got 0'),
    ({'samples': 10.5}, 'samples must be a whole number'),
    ({'samples': True}, 'samples must be a whole number'),
    ({'samples': 10, 'quantile': 0.9}, 'samples must be at least 36 for an upper bound'),
    ({'quantile': 1.0}, 'quantile must be less than 1'), ({'quantile': []}, 'got none'),
    ({'quantile': [0.1, 0.0]}, 'quantile must be greater than 0'),
    ({'quantile': 'low'}, "quantile must be a number, got 'low'"),
    ({'confidence': 1.0}, 'confidence must be less than 1'),
    ({'seed': -1}, 'seed must be a whole number from 0'),
    ({'friction_noise': -1.0}, 'friction_noise must be finite, at least 0'),
    ({'external_wrench': [1.0]}, 'external_wrench')])
def test_refusals(arguments, words):
    with pytest.raises(InvalidTaskError, match=words):
        robust_alpha(antipodal(), TaskWrench(FY), **arguments)


def test_an_ellipsoid_is_refused_with_the_way_out():
    with pytest.raises(InvalidTaskError, match='give an ellipsoid as the TaskPolytope'):
        robust_alpha(antipodal(), TaskEllipsoid([FX, FY]))


@pytest.mark.parametrize('task', [TaskWrench(FY), TaskCone(FY, FX, FZ, 0.2)])
def test_the_time_limit_holds(task):
    with pytest.raises(SolverTimeoutError, match='time limit of 1e-09 s'):
        robust_alpha(antipodal(), task, time_limit_s=1e-9)

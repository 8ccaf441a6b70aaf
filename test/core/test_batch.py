# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Many wrenches at once: the same answers as one by one, and every one of them proved."""

from benchmarks.random_grasps import degenerate_grasp, degenerate_load, random_grasp
from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, SolverError, TaskWrench, wrench_map)
from grasp_quality.batch import SMALL, solve_wrenches
from grasp_quality.bounds import BOUNDS
from grasp_quality.directions import force_grid
import numpy as np
import pytest
from tolerances import SOLVER


def ball_grasp(count, bound, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    models = list(ContactModel)
    return Grasp([
        Contact(p, -p + 0.2 * rng.normal(size=3), model=models[i % 3], torsional_friction=0.05,
                max_normal_force=rng.uniform(1.0, 5.0), finger=f'finger {i % 2}')
        for i, p in enumerate(points)], bound)


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('load', [None, [0.1, 0.0, -0.3, 0.0, 0.05, 0.0]])
def test_answers_are_those_of_single_solves(bound, load):
    grasp = ball_grasp(6, bound, seed=1)
    wrenches = np.random.default_rng(2).normal(size=(40, 6))
    batch = solve_wrenches(grasp, wrenches, load)
    for i, wrench in enumerate(wrenches):
        single = evaluate(grasp, TaskWrench(wrench), load)
        assert batch.feasible[i] == single.feasible
        assert batch.alpha[i] == pytest.approx(single.alpha, rel=SOLVER, abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_forces_balance_the_scaled_wrench(bound):
    grasp = ball_grasp(5, bound, seed=3)
    wrenches = force_grid(4)
    batch = solve_wrenches(grasp, wrenches)
    for alpha, wrench, forces in zip(batch.alpha, wrenches, batch.forces):
        np.testing.assert_allclose(grasp.wrench(forces), alpha * wrench, atol=SOLVER)


def test_a_load_that_nothing_balances_is_infeasible_everywhere():
    grasp = Grasp([Contact((-1, 0, 0), (1, 0, 0)), Contact((1, 0, 0), (-1, 0, 0))])
    answer = wrench_map(grasp, [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]],
                        external_wrench=[0, 0, -5, 0, 0, 0])
    assert not answer.feasible.any() and not answer.alpha.any()


def test_few_are_handed_over():
    batch = solve_wrenches(ball_grasp(8, 'linf', seed=4), force_grid(12))
    assert batch.handed_over <= 0.01 * len(batch.alpha)


def test_threads_change_nothing():
    rng = np.random.default_rng(3)
    grasp = random_grasp(rng, count=8, bound='linf')
    wrenches = rng.normal(size=(3 * SMALL, 6))
    whole = solve_wrenches(grasp, wrenches)
    parts = [solve_wrenches(grasp, part).alpha for part in np.split(wrenches, 3)]
    assert whole.alpha == pytest.approx(np.concatenate(parts), rel=1e-12)
    assert whole.feasible.all()


def test_degenerate_grasps():
    compared = 0
    for seed in range(40):
        rng = np.random.default_rng(seed)
        grasp = degenerate_grasp(rng)
        wrenches, load = rng.normal(size=(5, 6)), degenerate_load(rng, grasp)
        try:
            batch = solve_wrenches(grasp, wrenches, load)
            ones = [evaluate(grasp, TaskWrench(w), external_wrench=load) for w in wrenches]
        except SolverError:
            continue
        for i, one in enumerate(ones):
            size = np.linalg.norm(grasp.scaled_wrench(wrenches[i])) / grasp.cap_total
            assert batch.feasible[i] == one.feasible
            assert batch.alpha[i] * size == pytest.approx(one.alpha * size, abs=1e-5, rel=1e-5)
            compared += 1
    assert compared > 150

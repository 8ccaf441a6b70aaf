# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The barrier weight of eq. (11): friction margin for alpha."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    build_problem, Contact, ContactModel, evaluate, Grasp, solve, Status, TaskCone, TaskPolytope,
    TaskWrench)
from grasp_quality.barrier import has_interior, objective_upper
from known_grasps import antipodal, FX, FY, FZ, single, three_finger, TX, TZ
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER

WEIGHTS = (1e-4, 1e-2, 0.1, 1.0)


@pytest.mark.parametrize('bound', BOUNDS)
def test_margin_grows_and_alpha_falls_with_the_weight(bound):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=6, bound=bound)
        task, load = TaskWrench(rng.normal(size=6)), random_load(rng, grasp)
        plain = evaluate(grasp, task, external_wrench=load)
        found = [evaluate(grasp, task, external_wrench=load, barrier_weight=w) for w in WEIGHTS]
        assert all(s.status is Status.OPTIMAL for s in found)
        alphas = [plain.alpha, *(s.alpha for s in found)]
        assert (np.diff(alphas) <= SOLVER).all()
        margins = [s.friction_margin for s in found]
        assert margins[0] > 0.0 and margins[-1] >= margins[0]
        for weight, solution in zip(WEIGHTS, found):
            check_forces(grasp, solution.forces, solution.wrench, load)
            assert solution.alpha <= plain.alpha_upper
            assert solution.alpha_upper == plain.alpha_upper
            assert solution.barrier_weight == weight
            assert solution.proof.gap <= 1e-6


@pytest.mark.parametrize('bound', BOUNDS)
def test_no_forces_beat_the_objective(bound):
    """Nearby feasible forces have a lower alpha + eps sum log det."""
    rng = np.random.default_rng(4)
    grasp, eps = random_grasp(rng, count=5, bound=bound), 0.05
    wrench = rng.normal(size=6)
    solution = evaluate(grasp, TaskWrench(wrench), barrier_weight=eps)

    def objective(forces, alpha):
        parts = grasp.shares(forces)
        rest = (parts[:, [0, 1, 3]] ** 2).sum(axis=1)
        frictional = (grasp.scales[:, [0, 3]] > 0.0).any(axis=1)
        n = parts[:, 2]
        return alpha + eps * np.log(np.where(frictional, n ** 2 - rest, n)).sum()

    best = objective(solution.forces, solution.alpha)
    columns = np.concatenate([grasp.matrix.reshape(6, -1), -wrench[:, None]], axis=1)
    active = np.append((grasp.scales > 0.0).ravel(), True)
    _, _, V = np.linalg.svd(columns[:, active])
    for _ in range(300):
        change = np.zeros(len(active))
        change[active] = V[6:].T @ rng.normal(size=V.shape[0] - 6)
        change *= 1e-3 / np.abs(change).max()
        forces = solution.forces + change[:-1].reshape(-1, 4)
        shares = forces[:, 2] / grasp.max_normal_forces
        used = (np.linalg.norm(shares) if bound == 'l2'
                else np.bincount(grasp.groups, weights=shares).max())
        shrink = max(1.0, used)
        assert objective(forces / shrink, (solution.alpha + change[-1]) / shrink) <= best + 1e-9


def test_sensitivities_stay_those_of_the_largest_alpha():
    plain = evaluate(three_finger(), TaskWrench(FY))
    margin = evaluate(three_finger(), TaskWrench(FY), barrier_weight=0.1)
    assert (margin.dalpha_dexternal_wrench == plain.dalpha_dexternal_wrench).all()
    assert (margin.dalpha_dmax_force == plain.dalpha_dmax_force).all()
    assert (margin.dalpha_dfriction == plain.dalpha_dfriction).all()
    assert margin.limiting_contact == plain.limiting_contact


@pytest.mark.parametrize('load', [None, -0.2 * FY])
@pytest.mark.parametrize('bound', ['linf', 'l1', 'l2'])
def test_a_task_out_of_range_leaves_the_margin_to_be_bought(load, bound):
    solution = evaluate(
        antipodal(0.5, bound=bound), TaskWrench(TX), external_wrench=load, barrier_weight=0.05)
    assert solution.status is Status.OPTIMAL
    assert solution.alpha == pytest.approx(0.0, abs=1e-9)
    assert solution.pinned and solution.friction_margin > 0.5


@pytest.mark.parametrize('grasp, task, load', [
    (single(), TaskWrench(-FX), None),
    (single(), TaskWrench(FY), None),
    (antipodal(0.5), TaskWrench(FX), -1.0 * FY),
    (single(), TaskWrench(FX + 0.5 * FY), None),
])
def test_without_interior_the_answer_is_that_of_weight_zero(grasp, task, load):
    plain = evaluate(grasp, task, external_wrench=load)
    solution = evaluate(grasp, task, external_wrench=load, barrier_weight=0.1)
    assert solution.status is Status.OPTIMAL_NO_INTERIOR and solution.feasible
    assert solution.alpha == plain.alpha
    assert (solution.forces == plain.forces).all()
    assert solution.barrier_weight == 0.1


def test_infeasible_stays_infeasible():
    solution = evaluate(antipodal(), TaskWrench(FX), external_wrench=-5.0 * FY, barrier_weight=0.1)
    assert solution.status is Status.INFEASIBLE


def test_one_contact_pushing_has_interior():
    solution = evaluate(single(), TaskWrench(FX), barrier_weight=0.1)
    assert solution.status is Status.OPTIMAL
    assert solution.alpha == pytest.approx(1.0, rel=CLOSED_FORM)
    assert solution.friction_margin == pytest.approx(1.0, abs=1e-6)


def test_frictionless_contacts_count_with_log_n():
    """One FPC each side, task pushing right: n left = 1, n right falls from it; by hand."""
    grasp = Grasp([Contact(position=(x, 0, 0), normal=(-x, 0, 0), model=ContactModel.FPC)
                   for x in (-1.0, 1.0)])
    solution = evaluate(grasp, TaskWrench(FX), barrier_weight=0.25)
    # maximise 1 - n + 0.25 log n
    assert solution.forces[1, 2] == pytest.approx(0.25, rel=CLOSED_FORM)
    assert solution.alpha == pytest.approx(0.75, rel=CLOSED_FORM)


@pytest.mark.parametrize('bound', BOUNDS)
def test_cone_with_margin(bound):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=6, bound=bound)
        task = TaskCone(
            -random_load(rng, grasp), *rng.normal(size=(2, 6)), 0.5, surface_samples=0)
        plain, solution = evaluate(grasp, task), evaluate(grasp, task, barrier_weight=0.05)
        assert solution.status is Status.OPTIMAL
        assert solution.alpha <= plain.alpha_upper and solution.friction_margin > 0.0
        check_forces(grasp, solution.forces, solution.wrench)


def test_polytope_with_margin():
    solution = evaluate(antipodal(0.5), TaskPolytope([FY, FZ, TZ]), barrier_weight=0.05)
    assert solution.status is Status.OPTIMAL
    assert solution.alphas == pytest.approx(
        np.full(3, 2.0 * (np.sqrt(0.25 + 0.0025) - 0.05)), rel=CLOSED_FORM)


def test_polytope_says_when_one_wrench_leaves_no_interior():
    assert evaluate(single(), TaskPolytope([FX, FY]), barrier_weight=0.05).status is (
        Status.OPTIMAL_NO_INTERIOR)


def test_interior_of_a_task():
    assert has_interior(build_problem(antipodal(0.5), TaskWrench(FY)))
    assert has_interior(build_problem(antipodal(0.5), TaskCone(FY, FX, FZ, 0.4)))
    assert not has_interior(build_problem(single(), TaskWrench(FY)))


def test_any_multipliers_bound_the_objective():
    grasp, task, eps = three_finger(), TaskWrench(FY), 0.1
    problem = build_problem(grasp, task)
    plain = solve(problem)
    best = evaluate(grasp, task, barrier_weight=eps * problem.virtual.unit).proof.objective
    rng = np.random.default_rng(0)
    for _ in range(200):
        multipliers = rng.normal(size=problem.layout.shape[0])
        assert objective_upper(problem, multipliers, eps, plain.proof) >= best - SOLVER

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The proof does not believe the solver: bad answers and bad multipliers are seen through."""

import dataclasses

from answer_checks import support_of_wrenches
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import build_problem, clarabel_solver, SolverError, TaskWrench
from grasp_quality.problem import assemble, VirtualContact
from grasp_quality.proof import prove, worth_of
from grasp_quality.raw_answer import RawAnswer
from grasp_quality.solve import first_proved, prove_optimal
from known_grasps import antipodal, FY, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def solved(bound='linf', loaded=False, seed=2):
    """Return a problem and Clarabel's answer to it."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=6, bound=bound)
    load = random_load(rng, grasp) if loaded else None
    problem = build_problem(grasp, TaskWrench(rng.normal(size=6)), load)
    return problem, clarabel_solver.run(problem)


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('loaded', [False, True])
def test_a_good_answer_is_proved(bound, loaded):
    problem, answer = solved(bound, loaded)
    optimum = prove_optimal(problem)
    assert optimum.proof.holds
    assert optimum.proof.upper == pytest.approx(answer.values[0], rel=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('loaded', [False, True])
def test_any_multipliers_give_an_upper_bound(bound, loaded):
    problem, answer = solved(bound, loaded)
    rng = np.random.default_rng(0)
    for _ in range(200):
        guess = answer.multipliers + rng.normal(size=len(answer.multipliers)) * rng.uniform(0, 1)
        proof = prove(problem, answer.shares, answer.values, guess)
        assert proof.upper >= answer.values[0] * (1.0 - SOLVER)


@pytest.mark.parametrize('spoil, broken', [
    (lambda a: dataclasses.replace(a, values=0.999 * a.values), 'residual'),
    (lambda a: dataclasses.replace(a, values=0.999 * a.values, shares=0.999 * a.shares), 'gap'),
    (lambda a: dataclasses.replace(a, shares=1.001 * a.shares), 'bound_usage'),
    (lambda a: dataclasses.replace(a, shares=a.shares * [1.001, 1.001, 1.0, 1.001]), 'usage'),
    (lambda a: dataclasses.replace(a, multipliers=1.1 * a.multipliers + 0.01), 'gap'),
    (lambda a: dataclasses.replace(a, multipliers=0.0 * a.multipliers), 'gap'),
])
def test_a_spoiled_answer_is_not(spoil, broken):
    grasp = three_finger()
    problem = build_problem(grasp, TaskWrench(FY))
    answer = spoil(clarabel_solver.run(problem))
    proof = prove(problem, answer.shares, answer.values, answer.multipliers)
    good = {'gap': 1e-6, 'residual': 1e-8, 'usage': 1.0 + 1e-9, 'bound_usage': 1.0 + 1e-9}
    assert not proof.holds
    assert not getattr(proof, broken) <= good[broken]
    assert broken.split('_')[0] in str(proof) or 'bound' in str(proof)


def test_a_boast_is_held_down_to_the_bound():
    problem = build_problem(three_finger(), TaskWrench(FY))
    answer = clarabel_solver.run(problem)
    proof = prove(problem, answer.shares, 2.0 * answer.values, answer.multipliers)
    assert proof.objective == proof.upper == pytest.approx(answer.values[0], rel=SOLVER)


def test_not_a_number_is_not_proved():
    problem, answer = solved()
    for field in ('shares', 'values', 'multipliers'):
        bad = dataclasses.replace(answer, **{field: np.full_like(getattr(answer, field), np.nan)})
        assert not prove(problem, bad.shares, bad.values, bad.multipliers).holds


def test_worth_is_the_support_function_of_the_wrenches():
    for seed in range(20):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng)
        direction = rng.normal(size=6)
        _, per_contact, total = worth_of(grasp, direction)
        physical = direction / grasp.force_scale
        physical[3:] /= grasp.lever_arm
        physical[:3] -= np.cross(physical[3:], grasp.center)
        assert total == pytest.approx(support_of_wrenches(grasp, physical), rel=CLOSED_FORM)
        assert (per_contact >= 0.0).all()


def test_unproved_answers_end_as_an_error(monkeypatch):
    """Whatever a solver claims, nothing leaves without a proof."""
    problem, answer = solved('l2')
    lie = RawAnswer(0.99 * answer.shares, answer.values, answer.multipliers, 'Solved')
    monkeypatch.setattr(clarabel_solver, 'run', lambda *_: lie)
    with pytest.raises(SolverError, match='no answer could be proved.*gap.*residual') as caught:
        prove_optimal(problem)
    assert caught.value.problem is problem


@pytest.mark.parametrize('bound', ['linf', 'l2'])
@pytest.mark.parametrize('number', [np.inf, -np.inf, np.nan])
def test_an_alpha_that_is_no_number_is_no_answer(bound, number):
    problem, answer = solved(bound)
    for part in ('values', 'shares', 'multipliers'):
        lie = dataclasses.replace(answer, **{part: np.full_like(getattr(answer, part), number)})
        with pytest.raises(SolverError, match='no answer could be proved'):
            first_proved(problem, [lie])


def test_a_task_left_open_beside_a_press_is_not_overlooked():
    """A lambda along which the open task would gain without end bounds nothing."""
    grasp = antipodal(friction=0.5)
    normals = grasp.scaled_matrix[:, :, 2].sum(axis=1)
    task = grasp.scaled_wrench([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])
    pressing = VirtualContact(
        np.stack([-normals, task], axis=1), False, np.array([1.0, 0.0]), role='pressing')
    problem = assemble(grasp, pressing, [0.0, 0.9, 0.0, 0.0, 0.0, 0.0])
    for lambda_ in np.random.default_rng(0).normal(size=(200, 6)):
        judged = prove(problem, np.zeros((2, 4)), np.zeros(2), np.append(lambda_, [1.0, 1.0]))
        if lambda_ @ task < -1e-6 * np.abs(lambda_).max():
            assert judged.upper == np.inf
        else:
            assert judged.upper >= prove_optimal(problem).values[0] - SOLVER

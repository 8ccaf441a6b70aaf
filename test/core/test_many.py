# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Many grasps at once: the answers of ``evaluate``, whatever the shapes."""

from benchmarks.random_grasps import (
    degenerate_grasp, degenerate_load, degenerate_wrench, random_grasp)
from grasp_quality import (
    evaluate, evaluate_many, GraspSet, InvalidTaskError, Outcome, SolverError,
    SolverTimeoutError, TaskWrench)
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


@pytest.mark.parametrize('eps', [0.0, 0.05])
@pytest.mark.parametrize('loaded', [False, True])
def test_answers_are_those_of_evaluate(eps, loaded):
    rng = np.random.default_rng(4)
    grasps = [random_grasp(rng) for _ in range(40)]
    wrenches = rng.normal(size=(40, 6))
    loads = 0.05 * rng.normal(size=(40, 6)) if loaded else None
    many = evaluate_many(grasps, wrenches, loads, eps, forces=True)
    for i, grasp in enumerate(grasps):
        one = evaluate(grasp, TaskWrench(wrenches[i]), loads[i] if loaded else None, eps)
        assert many.status[i] == Outcome[one.status.name] and many.feasible[i] == one.feasible
        assert many.alpha[i] == pytest.approx(one.alpha, rel=SOLVER, abs=SOLVER)
        assert many.alpha_upper[i] == pytest.approx(one.alpha_upper, rel=SOLVER, abs=SOLVER)
        assert not many.forces[i, len(grasp):].any()
        if one.feasible:
            balance = grasp.wrench(many.forces[i, :len(grasp)]) - many.alpha[i] * wrenches[i]
            assert balance + (loads[i] if loaded else 0.0) == pytest.approx(0.0, abs=SOLVER)
        else:
            assert not many.forces[i].any()


def test_the_kernel_does_the_barrier_weight_too():
    """The closed form of eq. (11) for an antipodal pair; nothing is handed over."""
    mu = np.linspace(0.1, 1.0, 20)
    for eps in (1e-3, 0.05, 1.0):
        many = evaluate_many(
            GraspSet.varied(antipodal(), friction=np.stack([mu, mu], axis=1)), FY, None, eps, True)
        assert many.handed_over == 0
        assert many.alpha == pytest.approx(2.0 * (np.sqrt(mu**2 + eps**2) - eps), rel=CLOSED_FORM)
        assert many.alpha_upper == pytest.approx(2.0 * mu, rel=SOLVER)
        assert many.forces[:, :, :2].sum(axis=1) != pytest.approx(0.0)


def test_degenerate_grasps():
    cases = []
    for seed in range(150):
        rng = np.random.default_rng(seed)
        grasp = degenerate_grasp(rng)
        load = degenerate_load(rng, grasp)
        cases.append((grasp, degenerate_wrench(rng, grasp), np.zeros(6) if load is None else load))
    grasps, wrenches, loads = zip(*cases)
    many = evaluate_many(grasps, wrenches, loads)
    for i, (grasp, wrench, load) in enumerate(cases):
        try:
            one = evaluate(grasp, TaskWrench(wrench), load)
        except SolverError:
            continue
        size = np.linalg.norm(grasp.scaled_wrench(wrench)) / grasp.cap_total
        assert many.status[i] == Outcome[one.status.name]
        assert many.alpha[i] * size == pytest.approx(one.alpha * size, abs=SOLVER, rel=SOLVER)


def test_all_tasks_with_all_grasps():
    tasks = np.stack([FX, FY, FZ])[:, None]
    many = evaluate_many([antipodal(), three_finger(), antipodal(0.3)], tasks)
    across = evaluate(three_finger(), TaskWrench(FY)).alpha
    assert many.alpha == pytest.approx(
        np.array([[1.0, 1.0, 1.0], [1.0, across, 0.6], [1.0, 1.5, 0.6]]), abs=SOLVER)
    assert many.forces is None and many.alpha.shape == many.status.shape == (3, 3)


def test_one_task_for_all_and_answers_are_frozen():
    many = evaluate_many(GraspSet.varied(antipodal(), friction=[[0.2, 0.2], [0.4, 0.4]]),
                         TaskWrench(FY), forces=True)
    assert many.alpha == pytest.approx([0.4, 0.8], abs=SOLVER)
    assert many.forces.shape == (2, 2, 4)
    assert not any(a.flags.writeable for a in (many.alpha, many.status, many.forces))


def test_a_load_of_its_own_for_each():
    loads = [[0.0, 0.0, -0.1, 0.0, 0.0, 0.0], [0.0, 0.0, -5.0, 0.0, 0.0, 0.0]]
    many = evaluate_many([antipodal(), antipodal()], FZ, loads, forces=True)
    assert many.status.tolist() == [Outcome.OPTIMAL, Outcome.INFEASIBLE]
    assert many.alpha == pytest.approx([0.9, 0.0], abs=SOLVER)
    assert many.alpha[1] == 0.0 and not many.forces[1].any()


@pytest.mark.parametrize('tasks, words', [
    (np.zeros(6), 'must not be zero'), ([[FX, 0 * FX]], r'at \[0, 1\]'), ([1, 2], r'\(..., 6\)'),
    (np.ones((3, 6)), 'broadcast against 2 grasps'), (FX * np.nan, 'finite'),
    ('task', 'tasks must be wrenches')])
def test_bad_tasks_are_named(tasks, words):
    with pytest.raises(InvalidTaskError, match=words):
        evaluate_many([antipodal(), antipodal()], tasks)


def test_many_tasks_are_not_taken_for_one_grasp():
    with pytest.raises(InvalidTaskError, match='wrench_map'):
        evaluate_many([antipodal()], [FX, FY])


@pytest.mark.parametrize('bound', ['linf', 'l2'])  # all at once, and one after the other
def test_time_limit(bound):
    with pytest.raises(SolverTimeoutError, match='time limit'):
        evaluate_many([antipodal(bound=bound)], FX, time_limit_s=0.0)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The compiled judge says what the proof in plain numpy says, of good answers and bad ones."""

import dataclasses

from benchmarks.random_grasps import degenerate_grasp, degenerate_load, random_grasp, random_load
from grasp_quality import (
    build_problem, clarabel_solver, infeasibility, judge, kernel_solver, proof, TaskWrench)
from grasp_quality.batch import TOLERANCES
from grasp_quality.scaled import Scaled
import numpy as np
import pytest
from tolerances import EXACT

BOUNDS = ('l1', 'linf', 'finger')
FIGURES = ('objective', 'upper', 'residual', 'imbalance', 'bound_usage', 'usage')


def answers(seed, bound):
    """Yield a problem with answers to it: a solver's, and spoiled ones."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, bound=bound)
    load = random_load(rng, grasp) if seed % 2 else None
    problem = build_problem(grasp, TaskWrench(rng.normal(size=6)), load)
    answer = clarabel_solver.run(problem)
    yield problem, answer
    yield problem, dataclasses.replace(answer, shares=1.1 * answer.shares)
    yield problem, dataclasses.replace(answer, values=2.0 * answer.values)
    yield problem, dataclasses.replace(answer, values=-answer.values)
    for spread in (0.1, 10.0):
        yield problem, dataclasses.replace(
            answer, multipliers=answer.multipliers + spread * rng.normal(
                size=len(answer.multipliers)))


@pytest.mark.parametrize('bound', BOUNDS)
def test_figures_are_those_of_numpy(bound, monkeypatch):
    for seed in range(30):
        for problem, answer in answers(seed, bound):
            judged = proof.prove(problem, answer.shares, answer.values, answer.multipliers)
            with monkeypatch.context() as plain:
                plain.setattr(kernel_solver, 'handles', lambda problem: False)
                again = proof.prove(problem, answer.shares, answer.values, answer.multipliers)
            for figure in FIGURES:
                assert getattr(judged, figure) == pytest.approx(
                    getattr(again, figure), rel=1e-9, abs=EXACT)
            for vector in ('cone_usage', 'multiplier', 'bound_multiplier'):
                assert getattr(judged, vector) == pytest.approx(
                    getattr(again, vector), rel=1e-9, abs=EXACT)
            assert judged.holds == again.holds


@pytest.mark.parametrize('bound', BOUNDS)
def test_infeasibility_is_that_of_numpy(bound, monkeypatch):
    for seed in range(100):
        problem, _ = next(answers(2 * seed + 1, bound))
        direction = np.random.default_rng(seed).normal(size=6)
        judged = infeasibility.infeasibility_margin(problem, direction)
        with monkeypatch.context() as plain:
            plain.setattr(kernel_solver, 'handles', lambda problem: False)
            assert judged == pytest.approx(infeasibility.infeasibility_margin(problem, direction))


@pytest.mark.parametrize('spoiled', [None, 'alpha', 'shares', 'multipliers'])
def test_many_are_judged_as_one(spoiled):
    for seed in range(60):
        rng = np.random.default_rng(seed)
        grasp = degenerate_grasp(rng)
        if grasp.bound == 'l2':
            continue
        load = degenerate_load(rng, grasp)
        problem = build_problem(grasp, TaskWrench(rng.normal(size=6)), load)
        answer = clarabel_solver.run(problem)
        told = {'alpha': answer.values.copy(), 'multipliers': answer.multipliers[None, :6].copy(),
                'shares': np.ascontiguousarray(answer.shares[None][:, :, (2, 0, 1, 3)])}
        if spoiled:
            told[spoiled][:] *= np.nan
        scaled = Scaled.of(grasp)
        status, upper = np.array([1], np.int8), np.empty(1)
        one = proof.prove(problem, told['shares'][0][:, (1, 2, 0, 3)], told['alpha'].copy(),
                          told['multipliers'][0])
        judge.judge_many(
            TOLERANCES, scaled.blocks, np.zeros(1, np.int64), scaled.groups, scaled.group_count,
            problem.virtual.columns.T.copy(), problem.scaled_external_wrench[None].copy(),
            scaled.reaches, scaled.least_caps, scaled.units, np.ones(1), told['alpha'],
            told['shares'], told['multipliers'], status, upper, np.empty((0, len(grasp), 4)))
        assert (status[0] == judge.OPTIMAL) == one.holds
        assert told['alpha'][0] == (one.objective if one.holds else 0.0)
        # without a number for alpha only zero can be proved
        assert not spoiled or not one.holds or (spoiled == 'alpha' and one.objective == 0.0)

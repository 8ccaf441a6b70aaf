# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The core against the same problems stated in CVXPY; ``python -m benchmarks`` asks 1,000."""

import dataclasses

from benchmarks.random_grasps import BOUNDS, random_grasp, random_joint_limits, random_load
import cvxpy as cp
from grasp_quality import evaluate, force_closure, minimum_forces, reference, TaskCone, TaskWrench
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest
from tolerances import SOLVER


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('loaded', [False, True])
def test_task_wrenches(bound, loaded):
    for seed in range(12):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        wrench, load = rng.normal(size=6), random_load(rng, grasp) if loaded else None
        stated = reference.state_task_wrench(grasp, wrench, load)
        assert stated.solve()
        assert evaluate(grasp, TaskWrench(wrench), external_wrench=load).alpha == pytest.approx(
            float(stated.value.value), abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_barrier(bound):
    for seed in range(3):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=5, bound=bound)
        wrench, load = -random_load(rng, grasp), random_load(rng, grasp)
        stated = reference.state_task_wrench(grasp, wrench, load, barrier_weight=0.1)
        assert stated.solve(tol_gap_abs=1e-8, tol_gap_rel=1e-8, tol_feas=1e-8)
        solution = evaluate(grasp, TaskWrench(wrench), external_wrench=load, barrier_weight=0.1)
        # an optimum that is flat is known to the root of its objective's tolerance only
        assert solution.alpha == pytest.approx(float(stated.value.value), abs=1e-3)
        assert solution.forces == pytest.approx(stated.forces.value, abs=1e-2)


@pytest.mark.parametrize('bound', BOUNDS)
def test_task_cones(bound):
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        task = TaskCone(*rng.normal(size=(3, 6)), rng.uniform(0.1, 1.2), surface_samples=0)
        load = random_load(rng, grasp)
        stated = reference.state_task_cone(grasp, task, load)
        assert stated.solve()
        solution = evaluate(grasp, task, external_wrench=load)
        assert solution.alpha == pytest.approx(stated.value.value[0], abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_minimum_forces(bound):
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        load = random_load(rng, grasp)
        stated = reference.state_minimum_forces(grasp, load)
        assert stated.solve()
        assert minimum_forces(grasp, load).peak == pytest.approx(
            float(stated.value.value), abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_force_closure(bound):
    for seed in range(6):
        grasp = random_grasp(np.random.default_rng(seed), bound=bound)
        stated = reference.state_force_closure(grasp)
        assert stated.solve()
        assert force_closure(grasp).margin == pytest.approx(float(stated.value.value), abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('gravity', [0.3, 0.9, 1.2])
def test_joint_limits(bound, gravity):
    """Also of a hand that must lean on the object to carry itself."""
    outcomes = set()
    for seed in range(12):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        load, wrench = random_load(rng, grasp), rng.normal(size=6)
        grasp = dataclasses.replace(
            grasp, joint_limits=random_joint_limits(
                rng, grasp, 10.0 ** rng.uniform(-1.0, 0.5), gravity))
        for task in (TaskWrench(wrench), TaskCone(
                *rng.normal(size=(3, 6)), rng.uniform(0.1, 1.2), surface_samples=0)):
            solution = evaluate(grasp, task, external_wrench=load)
            state = reference.state_task_cone if isinstance(task, TaskCone) else (
                lambda *given: reference.state_task_wrench(given[0], wrench, load))
            stated = state(grasp, task, load)
            assert stated.solve() == solution.feasible
            outcomes.add(solution.feasible)
            if solution.feasible:
                assert solution.alpha == pytest.approx(
                    np.ravel(stated.value.value)[0], abs=SOLVER)
        stated = reference.state_minimum_forces(grasp, load)
        peak = minimum_forces(grasp, load).peak
        assert stated.solve() == np.isfinite(peak)
        if np.isfinite(peak):
            assert peak == pytest.approx(float(stated.value.value), abs=SOLVER)
        stated = reference.state_force_closure(grasp)
        assert force_closure(grasp).margin == pytest.approx(
            float(stated.value.value) if stated.solve() else 0.0, abs=SOLVER)
    assert outcomes == {True, False}


def test_the_reference_knows_the_closed_forms_too():
    stated = reference.state_task_wrench(antipodal(0.5), FY)
    assert stated.solve() and stated.value.value == pytest.approx(1.0, rel=SOLVER)
    cone = TaskCone(-FX, FY, FZ, np.deg2rad(60.0))
    stated = reference.state_task_cone(three_finger(), cone)
    assert stated.solve() and stated.value.value[0] == pytest.approx(1.8660254, rel=SOLVER)


def test_infeasible_is_not_solved():
    stated = reference.state_task_wrench(antipodal(0.5), FX, external_wrench=-2.0 * FY)
    assert not stated.solve()


def test_constraints_of_ones_own():
    """A finger that is to press with at least 0.2 N."""
    stated = reference.state_task_wrench(antipodal(0.5), FX)
    own = cp.Problem(stated.problem.objective,
                     [*stated.problem.constraints, stated.forces[1, 2] >= 0.2])
    own.solve(**reference.SOLVER_SETTINGS)
    assert stated.value.value == pytest.approx(0.8, rel=SOLVER)

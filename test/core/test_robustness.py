# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Degenerate grasps, tasks and loads: the right answer or a clear error, never anything else."""

import dataclasses

from answer_checks import check_forces, check_task_wrench
from benchmarks.random_grasps import degenerate_grasp, degenerate_load, degenerate_wrench
from grasp_quality import (
    Contact, ContactModel, evaluate, force_closure, Grasp, minimum_forces, SolverError, Status,
    TaskWrench)
from known_grasps import antipodal, FX, FY, FZ, three_finger, TX
import numpy as np
import pytest
from tolerances import SOLVER

PROBLEMS = 400
FAILURES = 4  # of them, at most; ``python -m benchmarks`` counts over 20,000


def degenerate(seed):
    """Grasp, wrench and load of a seed."""
    rng = np.random.default_rng(seed)
    grasp = degenerate_grasp(rng)
    return grasp, degenerate_wrench(rng, grasp), degenerate_load(rng, grasp)


def test_task_wrenches():
    failures = []
    for seed in range(PROBLEMS):
        grasp, wrench, load = degenerate(seed)
        try:
            solution = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
        except SolverError as error:
            assert error.problem is not None and 'no answer could be proved' in str(error)
            failures.append(seed)
        else:
            check_task_wrench(solution, wrench, load)
    assert len(failures) <= FAILURES


def test_minimum_forces():
    failures = []
    for seed in range(PROBLEMS // 2):
        grasp, wrench, load = degenerate(seed)
        load = -wrench if load is None else load
        try:
            held = minimum_forces(grasp, load)
        except SolverError:
            failures.append(seed)
            continue
        if held.status is Status.OPTIMAL:
            check_forces(grasp, held.forces, np.zeros(6), load)
            assert held.peak <= 1.0 + SOLVER
        else:
            assert held.violation > 0.0 and held.peak > 1.0
    assert len(failures) <= FAILURES


def test_barrier_and_closure():
    failures = []
    for seed in range(PROBLEMS // 4):
        grasp, wrench, load = degenerate(seed)
        size = np.linalg.norm(grasp.scaled_wrench(wrench))
        try:
            closure = force_closure(grasp)
            assert 0.0 <= closure.margin <= 1.0 and 1 <= closure.rank <= 6
            solution = evaluate(
                grasp, TaskWrench(wrench), external_wrench=load, barrier_weight=0.1 / size)
        except SolverError:
            failures.append(seed)
            continue
        if solution.feasible:
            check_forces(grasp, solution.forces, solution.wrench, load)
            assert solution.alpha_lower <= solution.alpha <= solution.alpha_upper
    assert len(failures) <= FAILURES


@pytest.mark.parametrize('bound', ['linf', 'l1', 'l2'])
def test_two_hundred_contacts(bound):
    rng = np.random.default_rng(0)
    points = rng.normal(size=(200, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    grasp = Grasp([Contact(position=p, normal=-p, model=m)
                   for p, m in zip(points, 50 * [*ContactModel, ContactModel.PCWF])], bound)
    for wrench in (FX, FY + 0.3 * TX):
        check_task_wrench(evaluate(grasp, TaskWrench(wrench)), wrench)
    assert force_closure(grasp).closed


@pytest.mark.parametrize('apart', [0.0, 1e-15, 1e-12, 1e-9, 1e-6])
def test_contacts_on_top_of_each_other(apart):
    """Twins act as one contact with both caps."""
    grasp = Grasp([Contact(position=(x, i * apart, 0.0), normal=(-x, 0.0, 0.0))
                   for x in (-1.0, 1.0) for i in range(2)])
    solution = evaluate(grasp, TaskWrench(FY))
    assert solution.alpha == pytest.approx(2.0, rel=SOLVER)
    check_task_wrench(solution, FY)


@pytest.mark.parametrize('apart, least, most', [
    (0.0, 1.25, 1.25), (1e-12, 1.25, 1.25), (1e-9, 1.0, 1.25), (1e-6, 1.0, 1.0), (0.1, 1.0, 1.0)])
def test_all_contacts_at_one_point(apart, least, most):
    """The side push adds its friction; apart (that begins at 1e-8) its moment has no match."""
    grasp = Grasp([
        Contact(position=(1.0 + i * apart, 0.0, 0.0), normal=normal)
        for i, normal in enumerate([(1, 0, 0), (-1, 0, 0), (0, 1, 0)])])
    assert least - SOLVER <= evaluate(grasp, TaskWrench(FX)).alpha <= most + SOLVER
    assert evaluate(grasp, TaskWrench(TX)).alpha == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('mu', [1e-6, 1e-3, 1.0, 1e3])
def test_friction_over_nine_decades(mu):
    solution = evaluate(antipodal(mu), TaskWrench(FY))
    assert solution.alpha == pytest.approx(2.0 * mu, rel=1e-3 if mu < 1e-4 else SOLVER)
    check_task_wrench(solution, FY)


@pytest.mark.parametrize('ratio', [1e-6, 1e-3, 1e3, 1e6])
def test_caps_over_six_decades(ratio):
    solution = evaluate(antipodal(0.5, caps=(1.0, ratio)), TaskWrench(FX))
    assert solution.alpha == pytest.approx(1.0, rel=SOLVER)
    solution = evaluate(antipodal(0.5, caps=(1.0, ratio)), TaskWrench(FY))
    assert solution.alpha == pytest.approx(min(1.0, ratio), abs=SOLVER * max(1.0, ratio) * 1e-2)


def test_mixed_models_with_coefficients_of_zero():
    """FPC, PCWF with mu = 0 and SFCE with gamma = 0 are what their numbers say."""
    plain = three_finger(0.5).contacts

    def replaced(**fields):
        return Grasp([dataclasses.replace(plain[0], normal=None, **fields), plain[1], plain[2]])

    for wrench in (-FX, FY, FZ, -FX + 0.2 * TX):
        task = TaskWrench(wrench)
        smooth = evaluate(replaced(friction=0.0), task).alpha
        assert evaluate(replaced(model=ContactModel.FPC), task).alpha == pytest.approx(
            smooth, abs=SOLVER)
        rough = evaluate(replaced(model=ContactModel.SFCE, torsional_friction=0.0), task).alpha
        assert rough == pytest.approx(evaluate(Grasp(plain), task).alpha, abs=SOLVER)
        drill = replaced(model=ContactModel.SFCE, friction=0.0, torsional_friction=0.3)
        check_task_wrench(evaluate(drill, task), wrench)


@pytest.mark.parametrize('tilt', [1e-3, 1e-6, 1e-8])
def test_task_almost_out_of_range(tilt):
    """A twist about the axis of a point-contact pair, mixed into a force that it carries."""
    wrench = FY + tilt * TX
    solution = evaluate(antipodal(0.5), TaskWrench(wrench))
    check_task_wrench(solution, wrench)
    assert solution.pinned
    assert solution.alpha == pytest.approx(0.0, abs=max(SOLVER, 1e-8 / tilt))

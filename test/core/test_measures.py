# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The measures as users call them: loads, cones, maps, slip margins, and what they refuse."""

from answer_checks import check_forces, check_task_wrench
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, InvalidTaskError, slip_margin, SolverTimeoutError,
    Status, TaskCone, TaskWrench, wrench_map)
from known_grasps import antipodal, FX, FY, FZ, single, three_finger, TX, TZ
import numpy as np
import pytest
from tolerances import SOLVER


@pytest.mark.parametrize('bound', BOUNDS)
def test_random_answers_are_optimal(bound):
    for seed in range(25):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        wrench, load = rng.normal(size=6), random_load(rng, grasp)
        check_task_wrench(evaluate(grasp, TaskWrench(wrench)), wrench)
        loaded = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
        check_task_wrench(loaded, wrench, load)
        assert loaded.holdable and loaded.alpha_lower == 0.0


def test_load_makes_an_interval():
    """Two fingers, mu = 0.5: a lift against the load -3 FY begins to be possible at alpha 2."""
    solution = evaluate(antipodal(0.5), TaskWrench(-FY), external_wrench=-3.0 * FY)
    assert solution.alpha_interval == pytest.approx((2.0, 4.0), rel=SOLVER)
    assert not solution.holdable and not solution.pinned
    assert solution.status is Status.OPTIMAL


@pytest.mark.parametrize('weight, interval', [
    (0.0, (0.0, 1.0)), (0.2, (0.0, 0.8)), (0.999, (0.0, 0.001)), (1.0, (0.0, 0.0))])
def test_interval_shrinks_with_the_weight(weight, interval):
    solution = evaluate(antipodal(0.5), TaskWrench(FY), external_wrench=-weight * FY)
    assert solution.alpha_interval == pytest.approx(interval, abs=SOLVER)
    assert solution.holdable


def test_overload_is_infeasible():
    solution = evaluate(antipodal(0.5), TaskWrench(FY), external_wrench=-1.2 * FY)
    assert solution.status is Status.INFEASIBLE and not solution.feasible
    assert (solution.alpha, solution.alpha_upper) == solution.alpha_interval == (0.0, 0.0)
    assert solution.forces.shape == (0, 4) and solution.cone_usage.shape == (0,)
    assert solution.friction_margin == 0.0 and not solution.wrench.any()
    assert not solution.holdable and solution.proof is None


@pytest.mark.parametrize('excess, status', [
    (-1e-3, Status.OPTIMAL), (-1e-6, Status.OPTIMAL), (-1e-10, Status.OPTIMAL),
    (0.0, Status.OPTIMAL), (1e-7, Status.INFEASIBLE), (1e-6, Status.INFEASIBLE),
    (1e-3, Status.INFEASIBLE)])
@pytest.mark.parametrize('bound, most', [('linf', 1.0), ('l2', np.sqrt(0.5)), ('l1', 0.5)])
def test_loads_at_the_edge(bound, most, excess, status):
    grasp = antipodal(0.5, bound=bound)
    load = -most * (1.0 + excess) * FY
    solution = evaluate(grasp, TaskWrench(FY), external_wrench=load)
    assert solution.status is status
    check_task_wrench(solution, FY, load)


def test_task_that_the_grasp_cannot_span_is_pinned():
    """A pair of point contacts carries no twist about its axis, so the load alone fixes alpha."""
    solution = evaluate(antipodal(0.5), TaskWrench(TX), external_wrench=0.3 * TX)
    assert solution.pinned
    assert solution.alpha_interval == pytest.approx((0.3, 0.3), rel=SOLVER)
    assert evaluate(antipodal(0.5), TaskWrench(TX)).pinned
    assert not evaluate(antipodal(0.5, 0.1), TaskWrench(TX), external_wrench=0.1 * TX).pinned
    assert not evaluate(antipodal(0.5), TaskWrench(FY), external_wrench=-0.1 * FY).pinned


def test_cone_reaches_at_least_as_far_as_its_axis():
    for seed in range(10):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng)
        task = TaskCone(*rng.normal(size=(3, 6)), rng.uniform(0.0, 1.0), surface_samples=16)
        solution = evaluate(grasp, task)
        assert solution.alpha >= solution.alpha_axis - SOLVER
        assert solution.alpha >= solution.alpha_worst - SOLVER
        check_forces(grasp, solution.forces, solution.wrench)
        directions = np.stack([task.axis, task.lateral_x, task.lateral_y], axis=1)
        alpha_z, *sides = np.linalg.lstsq(directions, solution.wrench)[0]
        assert alpha_z == pytest.approx(solution.alpha, abs=1e-5)
        assert np.hypot(*sides) <= np.tan(task.half_angle) * alpha_z + 1e-5


def test_cone_of_half_angle_zero_is_its_axis():
    solution = evaluate(three_finger(), TaskCone(FY, FX, FZ, 0.0))
    assert solution.alpha == pytest.approx(solution.alpha_axis, rel=SOLVER)
    assert solution.alpha == pytest.approx(solution.alpha_worst, rel=SOLVER)
    assert solution.wrench == pytest.approx(solution.alpha * FY, abs=SOLVER)


def test_worst_of_the_surface_by_hand():
    """Antipodal pair, cone around y with lateral x of half angle 45 degrees."""
    task = TaskCone(FY, FX, 1e-9 * FX, np.deg2rad(45.0), surface_samples=4)
    solution = evaluate(antipodal(0.5), task)
    assert solution.alpha_axis == pytest.approx(1.0, rel=SOLVER)
    # F = (1, 1): each finger carries alpha / 2 across, the weaker one with a normal of 1 - alpha
    assert solution.alpha_worst == pytest.approx(0.5, rel=SOLVER)


def test_cone_without_samples_leaves_the_worst_out():
    task = TaskCone(FX, FY, FZ, 0.3, surface_samples=0)
    assert evaluate(three_finger(), task).alpha_worst is None


def test_cone_against_an_overload_is_infeasible():
    solution = evaluate(antipodal(0.5), TaskCone(FX, FZ, FY, 0.1), external_wrench=-5.0 * FY)
    assert solution.status is Status.INFEASIBLE and solution.alpha_axis == 0.0


def test_map_is_one_wrench_after_the_other():
    rng = np.random.default_rng(1)
    grasp = random_grasp(rng, count=5, bound='linf')
    directions, load = rng.normal(size=(12, 6)), random_load(rng, grasp)
    found = wrench_map(grasp, directions, external_wrench=load, forces=True)
    assert found.alpha == pytest.approx(
        [evaluate(grasp, TaskWrench(d), external_wrench=load).alpha for d in directions],
        rel=SOLVER, abs=SOLVER)
    assert found.forces.shape == (12, 5, 4) and found.feasible.all()
    for direction, alpha, forces in zip(directions, found.alpha, found.forces):
        check_forces(grasp, forces, alpha * direction, load)
    assert wrench_map(grasp, directions).forces is None


def test_map_marks_what_is_infeasible():
    found = wrench_map(antipodal(0.5), [FX, -FY, FY], external_wrench=-2.0 * FY, forces=True)
    assert found.feasible.tolist() == [False, True, False]
    assert found.alpha == pytest.approx([0.0, 3.0, 0.0], abs=SOLVER)
    assert not found.forces[0].any() and found.forces[1].any()


def test_slip_margin():
    grasp = antipodal(0.5, 0.1)
    forces = [[0.3, 0.4, 2.0, 0.0], [0.0, 0.0, 1.0, 0.1]]
    assert slip_margin(grasp, forces) == pytest.approx([0.5, 0.0], abs=SOLVER)
    slipping = slip_margin(grasp, [[1.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    assert slipping == pytest.approx([-1.0, 1.0])


def test_slip_margin_of_models_that_carry_less():
    grasp = Grasp([
        Contact(position=(0, 0, 0), normal=(0, 0, 1), model=ContactModel.FPC),
        Contact(position=(0, 0, 0), normal=(0, 0, 1), model=ContactModel.PCWF, friction=0.5)])
    margin = slip_margin(grasp, [[0.1, 0.0, 1.0, 0.0], [0.1, 0.0, 1.0, 0.3]])
    assert margin[0] == -np.inf
    assert margin[1] == pytest.approx(0.8)


@pytest.mark.parametrize('call, message', [
    (lambda: evaluate(antipodal(), FX), 'task must be a TaskWrench, .* got ndarray'),
    (lambda: evaluate(antipodal(), TaskWrench(FX), barrier_weight=-1.0),
     'barrier_weight must be at least 0'),
    (lambda: evaluate(antipodal(), TaskWrench(FX), barrier_weight=np.nan),
     'barrier_weight must be finite'),
    (lambda: evaluate(antipodal(), TaskWrench(FX), external_wrench=[1, 2]),
     r'external_wrench must have shape \(6\)'),
    (lambda: wrench_map(antipodal(), [[1, 2, 3]]), r'directions must have shape \(n, 6\)'),
    (lambda: wrench_map(antipodal(), [FX, 0 * FX]), r'directions must not be zero, but rows .1.'),
    (lambda: wrench_map(antipodal(), np.zeros((0, 6))), 'directions must hold at least one'),
    (lambda: slip_margin(antipodal(), [[0, 0, 1, 0]]),
     r'forces must have shape \(2, 4\)'),
    (lambda: slip_margin(antipodal(), np.full((2, 4), np.nan)), 'forces must be finite'),
])
def test_error_names_value_and_rule(call, message):
    with pytest.raises(InvalidTaskError, match=message):
        call()


@pytest.mark.parametrize('bound', ['linf', 'l2'])
def test_time_limit(bound):
    with pytest.raises(SolverTimeoutError, match='time limit'):
        evaluate(three_finger(bound=bound), TaskWrench(FX), time_limit_s=1e-9)


def test_answers_are_frozen_and_read_only():
    solution = evaluate(antipodal(0.5, 0.1), TaskWrench(FY + TZ), external_wrench=-0.1 * FY)
    for name in ('wrench', 'forces', 'cone_usage', 'dalpha_dexternal_wrench', 'dalpha_dmax_force',
                 'dalpha_dfriction'):
        assert not getattr(solution, name).flags.writeable, name
    with pytest.raises(AttributeError):
        solution.alpha = 1.0
    assert not wrench_map(single(), [FX]).alpha.flags.writeable

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Prediction against physics on a few cases; ``make truth`` has them all."""

from dataclasses import replace

from benchmarks.truth.cases import random_case
from benchmarks.truth.felt import turned
from benchmarks.truth.gates import all_gates, CLOSE, errors, LAW, NEAR
from benchmarks.truth.references import four_edged_alpha, held_interval
from benchmarks.truth.trials import dclaw_results, directions, point_result, Results
from grasp_quality import evaluate, TaskWrench
from grasp_quality_hand.holding_forces import holding_forces
import numpy as np
import pytest

SEED = 1
CASES = (0, 3, 5)  # a cube with PCWF and a force, balls with SFCE, and PCWF with a torque


@pytest.fixture(scope='module')
def results():
    """Return a few pulls on both hands."""
    way = directions(7)[2:3]
    return Results([point_result(index, SEED) for index in CASES],
                   {f'{name}, PCWF': dclaw_results(name, 'PCWF', way)
                    for name in ('ball', 'cube')})


def test_a_grasp_holds_alpha_and_no_more(results):
    assert len(results.passive) == len(CASES)
    for pull in [point.optimised for point in results.points] + [
            pull.pulled for pull in results.passive]:
        assert errors([pull.ratio])[0] < CLOSE and pull.bound <= LAW
    for pull in results.dclaw['ball, PCWF'] + results.dclaw['cube, PCWF']:
        assert errors([pull.ratio])[0] < NEAR and pull.bound <= LAW


def test_wrong_predictions_are_told_apart(results):
    for point in results.points:
        assert point.wrong[0] < 1.0 - CLOSE and point.wrong[1] > 1.0 + CLOSE
        assert min(point.four_edges) > 1.0 + CLOSE


def test_all_bounds_but_the_number_of_cases_are_kept_and_each_can_break(results):
    assert [gate.what for gate in all_gates(results) if not gate.kept] == [
        'Contact points: random cases']
    off = replace(results.points[0], optimised=replace(results.points[0].optimised, ratio=0.96))
    law = replace(results.points[0], optimised=replace(results.points[0].optimised, bound=1.002))
    for point, what in ((off, 'optimised forces: all'), (law, 'Bound law')):
        gates = all_gates(Results([point, *results.points[1:]], results.dclaw))
        assert any(what in gate.what and not gate.kept for gate in gates)


@pytest.mark.parametrize('index', range(4))
def test_less_freedom_of_the_forces_holds_less(index):
    case = random_case(index, SEED)
    alpha = evaluate(case.grasp, TaskWrench(case.task)).alpha
    normals = holding_forces(case.grasp, case.task).idle[:, 2]
    lowest, largest = held_interval(case.grasp, normals, case.task)
    assert lowest < 0.0 < largest < alpha
    held = held_interval(case.grasp, normals, case.task, four_edges=True)[1]
    assert held < largest or np.isnan(held)  # nan: such cones do not even balance the normals
    assert held_interval(case.grasp, normals, 2.0 * case.task)[1] == pytest.approx(
        largest / 2.0, rel=1e-4)
    assert four_edged_alpha(case.grasp, case.task) < alpha


def test_a_turned_rotation_has_the_normal_and_turns_no_more_than_needed():
    rng = np.random.default_rng(0)
    before, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    before[:, 0] *= np.linalg.det(before)
    normal = before[:, 2] + 0.1 * rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    after = turned(before, normal)
    assert np.allclose(after[:, 2], normal) and np.allclose(after.T @ after, np.eye(3))
    angle = np.arccos((np.trace(after @ before.T) - 1.0) / 2.0)
    assert angle == pytest.approx(np.arccos(normal @ before[:, 2]))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The dual problem: smallest forces that balance a load, and what is missing where none do."""

import dataclasses

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import InvalidTaskError, minimum_forces, Status
from known_grasps import antipodal, cube_of_eight, FX, FY, FZ, single, three_finger, TX
import numpy as np
import pytest
from tolerances import SOLVER


@pytest.mark.parametrize('bound, peak', [('linf', 0.2), ('l1', 0.4), ('l2', 0.2 * np.sqrt(2.0))])
def test_weight_between_two_fingers(bound, peak):
    held = minimum_forces(antipodal(0.5, bound=bound), -0.2 * FY)
    assert held.status is Status.OPTIMAL and held.feasible
    assert held.peak == pytest.approx(peak, rel=SOLVER)
    assert held.peak_lower <= held.peak * (1.0 + SOLVER)
    assert held.violation == 0.0
    assert held.forces[:, 2] == pytest.approx([0.2, 0.2], rel=1e-5)
    assert held.cone_usage == pytest.approx([1.0, 1.0], rel=SOLVER)
    assert held.friction_margin == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_random_loads(bound):
    for seed in range(15):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        load = random_load(rng, grasp)
        held = minimum_forces(grasp, load)
        assert held.status is Status.OPTIMAL and held.violation == 0.0
        assert 0.0 <= held.peak <= 1.0 + SOLVER
        assert held.peak_lower == pytest.approx(held.peak, abs=SOLVER)
        check_forces(grasp, held.forces, np.zeros(6), load)


def test_peak_is_proportional_to_the_load():
    grasp = three_finger()
    peaks = [minimum_forces(grasp, c * (FX + 0.3 * FZ)).peak / c for c in (1e-9, 1e-3, 0.5, 50.0)]
    assert peaks == pytest.approx([peaks[0]] * 4, rel=SOLVER)


def test_no_load_needs_no_forces():
    held = minimum_forces(antipodal(), np.zeros(6))
    assert (held.status, held.peak, held.violation) == (Status.OPTIMAL, 0.0, 0.0)
    assert not held.forces.any() and held.friction_margin == 1.0


@pytest.mark.parametrize('load, missing', [(-1.5 * FY, 0.5), (-3.0 * FX, 2.0)])
def test_overload_says_how_much_is_missing(load, missing):
    held = minimum_forces(antipodal(0.5), load)
    assert held.status is Status.INFEASIBLE and not held.feasible
    assert held.forces.shape == (0, 4)
    assert held.violation == pytest.approx(missing, rel=SOLVER)
    assert held.peak == pytest.approx(1.0 + missing, rel=SOLVER)
    assert held.friction_margin == 0.0


def test_a_load_that_no_forces_balance():
    held = minimum_forces(antipodal(0.5), TX)
    assert held.status is Status.INFEASIBLE
    assert held.peak == np.inf and held.violation == pytest.approx(1.0, rel=SOLVER)
    pulled = minimum_forces(single(), FX)
    assert pulled.peak == np.inf and pulled.violation == pytest.approx(1.0, rel=SOLVER)


@pytest.mark.parametrize('bound', BOUNDS)
def test_what_is_unbalanced_is_the_rest_of_a_load_that_can_be_held(bound):
    for seed in range(8):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        load = 20.0 * random_load(rng, grasp)
        held = minimum_forces(grasp, load)
        if held.feasible:
            assert not held.unbalanced.any() and held.reason == ''
            continue
        size = np.linalg.norm(grasp.scaled_wrench(held.unbalanced)) * grasp.force_scale
        assert size == pytest.approx(held.violation, rel=SOLVER)
        rest = minimum_forces(grasp, load - held.unbalanced)
        assert rest.peak <= 1.0 + 10.0 * SOLVER


def test_the_reason_has_the_units_of_what_is_missing():
    twist = minimum_forces(antipodal(0.5), 0.7 * TX)
    assert 'whatever the caps' in twist.reason and '(0.7, 0, 0) N m' in twist.reason
    assert 'inf' not in twist.reason and ' N is' not in twist.reason
    heavy = minimum_forces(antipodal(0.5), -1.5 * FY)
    assert '1.5 times the caps' in heavy.reason and '(0, -0.5, 0) N is' in heavy.reason


def test_violation_in_newtons_whatever_the_caps():
    grasp = cube_of_eight(0.5)
    for cap in (1e-3, 1e3):
        scaled = dataclasses.replace(grasp, contacts=dataclasses.replace(
            grasp.contacts, max_normal_forces=np.full(8, cap)))
        held = minimum_forces(scaled, -5.0 * cap * FY)
        assert held.violation == pytest.approx(cap, rel=SOLVER)


@pytest.mark.parametrize('load, message', [
    ([1, 2], r'external_wrench must have shape \(6\)'),
    ([np.nan] * 6, 'external_wrench must be finite')])
def test_error_names_value_and_rule(load, message):
    with pytest.raises(InvalidTaskError, match=message):
        minimum_forces(antipodal(), load)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Lengths from 1 mm to 10 m, forces from 1 mN to 10 kN: the same problem in other units."""

import dataclasses

from answer_checks import check_task_wrench
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    evaluate, force_closure, Grasp, minimum_forces, TaskCone, TaskPolytope, TaskWrench)
import numpy as np
import pytest
from tolerances import SOLVER

LENGTHS, FORCES = (1e-3, 0.05, 10.0), (1e-3, 1.0, 1e4)


def in_units(grasp, length, force):
    """Return the grasp with all lengths and forces multiplied."""
    return Grasp([
        dataclasses.replace(
            c, normal=None, position=c.position * length,
            torsional_friction=c.torsional_friction * length,
            max_normal_force=c.max_normal_force * force) for c in grasp.contacts], grasp.bound)


@pytest.mark.parametrize('length', LENGTHS)
@pytest.mark.parametrize('force', FORCES)
@pytest.mark.parametrize('bound', BOUNDS)
def test_alpha_scales_exactly(bound, force, length):
    rng = np.random.default_rng(7)
    grasp = random_grasp(rng, count=6, bound=bound)
    other = in_units(grasp, length, force)
    lengths = np.repeat([1.0, length], 3)
    wrench, load = -random_load(rng, grasp), random_load(rng, grasp)
    plain = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
    scaled = evaluate(other, TaskWrench(wrench * lengths), external_wrench=load * force * lengths)
    assert scaled.alpha == pytest.approx(plain.alpha * force, rel=SOLVER)
    check_task_wrench(scaled, wrench * lengths, load * force * lengths)
    assert scaled.dalpha_dmax_force == pytest.approx(plain.dalpha_dmax_force, abs=1e-4)
    assert scaled.dalpha_dfriction / force == pytest.approx(plain.dalpha_dfriction, abs=1e-4)
    assert scaled.dalpha_dexternal_wrench * lengths == pytest.approx(
        plain.dalpha_dexternal_wrench, abs=1e-3)
    margin = evaluate(other, TaskWrench(wrench * lengths), barrier_weight=0.1 * force)
    assert margin.alpha == pytest.approx(
        evaluate(grasp, TaskWrench(wrench), barrier_weight=0.1).alpha * force, rel=SOLVER)


@pytest.mark.parametrize('length', LENGTHS)
@pytest.mark.parametrize('force', FORCES)
def test_other_measures_scale_exactly(force, length):
    rng = np.random.default_rng(8)
    grasp = random_grasp(rng, count=7, bound='linf')
    other = in_units(grasp, length, force)
    lengths = np.repeat([1.0, length], 3)
    wrenches, load = rng.normal(size=(3, 6)), random_load(rng, grasp)
    assert force_closure(other).margin == pytest.approx(force_closure(grasp).margin, abs=SOLVER)
    assert force_closure(other).closed == force_closure(grasp).closed
    assert minimum_forces(other, load * lengths * force).peak == pytest.approx(
        minimum_forces(grasp, load).peak, rel=SOLVER)
    heavy = -30.0 * load
    assert minimum_forces(other, heavy * lengths * force).violation == pytest.approx(
        minimum_forces(grasp, heavy).violation * force, rel=1e-5)
    cone = evaluate(grasp, TaskCone(*wrenches, 0.4)).alpha
    assert evaluate(other, TaskCone(*(wrenches * lengths), 0.4)).alpha == pytest.approx(
        cone * force, rel=SOLVER)
    polytope = evaluate(grasp, TaskPolytope(wrenches))
    scaled = evaluate(other, TaskPolytope(wrenches * lengths))
    assert scaled.alphas == pytest.approx(polytope.alphas * force, rel=SOLVER)
    assert scaled.parallelotope_scale == pytest.approx(polytope.parallelotope_scale, abs=SOLVER)


@pytest.mark.parametrize('size', [1e-12, 1e-3, 1e6, 1e12])
def test_alpha_is_one_over_the_size_of_the_task(size):
    rng = np.random.default_rng(9)
    grasp, wrench = random_grasp(rng, count=6), rng.normal(size=6)
    plain = evaluate(grasp, TaskWrench(wrench)).alpha
    assert evaluate(grasp, TaskWrench(size * wrench)).alpha == pytest.approx(
        plain / size, rel=SOLVER)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The compiled kernel against Clarabel on the same problems."""

import dataclasses
import subprocess
import sys

from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    build_problem, clarabel_solver, kernel_solver, SolverTimeoutError, TaskCone, TaskWrench)
from grasp_quality.time_limit import TimeLimit
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest
from tolerances import SOLVER


@pytest.mark.parametrize('bound', [b for b in BOUNDS if b != 'l2'])
@pytest.mark.parametrize('sense', [1.0, -1.0])
def test_agrees_with_clarabel(bound, sense):
    solved = 0
    for seed in range(40):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, bound=bound)
        load = random_load(rng, grasp)
        problem = build_problem(grasp, TaskWrench(rng.normal(size=6)), load)
        problem = dataclasses.replace(problem, virtual=dataclasses.replace(
            problem.virtual, objective=sense * problem.virtual.objective))
        ours, theirs = kernel_solver.run(problem), clarabel_solver.run(problem)
        assert theirs.solved
        if ours.solved:
            solved += 1
            assert ours.values[0] == pytest.approx(theirs.values[0], abs=SOLVER)
        else:  # what it leaves has no interior: alpha cannot move
            assert theirs.values[0] < SOLVER
    assert solved >= 30


def test_handles_single_wrenches_and_grouped_bounds_only():
    grasp = three_finger()
    assert kernel_solver.handles(build_problem(grasp, TaskWrench(FX)))
    assert not kernel_solver.handles(build_problem(grasp, TaskCone(FX, FY, FZ, 0.3)))
    l2 = build_problem(three_finger(bound='l2'), TaskWrench(FX))
    assert not kernel_solver.handles(l2)


def test_overload_does_not_count_as_solved():
    problem = build_problem(antipodal(0.5), TaskWrench(FX), external_wrench=-2.0 * FY)
    assert not kernel_solver.run(problem).solved


def test_time_limit():
    with pytest.raises(SolverTimeoutError, match='time limit'):
        kernel_solver.run(build_problem(antipodal(), TaskWrench(FY)), limit=TimeLimit(0.0))


def test_answers_stay_when_others_are_asked_for():
    """Work arrays are not shared between calls."""
    problem = build_problem(antipodal(), TaskWrench(FY))
    first = kernel_solver.run(problem)
    kept = first.shares.copy()
    kernel_solver.run(build_problem(antipodal(0.1), TaskWrench(FX)))
    assert (first.shares == kept).all()


def test_a_new_process_takes_the_machine_code_from_the_cache():
    code = (
        'import time; from grasp_quality import *; g = Grasp([Contact((0, 0, 0), (1, 0, 0))]);'
        't = time.perf_counter(); evaluate(g, TaskWrench([1, 0, 0, 0, 0, 0]));'
        'print(time.perf_counter() - t)')
    seconds = [float(subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True).stdout)
        for _ in range(2)]
    assert seconds[1] < 3.0

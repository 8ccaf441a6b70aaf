# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The conic program: a task is a virtual contact; nothing needs a solver to be looked at."""

import subprocess
import sys

from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    build_problem, Contact, ContactModel, Grasp, InvalidTaskError, solve, TaskCone, TaskPolytope,
    TaskWrench)
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest
from tolerances import CLOSED_FORM, EXACT, SOLVER

CONE = TaskCone(FX, FY, FZ, 0.4)


def test_columns_of_the_task_stand_with_a_minus_beside_the_grasp_matrix():
    grasp = three_finger()
    problem = build_problem(grasp, TaskWrench(FY))
    layout = problem.layout
    E = -problem.E[:6]
    G = grasp.scaled_matrix.reshape(6, -1)
    assert (E[:, layout.contact_variables] == G[:, layout.contact_source]).all()
    assert -E[:, layout.virtual[0]] * np.linalg.norm(grasp.scaled_wrench(FY)) == pytest.approx(
        grasp.scaled_wrench(FY), abs=EXACT)


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('task', [TaskWrench(FX + 0.2 * FZ), CONE])
def test_answers_satisfy_the_equations_that_can_be_looked_at(bound, task):
    rng = np.random.default_rng(5)
    grasp = random_grasp(rng, count=6, bound=bound)
    problem = build_problem(grasp, task, random_load(rng, grasp))
    solution = solve(problem)
    u = np.zeros(problem.layout.shape[1])
    u[problem.layout.contact_variables] = grasp.shares(
        solution.forces).ravel()[problem.layout.contact_source]
    if isinstance(task, TaskWrench):
        u[problem.layout.virtual] = solution.alpha / problem.virtual.unit
        assert (problem.E @ u - problem.e)[:6] == pytest.approx(np.zeros(6), abs=1e-7)
    assert problem.c @ u <= solution.alpha_upper / problem.virtual.unit + CLOSED_FORM


def test_a_task_wrench_is_a_frictionless_virtual_contact():
    """In a grasp with the virtual contact added, alpha is its largest internal normal force."""
    grasp = three_finger()
    wrench = np.concatenate([[-0.3, 0.9, 0.1], np.zeros(3)])
    solution = solve(build_problem(grasp, TaskWrench(wrench)))
    normal = -wrench[:3]
    virtual = Contact(position=np.zeros(3), normal=normal, model=ContactModel.FPC)
    total = grasp.wrench(solution.forces)
    total[:3] += solution.alpha * np.linalg.norm(normal) * virtual.normal
    assert total == pytest.approx(np.zeros(6), abs=SOLVER)


def test_a_task_cone_is_a_virtual_contact_with_friction():
    solution = solve(build_problem(three_finger(), TaskCone(-FX, FY, FZ, np.deg2rad(60.0))))
    mu = np.tan(np.deg2rad(60.0))
    axis, side = -solution.wrench[0], np.linalg.norm(solution.wrench[1:3])
    assert side <= mu * axis + SOLVER


def test_same_numbers_in_other_units():
    """Scaled, a problem in millimetres and millinewtons is the one in metres and newtons."""
    grasp, task = three_finger(), TaskWrench(FX + 0.1 * FY)
    small = Grasp([Contact(position=1e-3 * c.position, rotation=c.rotation, friction=c.friction,
                           max_normal_force=1e-3) for c in grasp.contacts])
    first, second = build_problem(grasp, task), build_problem(small, task)
    assert second.E == pytest.approx(first.E, abs=EXACT)
    assert second.e == pytest.approx(first.e, abs=EXACT)


@pytest.mark.parametrize('make, message', [
    (lambda: build_problem(antipodal(), TaskPolytope([FX])),
     r'^build_problem takes a TaskWrench or a TaskCone, got TaskPolytope: .* evaluate\(\)$'),
    (lambda: build_problem(antipodal(), FX), 'takes a TaskWrench or a TaskCone, got ndarray'),
    (lambda: build_problem(antipodal(), TaskWrench(FX), [1.0]), 'external_wrench must have shape'),
    (lambda: build_problem(antipodal(), TaskWrench(FX), [np.inf] * 6), 'must be finite')])
def test_error_names_value_and_rule(make, message):
    with pytest.raises(InvalidTaskError, match=message):
        make()


def test_building_needs_no_solver():
    code = (
        'import sys\n'
        'from grasp_quality.problem import build_problem\n'
        'assert "grasp_quality.problem" in sys.modules\n'
        'import inspect, grasp_quality.problem, grasp_quality.layout\n'
        'for module in (grasp_quality.problem, grasp_quality.layout):\n'
        '    assert "clarabel" not in inspect.getsource(module)\n')
    subprocess.run([sys.executable, '-c', code], check=True)

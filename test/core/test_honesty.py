# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Past failures, kept: answers that were called optimal and were not."""

from grasp_quality import (
    Contact, evaluate, Grasp, InvalidContactError, InvalidGraspError, InvalidTaskError,
    minimum_forces, SolverError, TaskWrench)
import numpy as np
import pytest
from tolerances import SOLVER

PINCH = [Contact((-0.02, 0, 0), (1, 0, 0), max_normal_force=10.0),
         Contact((0.02, 0, 0), (-1, 0, 0), max_normal_force=10.0)]


def palm(cap):
    return Grasp([*PINCH, Contact((0, 0, -0.02), (0, 0, 1), max_normal_force=cap)])


@pytest.mark.parametrize('eps', [1e-12, 1e-3, 0.1, 1.0])
def test_forces_of_nearly_coincident_contacts_apply_what_alpha_says(eps):
    rng = np.random.default_rng(0)
    task = np.array([-1.0, -2.0, 0.0, 0.0, 0.0, -2.0])
    for _ in range(20):
        grasp = Grasp([Contact((1, 0, 0), rng.normal(size=3), max_normal_force=10.0),
                       Contact((1, 1e-9, 0), rng.normal(size=3), max_normal_force=10.0)])
        try:
            answer = evaluate(grasp, TaskWrench(task), barrier_weight=eps)
        except SolverError:
            continue
        np.testing.assert_allclose(
            grasp.wrench(answer.forces), answer.alpha * task, atol=10.0 * SOLVER)


@pytest.mark.parametrize('cap', [1e3, 1e5, 1e7])
def test_a_strong_palm_does_not_hold_what_only_weak_fingers_could(cap):
    answer = evaluate(palm(cap), TaskWrench([0, 0, 1, 0, 0, 0]), [0, 0, 20, 0, 0, 0])
    assert not answer.holdable
    assert answer.alpha_lower == pytest.approx(10.0, rel=1e-3)
    assert not np.isfinite(minimum_forces(palm(cap), [0, 0, 20, 0, 0, 0]).peak) \
        or minimum_forces(palm(cap), [0, 0, 20, 0, 0, 0]).peak > 1.0


def test_caps_too_far_apart_are_refused():
    with pytest.raises(InvalidGraspError, match='span a factor of 1e.06 at most'):
        palm(1e9)


def test_a_contact_out_of_this_world_is_refused():
    with pytest.raises(InvalidContactError, match='within 1000 m'):
        Contact((1e9, 0, 0), (0, 1, 0))


def test_a_load_too_small_to_matter_needs_no_forces():
    answer = minimum_forces(Grasp(PINCH), [0, 0, -1e-300, 0, 0, 0])
    assert answer.peak == 0.0 and not np.any(answer.forces)


@pytest.mark.parametrize('heavy', [1e3, 1e6, 1e9])
@pytest.mark.parametrize('bound', ['linf', 'l2'])
def test_a_load_beyond_all_caps_is_no_excuse_for_what_it_leaves_unbalanced(heavy, bound):
    """The task takes the load, so that alpha is known; the rest has to be balanced too."""
    task, load = np.array([0, 0, 10.9, 0, 0, 0]), np.array([0.3, 0.1, heavy, 0, 0, 0])
    grasp = Grasp(PINCH, bound)
    try:
        answer = evaluate(grasp, TaskWrench(task), load)
    except SolverError:
        return
    np.testing.assert_allclose(
        grasp.wrench(answer.forces) + load, answer.alpha * task, atol=10.0 * SOLVER)


@pytest.mark.parametrize('size', [1e-160, 1e-300, 5e-324])
def test_contacts_closer_than_atoms_are_in_one_place(size):
    grasp = Grasp([Contact((-size, 0, 0), (1, 0, 0)), Contact((size, 0, 0), (-1, 0, 0))])
    assert evaluate(grasp, TaskWrench([0, 1, 0, 0, 0, 0])).alpha == pytest.approx(1.0, rel=SOLVER)
    assert evaluate(grasp, TaskWrench([0, 0, 0, 0, 1, 0])).alpha == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('size', [1e51, 1e200, 1.7e308, 1e-51, 1e-300])
def test_numbers_whose_products_leave_float64_are_refused(size):
    with pytest.raises(InvalidContactError, match='max_normal_force'):
        Contact((0, 0, 0), (0, 0, 1), max_normal_force=size)
    with pytest.raises(InvalidTaskError, match='task_wrench'):
        TaskWrench([size, 0, 0, 0, 0, 0])

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Laws that alpha obeys on every grasp; each on random grasps of all models and bounds."""

import dataclasses

from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    Contact, evaluate, force_closure, Grasp, minimum_forces, Status, TaskCone, TaskWrench)
from grasp_quality.wrench import transform
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tolerances import SOLVER

SEEDS = range(6)
each_seed = pytest.mark.parametrize('seed', SEEDS)
each_bound = pytest.mark.parametrize('bound', BOUNDS)


def alpha(grasp, wrench, **arguments):
    """Alpha of a task wrench."""
    return evaluate(grasp, TaskWrench(wrench), **arguments).alpha


def changed(grasp, **fields):
    """Return the grasp with fields of all its contacts changed; values are functions of one."""
    return Grasp([
        dataclasses.replace(c, normal=None, **{name: f(c) for name, f in fields.items()})
        for c in grasp.contacts], grasp.bound)


def close(value):
    """Equal within the solver's tolerance, relative to the larger of value and 0.01."""
    return pytest.approx(value, rel=SOLVER, abs=0.01 * SOLVER)


@pytest.fixture
def problem(request):
    """Grasp, wrench and load, of the test's seed and bound."""
    arguments = request.node.callspec.params
    rng = np.random.default_rng(arguments['seed'])
    grasp = random_grasp(rng, bound=arguments.get('bound'))
    return grasp, rng.normal(size=6), random_load(rng, grasp), rng


@each_seed
@each_bound
def test_caps_times_c_give_alpha_times_c(problem, seed, bound):
    grasp, wrench, load, _ = problem
    larger = changed(grasp, max_normal_force=lambda c: 3.0 * c.max_normal_force)
    assert alpha(larger, wrench) == close(3.0 * alpha(grasp, wrench))
    assert alpha(larger, wrench, external_wrench=3.0 * load) == close(
        3.0 * alpha(grasp, wrench, external_wrench=load))


@each_seed
@each_bound
def test_task_times_c_gives_alpha_over_c(problem, seed, bound):
    grasp, wrench, load, _ = problem
    assert alpha(grasp, 7.0 * wrench, external_wrench=load) == close(
        alpha(grasp, wrench, external_wrench=load) / 7.0)


@each_seed
def test_rigid_motion_of_everything_changes_nothing(problem, seed):
    grasp, wrench, load, rng = problem
    R = Rotation.random(rng=rng).as_matrix()
    p = 5.0 * rng.normal(size=3)
    moved = changed(grasp, position=lambda c: R @ c.position + p,
                    rotation=lambda c: R @ c.rotation)
    before = evaluate(grasp, TaskWrench(wrench), external_wrench=load)
    after = evaluate(moved, TaskWrench(transform(wrench, R, p)),
                     external_wrench=transform(load, R, p))
    assert after.alpha == close(before.alpha)
    assert after.alpha_interval == close(before.alpha_interval)


@each_seed
def test_choice_of_the_origin_changes_nothing(problem, seed):
    grasp, wrench, load, rng = problem
    origin = 20.0 * rng.normal(size=3)
    moved = changed(grasp, position=lambda c: c.position - origin)

    def about(w):
        return transform(w, np.eye(3), -origin)

    cone = TaskCone(wrench, rng.normal(size=6), rng.normal(size=6), 0.4)
    moved_cone = TaskCone(about(wrench), about(cone.lateral_x), about(cone.lateral_y), 0.4)
    assert alpha(moved, about(wrench), external_wrench=about(load)) == close(
        alpha(grasp, wrench, external_wrench=load))
    assert evaluate(moved, moved_cone).alpha == close(evaluate(grasp, cone).alpha)
    assert minimum_forces(moved, about(load)).peak == close(minimum_forces(grasp, load).peak)


@each_seed
@each_bound
def test_choice_of_the_tangents_changes_nothing(problem, seed, bound):
    grasp, wrench, _, rng = problem
    turned = changed(grasp, rotation=lambda c: c.rotation @ Rotation.from_rotvec(
        [0.0, 0.0, rng.uniform(0.0, 2.0 * np.pi)]).as_matrix())
    assert alpha(turned, wrench) == close(alpha(grasp, wrench))


@each_seed
@each_bound
def test_order_of_contacts_changes_nothing(problem, seed, bound):
    grasp, wrench, load, rng = problem
    order = rng.permutation(len(grasp))
    other = Grasp([grasp.contacts[i] for i in order], grasp.bound)
    before = evaluate(grasp, TaskWrench(wrench), external_wrench=load, barrier_weight=0.1)
    after = evaluate(other, TaskWrench(wrench), external_wrench=load, barrier_weight=0.1)
    assert after.alpha == close(before.alpha)
    if before.status is Status.OPTIMAL:  # with a barrier the forces are unique
        assert after.forces == pytest.approx(before.forces[order], abs=1e-4)


@each_seed
def test_another_contact_never_lowers_alpha_under_linf(seed):
    rng = np.random.default_rng(seed)
    contacts = random_grasp(rng, count=8).contacts
    wrench = rng.normal(size=6)
    alphas = [alpha(Grasp(contacts[:k], 'linf'), wrench) for k in range(1, 9)]
    assert (np.diff(alphas) >= -SOLVER).all()


@each_seed
def test_order_of_the_bounds(seed):
    rng = np.random.default_rng(seed)
    grasp, wrench = random_grasp(rng), rng.normal(size=6)
    l1, l2, finger, linf = (
        alpha(Grasp(grasp.contacts, b), wrench) for b in ('l1', 'l2', 'finger', 'linf'))
    assert l1 <= l2 + SOLVER and l2 <= linf + SOLVER and linf <= len(grasp) * l1 + SOLVER
    assert l1 <= finger + SOLVER and finger <= linf + SOLVER


@each_seed
@each_bound
def test_alpha_times_the_smallest_peak_is_one(seed, bound):
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=7, bound=bound)
    wrench = rng.normal(size=6)
    found = alpha(grasp, wrench)
    held = minimum_forces(grasp, -wrench)
    if found > 1e-3:
        assert found * held.peak == pytest.approx(1.0, rel=1e-5)
        assert (held.status is Status.OPTIMAL) == (found >= 1.0)
    else:
        assert held.status is Status.INFEASIBLE and held.peak > 100.0


@each_seed
@each_bound
def test_more_friction_never_lowers_alpha(problem, seed, bound):
    grasp, wrench, load, _ = problem
    alphas = [
        alpha(changed(grasp, friction=lambda c: f * c.friction,
                      torsional_friction=lambda c: f * c.torsional_friction),
              wrench, external_wrench=load if f >= 1.0 else None)
        for f in (0.3, 1.0, 1.5, 4.0)]
    assert alphas[1] <= alphas[2] + SOLVER and alphas[2] <= alphas[3] + SOLVER
    assert alphas[0] <= alpha(grasp, wrench) + SOLVER


@each_seed
@each_bound
def test_inverse_alpha_is_convex_in_the_direction(problem, seed, bound):
    grasp, first, _, rng = problem
    second = rng.normal(size=6)
    ends = alpha(grasp, first), alpha(grasp, second)
    middle = alpha(grasp, 0.5 * (first + second))
    if min(ends) > 1e-3:
        assert 1.0 / middle <= 0.5 * (1.0 / ends[0] + 1.0 / ends[1]) + SOLVER
    else:
        assert middle >= 0.0


@each_seed
@each_bound
def test_a_task_is_a_virtual_contact(problem, seed, bound):
    """A load -alpha F can be held exactly as long as the task F can be applied alpha times."""
    grasp, wrench, load, _ = problem
    low, high = evaluate(grasp, TaskWrench(wrench), external_wrench=load).alpha_interval
    for share, status in ((0.999, Status.OPTIMAL), (1.001, Status.INFEASIBLE)):
        factor = share * high + (0.0 if share < 1.0 else 1e-3)
        assert minimum_forces(grasp, load - factor * wrench).status is status
    assert low == pytest.approx(0.0, abs=SOLVER)


@each_seed
def test_frictionless_virtual_contact_pushing_back_meets_alpha(seed):
    """A real FPC that pushes against the grasp is held up to a normal force of alpha."""
    rng = np.random.default_rng(seed)
    grasp = random_grasp(rng, count=6, bound='linf')
    against = Contact(position=rng.normal(size=3), normal=rng.normal(size=3))
    push = np.concatenate([against.normal, np.cross(against.position, against.normal)])
    found = alpha(grasp, -push)
    held = minimum_forces(grasp, found * push)
    assert held.peak == pytest.approx(1.0 if found > 1e-3 else 0.0, abs=1e-4)


@each_seed
@each_bound
def test_force_closure_means_every_direction(problem, seed, bound):
    grasp, _, _, rng = problem
    closure = force_closure(grasp)
    directions = np.vstack([np.eye(6), -np.eye(6), rng.normal(size=(6, 6))])
    alphas = np.array([alpha(grasp, d) for d in directions])
    if closure.closed:
        assert (alphas > 0.0).all() and closure.rank == 6
    else:
        assert closure.rank < 6 or closure.margin < 1e-6

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Explanations: what limits a task, slopes by the geometry, and what one change gives."""

import dataclasses

from benchmarks.derivatives import disagreement, problem
from grasp_quality import (
    Contact, evaluate, explain, Grasp, InvalidTaskError, JointLimits, TaskCone, TaskPolytope,
    TaskWrench)
from grasp_quality.contact import ContactModel
from grasp_quality.slopes import (
    changed, changed_along, FIELDS, largest_alpha, one_sided_slopes, turn)
from known_grasps import antipodal, cube_of_eight, FX, FY, FZ, single, three_finger, TZ
import numpy as np
import pytest
from tolerances import CLOSED_FORM, EXACT, SOLVER

AGREEMENT = 1e-4  # of the largest slope of its kind, with central differences
ONE_SIDED = 1e-3  # of what differences over a step of 1e-4 can tell


@pytest.mark.parametrize('seed', range(12))
def test_slopes_agree_with_central_differences(seed):
    grasp, task, load = problem(seed)
    found = explain(grasp, task, load)
    if found.uniqueness.smooth:
        assert disagreement(grasp, task, load, (0, 3)) <= AGREEMENT
    assert found.solution.alpha == pytest.approx(
        evaluate(grasp, task, external_wrench=load).alpha, rel=SOLVER)


@pytest.mark.parametrize('seed', range(6))
def test_moving_and_turning_everything_together_changes_nothing(seed):
    """The slopes by a rigid motion of all contacts are those of the wrenches moved back."""
    rng = np.random.default_rng(seed)
    grasp, task, load = problem(seed)
    s = evaluate(grasp, task, external_wrench=load)
    load = np.zeros(6) if load is None else load
    shift, spin = rng.normal(size=3), rng.normal(size=3)
    rest = load - s.alpha * task.wrench
    moved = (s.dalpha_dposition @ shift).sum()
    # contacts shifted by p: as if load and task were shifted by -p
    back = s.dalpha_dexternal_wrench[3:] @ np.cross(-shift, rest[:3])
    assert moved == pytest.approx(back, abs=SOLVER * max(1.0, abs(moved)) * 10)
    turned = (s.dalpha_drotation @ spin).sum() + np.einsum(
        'ki,ki->', s.dalpha_dposition, np.cross(spin, grasp.positions))
    back = -s.dalpha_dexternal_wrench @ np.concatenate(
        [np.cross(spin, rest[:3]), np.cross(spin, rest[3:])])
    assert turned == pytest.approx(back, abs=SOLVER * max(1.0, abs(turned)) * 10)


@pytest.mark.parametrize('seed', range(6))
def test_a_spin_about_the_normal_changes_nothing(seed):
    """Friction is the same in all directions."""
    grasp, task, load = problem(seed)
    s = evaluate(grasp, task, external_wrench=load)
    spin = np.einsum('ki,ki->k', s.dalpha_drotation, grasp.rotations[:, :, 2])
    assert np.abs(spin).max() <= 1e-4 * np.abs(s.dalpha_drotation).max()


def test_a_pair_whose_caps_differ_by_hand():
    """Alpha = 2 mu min(f): only the weaker cap counts, and one finger's friction is no gain."""
    found = explain(antipodal(0.5, caps=(1.0, 0.3)), TaskWrench(FY))
    assert found.limits == ('', 'slip')
    assert found.shares == pytest.approx([0.0, 1.0], abs=SOLVER)
    assert found.forward.max_force == pytest.approx([0.0, 1.0], abs=ONE_SIDED)
    assert found.forward.friction == pytest.approx([0.0, 0.0], abs=ONE_SIDED)
    assert found.backward.friction == pytest.approx([0.6, 0.6], abs=ONE_SIDED)
    assert found.best_change.contact == 'right' and found.best_change.kind == 'max_force'
    assert found.best_change.alpha == pytest.approx(1.0, rel=SOLVER)
    assert 'right by slip (100 %)' in found.text and 'one newton more' in found.text


def test_equal_caps_are_a_kink_to_either_side():
    """More cap for one finger gives nothing, less takes 2 mu."""
    found = explain(antipodal(0.5), TaskWrench(FY))
    assert not found.uniqueness.smooth and 'kink' in found.text
    assert f'limited by {found.solution.limiting_contact} by slip (50 %)' in found.text
    assert found.forward.max_force == pytest.approx([0.0, 0.0], abs=ONE_SIDED)
    assert found.backward.max_force == pytest.approx([1.0, 1.0], abs=ONE_SIDED)


def test_forces_that_are_not_unique_are_a_kink_too():
    found = explain(cube_of_eight(), TaskWrench(FX))
    assert not found.uniqueness.forces
    ahead, behind = found.forward.position, found.backward.position
    assert np.abs(ahead - behind).max() > 0.1


@pytest.mark.parametrize('seed', range(30))
def test_where_both_sides_differ_there_is_a_kink(seed):
    """What is called smooth has the same slope to both sides, on hand-made grasps as well."""
    rng = np.random.default_rng(seed)
    grasp = (antipodal, three_finger, cube_of_eight)[seed % 3](rng.uniform(0.2, 0.9))
    task = TaskWrench(np.eye(6)[rng.integers(6)] + (rng.normal(size=6) if seed % 2 else 0.0))
    found = explain(grasp, task)
    if found.uniqueness.smooth and found.solution.alpha > 1e-3:
        i = int(rng.integers(len(grasp)))
        for field in FIELDS:
            step = 1e-4
            here = found.solution.alpha
            ahead, behind = (evaluate(changed(grasp, i, field, h), task).alpha
                             for h in (step, -step))
            assert (ahead - here) / step == pytest.approx(
                (here - behind) / step, abs=0.02 * max(1.0, here))


def test_the_best_change_gives_what_a_new_solve_says():
    grasp, task, load = problem(2)
    best = explain(grasp, task, load).best_change
    assert best.alpha > evaluate(grasp, task, load).alpha
    i = grasp.names.index(best.contact)
    way = grasp.rotations[i].T @ best.direction if best.direction.any() else np.eye(3)[0]
    again = changed_along(grasp, i, best.kind, best.size * way)
    assert evaluate(again, task, load).alpha == pytest.approx(best.alpha, rel=SOLVER)


def test_a_cone_is_explained_too():
    found = explain(three_finger(0.4), TaskCone(-FX + 0.1 * FY, FY, FZ, 0.3))
    assert found.solution.alpha > 0.0 and found.text


def test_infeasible_explains_itself():
    found = explain(single(), TaskWrench(FX), external_wrench=-2.0 * FX)
    assert found.best_change is None and found.limits == ('',)
    assert 'cannot balance the external wrench' in found.text
    assert not found.forward.position.any() and not found.forward.rotation.any()


def test_a_useless_grasp_promises_nothing():
    found = explain(single(), TaskWrench(TZ))
    assert found.solution.alpha == pytest.approx(0.0, abs=SOLVER)
    assert 'alpha is pinned to 0' in found.text.lower() and 'limited by' not in found.text
    assert not found.shares.any() and found.best_change is None
    assert all(np.isfinite(getattr(found.forward, field)).all() for field in FIELDS)


def test_polytopes_are_explained_one_by_one():
    with pytest.raises(InvalidTaskError, match='one by one'):
        explain(antipodal(), TaskPolytope([FX, FY]))


def test_turn_is_a_rotation():
    R = turn(np.array([0.0, 0.0, np.pi / 2]))
    assert np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) == pytest.approx(
        R, abs=EXACT)
    assert (turn(np.zeros(3)) == np.eye(3)).all()
    grasp = Grasp([Contact(position=(1.0, 2.0, 3.0), normal=(1.0, 0.0, 0.0))])
    moved = changed(grasp, 0, 'position', 0.5, axis=2)
    assert moved.positions[0] == pytest.approx([1.5, 2.0, 3.0], rel=CLOSED_FORM)
    assert dataclasses.replace(grasp).positions[0].tolist() == [1.0, 2.0, 3.0]


def test_a_weak_joint_limits_the_task_and_is_named():
    """One joint carries the press of the right finger: alpha = 2 mu times what it can press."""
    pair = antipodal(0.5)
    torque = np.zeros((1, 2, 4))
    torque[0, 1, 2] = 0.1  # [N m] for a newton
    limits = JointLimits(('elbow',), [0.04], torque)
    found = explain(Grasp(pair.contacts, 'linf', limits), TaskWrench(FY))
    assert found.solution.alpha == pytest.approx(0.4, rel=SOLVER)
    assert found.joint_shares == pytest.approx([1.0], abs=SOLVER)
    assert found.shares == pytest.approx([0.0, 0.0], abs=SOLVER)
    assert 'elbow by its torque limit (100 %)' in found.text


def test_friction_of_a_frictionless_contact_has_no_slope():
    """The pad at x = -1 alone pulls across, mu for each newton that it presses with."""
    pad, plate = antipodal(0.5).contacts
    grasp = Grasp([pad, dataclasses.replace(plate, normal=None, model=ContactModel.FPC)])
    for side in one_sided_slopes(largest_alpha(TaskWrench(FY - TZ), None, None), grasp):
        assert side.friction == pytest.approx([1.0, 0.0], abs=ONE_SIDED)

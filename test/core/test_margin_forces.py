# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Forces to hold with: exact, strictly inside, unique, and smooth where optimal ones jump."""

from answer_checks import check_forces
from benchmarks.random_grasps import BOUNDS, random_grasp, random_load
from grasp_quality import (
    Contact, evaluate, Grasp, hold_forces, InvalidTaskError, Status, TaskWrench)
from grasp_quality.contact_set import ContactSet
from known_grasps import antipodal, FX, FY, FZ, single, three_finger, TX
import numpy as np
import pytest
from tolerances import CLOSED_FORM, SOLVER


def margin_objective(grasp, forces, cap_weight=1.0):
    """Sum of log det and of the bound's slacks, worked out from physical forces."""
    shares = np.divide(forces, grasp.scales * grasp.max_normal_forces[:, None],
                       where=grasp.scales > 0.0, out=np.zeros_like(forces))
    n, rest = shares[:, 2], (shares[:, [0, 1, 3]] ** 2).sum(axis=1)
    frictional = (grasp.scales[:, [0, 3]] > 0.0).any(axis=1)
    cones = np.log(np.where(frictional, n ** 2 - rest, n)).sum()
    if grasp.bound == 'l2':
        return cones + cap_weight * np.log(1.0 - n @ n)
    return cones + cap_weight * np.log(1.0 - np.bincount(grasp.groups, weights=n)).sum()


@pytest.mark.parametrize('cap_weight', [0.1, 1.0, 8.0])
def test_an_idle_pair_presses_with_a_closed_form(cap_weight):
    held = hold_forces(antipodal(caps=(3.0, 3.0)), cap_weight=cap_weight)
    assert held.status is Status.OPTIMAL
    normal = 3.0 * 2.0 / (2.0 + cap_weight)
    assert held.forces == pytest.approx(np.array([[0.0, 0.0, normal, 0.0]] * 2), abs=CLOSED_FORM)
    assert held.bound_usage == pytest.approx(normal / 3.0, rel=CLOSED_FORM)
    assert held.friction_margin == pytest.approx(1.0, abs=CLOSED_FORM)


def test_a_loaded_pair_balances_slip_against_caps():
    """2 mu^2 n / (mu^2 n^2 - t^2) = 1 / (1 - n), with t half of the load."""
    held = hold_forces(antipodal(0.5), external_wrench=-0.6 * FZ)
    n, t = held.forces[0, 2], np.linalg.norm(held.forces[0, :2])
    assert t == pytest.approx(0.3, rel=CLOSED_FORM)
    assert 2 * 0.25 * n / (0.25 * n * n - t * t) == pytest.approx(1 / (1 - n), rel=CLOSED_FORM)


@pytest.mark.parametrize('bound', BOUNDS)
def test_forces_apply_the_wrench_from_strictly_inside_and_none_nearby_do_better(bound):
    for seed in range(6):
        rng = np.random.default_rng(seed)
        grasp = random_grasp(rng, count=6, bound=bound)
        load, wrench = random_load(rng, grasp), rng.normal(size=6)
        alpha = 0.5 * evaluate(grasp, TaskWrench(wrench), external_wrench=load).alpha
        held = hold_forces(grasp, load, wrench, alpha)
        assert held.status is Status.OPTIMAL
        check_forces(grasp, held.forces, alpha * wrench, load)
        assert held.friction_margin > 0.0 and held.bound_usage < 1.0
        best = margin_objective(grasp, held.forces)
        active = (grasp.scales > 0.0).ravel()
        in_caps = grasp.matrix * grasp.max_normal_forces[:, None]
        null = np.linalg.svd(in_caps.reshape(6, -1)[:, active])[2][grasp.rank:]
        for _ in range(50):
            change = np.zeros(len(active))
            change[active] = null.T @ rng.normal(size=len(null))
            change = change.reshape(-1, 4) * grasp.max_normal_forces[:, None]
            change *= 1e-5 / np.abs(change).max()
            assert margin_objective(grasp, held.forces + change) <= best + CLOSED_FORM


def test_the_load_less_a_task_gives_the_forces_for_that_task_besides():
    """What a controller may follow; the forces of alpha over alpha do not carry the load."""
    load, task = -2.0 * FZ, 2.0 * FZ
    grasp = antipodal(0.5, caps=(10.0, 10.0))
    most = evaluate(grasp, TaskWrench(task), external_wrench=load)
    assert most.alpha == pytest.approx(4.0, rel=SOLVER)
    share = most.forces / most.alpha
    assert np.tensordot(grasp.matrix, share) + load == pytest.approx(0.25 * task, abs=SOLVER)
    for level in (0.0, 1.0, 3.0):
        held = hold_forces(grasp, load - level * task)
        check_forces(grasp, held.forces, level * task, load)
        assert held.friction_margin > 0.0
        assert held.forces == pytest.approx(
            hold_forces(grasp, load, task, level).forces, abs=CLOSED_FORM)


def test_the_order_of_contacts_does_not_matter():
    rng = np.random.default_rng(3)
    grasp = random_grasp(rng, count=5, bound='finger')
    load, order = random_load(rng, grasp), rng.permutation(5)
    other = Grasp(ContactSet.subset(grasp.contacts, order), 'finger')
    assert hold_forces(other, load).forces == pytest.approx(
        hold_forces(grasp, load).forces[order], abs=CLOSED_FORM)


def test_caps_and_load_scale_the_forces():
    rng = np.random.default_rng(5)
    contacts = random_grasp(rng, count=4, bound='linf').contacts
    load = random_load(rng, Grasp(contacts))
    bigger = Grasp(ContactSet(
        contacts.positions, contacts.rotations, contacts.models, contacts.friction,
        contacts.torsional_friction, 1e3 * contacts.max_normal_forces, contacts.names,
        contacts.fingers))
    assert hold_forces(bigger, 1e3 * load).forces == pytest.approx(
        1e3 * hold_forces(Grasp(contacts), load).forces, rel=SOLVER)


def test_a_start_changes_the_time_only():
    held = hold_forces(three_finger(), -0.3 * FZ)
    near = hold_forces(three_finger(friction=0.51), -0.31 * FZ)
    warm = hold_forces(three_finger(friction=0.51), -0.31 * FZ, start=held)
    assert warm.forces == pytest.approx(near.forces, abs=CLOSED_FORM)
    far = hold_forces(three_finger(friction=0.1), 0.2 * FX, start=held)
    assert far.forces == pytest.approx(
        hold_forces(three_finger(friction=0.1), 0.2 * FX).forces, abs=CLOSED_FORM)
    other = hold_forces(antipodal(), start=held)
    assert other.forces == pytest.approx(hold_forces(antipodal()).forces, abs=CLOSED_FORM)


def test_where_optimal_forces_jump_these_do_not():
    """Two fingers side by side share a push; which of them bears it turns on a hair."""
    def push(tilt):
        grasp = Grasp([
            Contact(position=(0.0, y, 0.0), normal=(1.0, 0.0, 0.0), friction=0.5)
            for y in (-1.0, 0.0, 1.0)])
        return hold_forces(grasp, None, FX + tilt * FY, 1.5).forces
    assert push(1e-6) == pytest.approx(push(-1e-6), abs=1e-5)


def test_an_edge_has_forces_without_margin():
    held = hold_forces(antipodal(0.5), external_wrench=-FZ)
    assert held.status is Status.OPTIMAL_NO_INTERIOR and held.feasible
    check_forces(antipodal(0.5), held.forces, np.zeros(6), -FZ)
    assert held.friction_margin == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('grasp, load', [
    (antipodal(0.5), -1.01 * FZ), (antipodal(0.5), TX), (single(), 0.5 * FX)])
def test_what_cannot_be_held_is_infeasible(grasp, load):
    held = hold_forces(grasp, load)
    assert held.status is Status.INFEASIBLE and not held.feasible
    assert held.forces.shape == (0, 4) and held.cone_usage.shape == (0,)
    assert held.friction_margin == 0.0 and held.bound_usage > 1.0


@pytest.mark.parametrize('arguments', [
    {'cap_weight': 0.0}, {'cap_weight': np.nan}, {'alpha': np.inf},
    {'external_wrench': [1.0] * 5}, {'task_wrench': [np.nan] * 6}])
def test_bad_arguments_are_refused(arguments):
    with pytest.raises(InvalidTaskError):
        hold_forces(antipodal(), **arguments)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A grasp's arrays: grasp matrix, scaling, rank, range."""

from benchmarks.random_grasps import random_grasp
from grasp_quality import Contact, ContactModel, Grasp, InvalidGraspError
from known_grasps import antipodal, FX, FY, single, three_finger, TX
import numpy as np
import pytest
from tolerances import CLOSED_FORM, EXACT

RNG = np.random.default_rng(0)


def pair(**fields):
    """Two contacts that share fields."""
    return [Contact(position=(x, 0, 0), normal=(-x, 0, 0), **fields) for x in (-1.0, 1.0)]


@pytest.mark.parametrize('contacts, bound, message', [
    ([], 'linf', 'a grasp needs at least one contact, got none'),
    (5, 'linf', 'contacts must be a sequence of Contact, got 5'),
    (['contact'], 'linf', "contacts must be Contact objects, got 'contact'"),
    (pair(name='thumb'), 'linf', r"contact names must be unique, given twice: \['thumb'\]"),
    (pair(), 'l0', "bound must be one of .* got 'l0'"),
    (pair(), 'finger', "bound 'finger' needs the finger of every contact"),
])
def test_error_names_value_and_rule(contacts, bound, message):
    with pytest.raises(InvalidGraspError, match=message):
        Grasp(contacts, bound)


def test_contacts_without_a_name_get_one():
    assert Grasp(pair()).names == ('contact_0', 'contact_1')


def test_matrix_is_force_and_moment_of_every_contact():
    grasp = random_grasp(RNG, count=5)
    forces = RNG.normal(size=(5, 4))
    wrench = np.zeros(6)
    for contact, x in zip(grasp.contacts, forces):
        force = contact.rotation @ x[:3]
        wrench[:3] += force
        wrench[3:] += np.cross(contact.position, force) + x[3] * contact.normal
    assert grasp.wrench(forces) == pytest.approx(wrench, abs=EXACT)


def test_scaled_matrix_maps_shares_to_scaled_wrenches():
    for seed in range(20):
        grasp = random_grasp(np.random.default_rng(seed))
        forces = np.random.default_rng(seed).normal(size=(len(grasp), 4)) * grasp.force_units
        scaled = grasp.scaled_matrix.reshape(6, -1) @ grasp.shares(forces).ravel()
        assert scaled == pytest.approx(grasp.scaled_wrench(grasp.wrench(forces)), rel=CLOSED_FORM)
        assert grasp.shares(forces) * grasp.force_units == pytest.approx(forces, rel=EXACT)


def test_arrays_are_read_only():
    grasp = three_finger()
    for name in ('positions', 'rotations', 'max_normal_forces', 'scales', 'matrix', 'center',
                 'scaled_matrix', 'force_units'):
        assert not getattr(grasp, name).flags.writeable, name


def test_contacts_given_as_a_generator():
    assert len(Grasp(c for c in pair())) == 2


@pytest.mark.parametrize('grasp, rank', [
    (single(), 3), (single(model=ContactModel.FPC), 1),
    (single(model=ContactModel.SFCE, torsional_friction=0.1), 4),
    (antipodal(), 5), (antipodal(0.5, 0.1), 6), (three_finger(), 6),
    (Grasp(pair(model=ContactModel.FPC)), 1), (Grasp(pair(friction=0.0)), 1),
    (Grasp(pair(friction=1e-6)), 5),
])
def test_rank(grasp, rank):
    assert grasp.rank == rank


def test_span():
    assert not antipodal().spans(TX) and not antipodal().spans(FX + 1e-6 * TX)
    assert antipodal().spans(FX + FY) and antipodal(0.5, 0.1).spans(TX)


def test_span_far_from_the_origin():
    offset = np.array([300.0, -200.0, 100.0])
    grasp = Grasp([Contact(position=c.position + offset, rotation=c.rotation)
                   for c in antipodal().contacts])
    assert grasp.spans(np.concatenate([FX[:3], np.cross(offset, FX[:3])]))
    assert not grasp.spans(TX)


@pytest.mark.parametrize('contacts, expected', [
    (pair(), 1.0),
    ([Contact(position=(3, 4, 0), normal=(1, 0, 0))], 4.0),
    ([Contact(position=(0, 0, 0), normal=(1, 0, 0))], 1.0),
    ([Contact(position=(3, 4, 0), normal=(1, 0, 0), model=ContactModel.SFCE,
              torsional_friction=0.02)], 0.02),
    ([Contact(position=(1.0, x, 0), normal=(1, 0, 0)) for x in (0.0, 2e-9)], 1.0),
    ([Contact(position=(1.0, x, 0), normal=(1, 0, 0)) for x in (0.0, 2e-6)], 1e-6),
])
def test_lever_arm(contacts, expected):
    assert Grasp(contacts).lever_arm == pytest.approx(expected, rel=CLOSED_FORM)

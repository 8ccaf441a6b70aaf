# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Force closure: rank and margin."""

from grasp_quality import Contact, ContactModel, force_closure, Grasp
from known_grasps import antipodal, cube_of_eight, single, three_finger
import numpy as np
import pytest
from tolerances import SOLVER


@pytest.mark.parametrize('grasp, closed, rank, margin', [
    (antipodal(0.5, 0.1), True, 6, 1.0),
    (antipodal(0.5, 0.1, bound='l1'), True, 6, 0.5),
    (antipodal(0.5, 0.1, bound='l2'), True, 6, np.sqrt(0.5)),
    (antipodal(0.5, 0.1, caps=(1.0, 4.0)), True, 6, 0.25),  # n <= 1 on both, of a cap of 4
    (antipodal(0.5), False, 5, 1.0),
    (antipodal(0.5, 0.0), False, 5, 1.0),
    (single(), False, 3, 0.0),
    (three_finger(0.5), True, 6, 1.0),
    (cube_of_eight(0.5, 'finger'), True, 6, 0.25),
])
def test_by_hand(grasp, closed, rank, margin):
    found = force_closure(grasp)
    assert (found.closed, found.rank) == (closed, rank)
    assert found.margin == pytest.approx(margin, abs=SOLVER)


def test_three_frictionless_contacts_press_but_do_not_close():
    angles = np.deg2rad([0.0, 120.0, 240.0])
    points = np.stack([np.cos(angles), np.sin(angles), np.zeros(3)], axis=1)
    found = force_closure(Grasp(
        [Contact(position=p, normal=-p, model=ContactModel.FPC) for p in points]))
    assert (found.closed, found.rank) == (False, 2)
    assert found.margin == pytest.approx(1.0, abs=SOLVER)


def test_contacts_on_one_side_have_rank_but_no_internal_force():
    grasp = Grasp([Contact(position=(np.cos(a), np.sin(a), 0.0), normal=(0.0, 0.0, 1.0))
                   for a in np.deg2rad([0.0, 120.0, 240.0])])
    found = force_closure(grasp)
    assert (found.closed, found.rank) == (False, 6)
    assert found.margin == pytest.approx(0.0, abs=SOLVER)


@pytest.mark.parametrize('mu, closed', [(0.56, False), (0.60, True)])
def test_friction_angle_decides(mu, closed):
    """Two fingers and a thumb 60 degrees off: closure begins at mu = tan 30 degrees."""
    normals = np.array([[1.0, 0.0, 0.0], [0.5, np.sqrt(0.75), 0.0]])
    normals[1] *= -1.0
    grasp = Grasp([
        Contact(position=-n, normal=n, friction=mu, model=ContactModel.SFCE,
                torsional_friction=0.1) for n in normals])
    assert force_closure(grasp).closed == closed

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The weighted centre of a conic program: optimality conditions and closed forms."""

from grasp_quality.centering import weighted_center
from grasp_quality.cone_algebra import determinant, is_interior
import numpy as np
import pytest
from tolerances import CLOSED_FORM


def test_half_lines_in_closed_form():
    """Maximise sum of w log u on a simplex: u is w over their sum."""
    weights = np.array([0.1, 0.2, 0.7, 3.0])
    E, c = np.ones((1, 4, 1)), np.zeros((4, 1))
    # log det of a half line as a cone is twice its logarithm
    u, x = weighted_center(E, np.array([1.0]), c, weights / 2.0)
    assert u[:, 0] == pytest.approx(weights / weights.sum(), rel=CLOSED_FORM)
    assert x[0] == pytest.approx(weights.sum(), rel=CLOSED_FORM)


def test_one_cone_in_closed_form():
    """Maximise t + w log(1 - t^2) at axis one: t = (sqrt(w^2 + 1) - w)."""
    for w in (1e-4, 0.1, 1.0, 20.0):
        E = np.array([[[1.0, 0.0, 0.0]]])
        u, _ = weighted_center(E, np.array([1.0]), np.array([[0.0, 1.0, 0.0]]), np.array([w]))
        assert u[0, 1] == pytest.approx(np.sqrt(w * w + 1.0) - w, abs=CLOSED_FORM)
        assert u[0, 2] == pytest.approx(0.0, abs=CLOSED_FORM)


@pytest.mark.parametrize('seed', range(8))
def test_optimality_conditions(seed):
    rng = np.random.default_rng(seed)
    blocks, d, rows = 7, 4, 5
    E = rng.normal(size=(rows, blocks, d))
    E[:, -2:, 1:] = 0.0
    inside = np.zeros((blocks, d))
    inside[:, 0] = rng.uniform(0.5, 1.0, blocks)
    slack = np.zeros((blocks, d))
    slack[:, 0] = rng.uniform(0.5, 1.0, blocks)
    c = np.einsum('r,rbd->bd', rng.normal(size=rows), E) - slack
    weights = 10.0 ** rng.uniform(-6, 1, blocks)
    e = np.einsum('rbd,bd->r', E, inside)
    u, x = weighted_center(E, e, c, weights)
    assert is_interior(u)
    assert np.einsum('rbd,bd->r', E, u) == pytest.approx(e, abs=CLOSED_FORM)
    z = np.einsum('r,rbd->bd', x, E) - c
    gradient = 2.0 * u / determinant(u)[:, None]  # of log det
    gradient[:, 1:] *= -1.0
    assert z == pytest.approx(weights[:, None] * gradient, rel=1e-5, abs=CLOSED_FORM)


def test_redundant_equations_do_no_harm():
    E = np.ones((3, 2, 1)) * np.array([1.0, 2.0, 1.0])[:, None, None]
    u, _ = weighted_center(E, np.array([1.0, 2.0, 1.0]), np.zeros((2, 1)), np.array([0.5, 0.5]))
    assert u[:, 0] == pytest.approx([0.5, 0.5], rel=CLOSED_FORM)


def test_none_where_there_is_no_interior():
    """A cone whose axis must be zero."""
    E = np.array([[[1.0, 0.0]]])
    assert weighted_center(E, np.array([0.0]), np.zeros((1, 2)), np.array([1.0])) is None


def test_none_where_nothing_is_feasible():
    E = np.ones((1, 2, 1))
    assert weighted_center(E, np.array([-1.0]), np.zeros((2, 1)), np.ones(2)) is None

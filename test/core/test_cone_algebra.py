# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The algebra of second-order cones that the interior-point method of the barrier stands on."""

from grasp_quality.cone_algebra import (
    determinant, divide, is_interior, largest_step, product, Scaling)
import numpy as np
import pytest
from tolerances import CLOSED_FORM, EXACT

RNG = np.random.default_rng(0)


def interior(count=6, size=4, padded=2):
    """Return random interior points, the last ones padded from half lines and short cones."""
    u = RNG.normal(size=(count, size))
    u[-padded:, 1:] = 0.0
    u[-padded - 1, 2:] = 0.0
    u[:, 0] = np.linalg.norm(u[:, 1:], axis=1) + RNG.uniform(0.1, 1.0, count)
    return u


def edge_distance(u):
    """Smallest eigenvalue of every block."""
    return u[:, 0] - np.linalg.norm(u[:, 1:], axis=1)


def test_identity_and_inverse_of_the_product():
    u, v = interior(), interior()
    one = np.zeros_like(u)
    one[:, 0] = 1.0
    assert product(u, one) == pytest.approx(u, abs=EXACT)
    assert divide(u, product(u, v)) == pytest.approx(v, rel=CLOSED_FORM)


def test_determinant_and_interior():
    u = interior()
    assert is_interior(u) and (determinant(u) > 0.0).all()
    assert not is_interior(-u)
    u[2, 0] = 0.5 * np.linalg.norm(u[2, 1:])
    assert not is_interior(u) and determinant(u)[2] < 0.0


def test_largest_step_ends_on_the_edge():
    for _ in range(200):
        u, du = interior(), RNG.normal(size=(6, 4))
        du[-2:, 1:] = 0.0
        step = largest_step(u, du)
        if np.isfinite(step):
            assert edge_distance(u + step * du).min() == pytest.approx(0.0, abs=1e-7)
            assert is_interior(u + 0.999 * step * du)
        else:
            assert is_interior(u + 1e6 * du)


def test_largest_step_inside_the_cone_has_no_end():
    assert largest_step(interior(), interior()) == np.inf


def test_largest_step_of_half_lines():
    u, du = np.array([[2.0], [3.0]]), np.array([[-1.0], [-6.0]])
    assert largest_step(u, du) == pytest.approx(0.5, rel=EXACT)


def test_scaling_maps_dual_to_primal():
    u, z = interior(), interior()
    W = Scaling.of(u, z)
    assert W.apply(W.apply(z)) == pytest.approx(u, rel=CLOSED_FORM, abs=CLOSED_FORM)
    assert W.apply(W.apply(u, inverse=True), inverse=True) == pytest.approx(
        z, rel=CLOSED_FORM, abs=CLOSED_FORM)
    assert W.apply(z) == pytest.approx(W.apply(u, inverse=True), rel=CLOSED_FORM, abs=CLOSED_FORM)


def test_squared_is_applied_twice():
    W = Scaling.of(interior(), interior())
    matrix = RNG.normal(size=(6, 4, 3))
    matrix[-2:, 1:] = 0.0
    matrix[-3, 2:] = 0.0
    twice = np.stack([W.apply(W.apply(matrix[:, :, m])) for m in range(3)], axis=2)
    assert W.squared(matrix) == pytest.approx(twice, rel=CLOSED_FORM, abs=CLOSED_FORM)


def test_padding_stays_zero():
    u, z = interior(), interior()
    W = Scaling.of(u, z)
    for block in (W.apply(z), product(u, z), divide(u, z), W.point):
        assert (block[-2:, 1:] == 0.0).all()

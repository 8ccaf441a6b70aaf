# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The friction cones: scales, usage, support and log-determinant."""

from grasp_quality import friction_cone
import numpy as np
import pytest
from tolerances import EXACT

SCALES = friction_cone.coordinate_scales(
    np.array([0.0, 0.5, 0.5, 0.0]), np.array([0.0, 0.0, 0.1, 0.1]))
CAPS = np.ones(4)


def forces(t1=0.0, t2=0.0, n=1.0, m=0.0):
    """Return the same force at all four contacts."""
    return np.tile([t1, t2, n, m], (4, 1)).astype(float)


def test_scales():
    assert SCALES.tolist() == [
        [0.0, 0.0, 1.0, 0.0], [0.5, 0.5, 1.0, 0.0], [0.5, 0.5, 1.0, 0.1], [0.0, 0.0, 1.0, 0.1]]


@pytest.mark.parametrize('force, expected', [
    (forces(), [0.0, 0.0, 0.0, 0.0]),
    (forces(t1=0.3, t2=0.4), [np.inf, 1.0, 1.0, np.inf]),
    (forces(m=0.05), [np.inf, np.inf, 0.5, 0.5]),
    (forces(t1=0.3, m=0.08), [np.inf, np.inf, 1.0, np.inf]),
    (forces(n=-1.0), [np.inf] * 4),
    (forces(n=0.0), [0.0] * 4),
    (forces(t2=0.1, n=0.0), [np.inf] * 4),
])
def test_usage(force, expected):
    assert friction_cone.usage(force, SCALES, CAPS) == pytest.approx(expected, rel=EXACT)


def test_usage_of_what_a_solver_leaves_on_an_idle_contact_is_zero():
    idle = forces(t1=1e-8, n=1e-9) * (SCALES > 0.0)
    assert friction_cone.usage(idle, SCALES, CAPS).tolist() == [0.0] * 4
    assert friction_cone.usage(idle, SCALES, CAPS, unloaded=1e-12)[1] > 1.0


def test_idle_is_a_share_of_the_cap():
    light = forces(t1=1e-8, n=1e-9) * (SCALES > 0.0)
    caps = np.array([1.0, 1.0, 1e-3, 1.0])
    assert friction_cone.usage(light, SCALES, caps) == pytest.approx(
        [0.0, 0.0, 20.0, 0.0], rel=EXACT)


def test_no_force_is_no_usage_whatever_counts_as_idle():
    nothing = np.zeros((4, 4))
    assert friction_cone.usage(nothing, SCALES, CAPS, unloaded=0.0).tolist() == [0.0] * 4
    assert friction_cone.usage_of_shares(nothing, unloaded=0.0).tolist() == [0.0] * 4


@pytest.mark.filterwarnings('error')
def test_usage_beside_a_denormal_normal_force_is_infinite_and_quiet():
    loaded = forces(t1=0.3, n=5e-324)
    assert friction_cone.usage(loaded, SCALES, CAPS).tolist() == [np.inf] * 4


def test_usage_of_shares_is_usage():
    rng = np.random.default_rng(0)
    caps = rng.uniform(0.5, 2.0, 4)
    shares = rng.normal(size=(4, 4)) * (SCALES > 0.0)
    assert friction_cone.usage_of_shares(shares) == pytest.approx(
        friction_cone.usage(shares * SCALES * caps[:, None], SCALES, caps), rel=EXACT)


def test_support_is_the_largest_work_at_normal_force_one():
    rng = np.random.default_rng(1)
    h = rng.normal(size=(4, 4))
    most = friction_cone.support(h, SCALES)
    for _ in range(500):
        direction = rng.normal(size=(4, 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        force = np.stack([*direction[:, :2].T, np.ones(4), direction[:, 2]], axis=1) * SCALES
        assert ((h * force).sum(axis=1) <= most + EXACT).all()
    best = h * SCALES * [1, 1, 0, 1]
    size = np.linalg.norm(best, axis=1, keepdims=True)
    force = np.divide(best, size, where=size > 0.0, out=np.zeros_like(best)) * SCALES
    force[:, 2] = 1.0
    assert (h * force).sum(axis=1) == pytest.approx(most, rel=EXACT)


def test_log_det():
    value = friction_cone.log_det(forces(t1=0.3, n=2.0) * (SCALES > 0.0), SCALES)
    assert value == pytest.approx([
        np.log(2.0), np.log(4.0 - 0.36), np.log(4.0 - 0.36), np.log(4.0)], rel=EXACT)


@pytest.mark.parametrize('force', [
    forces(n=0.0), forces(n=-1.0), forces(t1=0.5, n=1.0), forces(t1=0.6, n=1.0)])
def test_log_det_is_minus_infinity_outside_and_on_the_edge(force):
    assert friction_cone.log_det(force, SCALES)[1] == -np.inf

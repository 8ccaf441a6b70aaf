# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The optimality conditions of an answer, worked out a second time in physical units."""

from grasp_quality import Status
import numpy as np
from tolerances import CLOSED_FORM, SOLVER

RESIDUAL = 1e-8  # of the caps' total
USAGE = 1e-9


def check_forces(grasp, forces, applied, external_wrench=None):
    """Check that forces lie in cones and caps and that with the load they apply a wrench."""
    load = np.zeros(6) if external_wrench is None else np.asarray(external_wrench, float)
    rest = grasp.wrench(forces) + load - applied
    rest[3:] -= np.cross(grasp.center, rest[:3])
    rest[3:] /= grasp.lever_arm
    caps = grasp.max_normal_forces
    size = max(caps.sum(), np.linalg.norm(grasp.scaled_wrench(load)) * grasp.force_scale)
    # of torques about the origin
    rounding = 1e-14 * np.linalg.norm(grasp.center) / grasp.lever_arm
    assert np.linalg.norm(rest) <= (2.0 * RESIDUAL + rounding) * size
    normal, scales = forces[:, 2], grasp.scales
    assert (forces[scales == 0.0] == 0.0).all()
    parts = np.divide(forces, scales, where=scales > 0.0, out=np.zeros_like(forces))
    friction = np.linalg.norm(parts[:, [0, 1, 3]], axis=1)
    assert (friction <= normal * (1.0 + USAGE) + 1e-8 * caps).all()
    shares = normal / caps
    used = (np.linalg.norm(shares) if grasp.bound == 'l2'
            else max(np.bincount(grasp.groups, weights=shares)))
    assert used <= 1.0 + USAGE


def support_of_wrenches(grasp, direction):
    """Largest work along a direction (6,) over all forces inside cones and bound."""
    h = np.einsum('i,ijk->jk', direction, grasp.matrix)
    scaled = h * grasp.scales
    worth = grasp.max_normal_forces * np.maximum(
        0.0, h[:, 2] + np.linalg.norm(scaled[:, [0, 1, 3]], axis=1))
    if grasp.bound == 'l2':
        return np.linalg.norm(worth)
    groups = np.asarray(grasp.groups)
    return sum(worth[groups == g].max() for g in set(grasp.groups))


def check_task_wrench(solution, wrench, external_wrench=None):
    """Check an answer at eps = 0: primal, dual, and no gap between them."""
    grasp = solution.grasp
    wrench = np.asarray(wrench, float)
    load = np.zeros(6) if external_wrench is None else np.asarray(external_wrench, float)
    low, high = solution.alpha_interval
    assert 0.0 <= low <= high <= solution.alpha_upper
    assert np.isfinite(solution.alpha_upper)
    if solution.status is Status.INFEASIBLE:
        assert (solution.alpha, solution.alpha_upper) == (0.0, 0.0)
        assert solution.forces.shape == (0, 4) and not solution.holdable
        return
    check_forces(grasp, solution.forces, solution.alpha * wrench, load)
    assert np.allclose(solution.wrench, solution.alpha * wrench, rtol=CLOSED_FORM, atol=0.0)
    lambda_ = solution.dalpha_dexternal_wrench
    assert lambda_ @ wrench >= 1.0 - 1e-6 - 1e-10 * (abs(lambda_) @ abs(wrench))
    size = np.linalg.norm(grasp.scaled_wrench(wrench)) * grasp.force_scale
    natural = max(solution.alpha, 1e-3 * grasp.max_normal_forces.sum() / size)
    # weak duality, with sums that may cancel to rounding
    upper = support_of_wrenches(grasp, lambda_) + lambda_ @ load
    terms = (abs(lambda_) @ (abs(load) + solution.alpha * abs(wrench))
             + support_of_wrenches(grasp, lambda_))
    upper = max(upper, solution.alpha)
    assert abs(upper - solution.alpha_upper) <= SOLVER * natural + 1e-9 * terms
    assert solution.alpha_upper - solution.alpha <= SOLVER * natural
    for derivative in (solution.dalpha_dmax_force, solution.dalpha_dfriction):
        assert np.isfinite(derivative).all() and (derivative >= 0.0).all()
    assert solution.limiting_contact in ('', *grasp.names)
    assert solution.limiting_reason in ('', 'slip', 'cap')

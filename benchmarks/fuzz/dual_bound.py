# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a multiplier of equilibrium proves, in plain numpy (docs/derivations.md, "The dual").

For any lambda with lambda . F = 1: alpha <= sigma_W(lambda) + lambda . F_ext.
"""

from collections.abc import Mapping

from grasp_quality_hand.force_rules import Array, Limits
import numpy as np

ROUNDING = 1e-14


def _stacked(limits: Mapping[str, Limits]) -> tuple[Array, Array, Array, Array]:
    """Return points about their mean, axes, cone scales [mu, mu, 1, gamma] and caps; the mean."""
    each = list(limits.values())
    points = np.array([c.position for c in each])
    scales = np.array([[c.friction, c.friction, 1.0, c.torsional_friction] for c in each])
    return points, np.array([c.R for c in each]), scales, np.array([c.cap for c in each])


def support(worth: Array, bound: str, fingers: list[str]) -> float:
    """Largest work of normals inside the bound, each worth so much at its cap."""
    useful = np.maximum(worth, 0.0)
    if bound == 'linf':
        return float(useful.sum())
    if bound == 'l2':
        return float(np.linalg.norm(useful))
    if bound == 'l1':
        return float(useful.max())
    return sum(max(u for u, f in zip(useful.tolist(), fingers) if f == finger)
               for finger in set(fingers))


def lever_arm(limits: Mapping[str, Limits]) -> float:
    """Reach [m] of the contacts about their mean; what stands for it where they are one."""
    points, _, scales, _ = _stacked(limits)
    center = points.mean(axis=0)
    reach, far = float(np.linalg.norm(points - center, axis=1).max()), float(np.abs(center).max())
    arms = (reach if reach > 1e-8 * far else 0.0, float(scales[:, 3].max()), far)
    return next((arm for arm in arms if arm > 1e-12), 1.0)


def natural_alpha(limits: Mapping[str, Limits], bound: str, task: Array) -> float:
    """Largest alpha that the caps alone would allow, torques over the contacts' reach."""
    points, _, _, caps = _stacked(limits)
    center = points.mean(axis=0)
    arm = lever_arm(limits)
    about = np.concatenate([task[:3], (task[3:] - np.cross(center, task[:3])) / arm])
    size = np.abs(about).max()
    total = support(caps, bound, [c.finger for c in limits.values()])
    return float(total / size / np.linalg.norm(about / size))


def alpha_bound(limits: Mapping[str, Limits], bound: str, task: Array, load: Array,
                multiplier: Array) -> tuple[float, float]:
    """Upper bound of alpha that a multiplier (6,) proves, and how far rounding may move it."""
    points, R, scales, caps = _stacked(limits)
    largest = np.abs(multiplier).max()
    if not largest > 0.0:
        return np.inf, 0.0
    force, moment = multiplier[:3] / largest, multiplier[3:] / largest
    along = force @ task[:3] + moment @ task[3:]
    if not along > 0.0:
        return np.inf, 0.0
    at = force + np.cross(moment, points)  # (k, 3): what a force at each point is worth
    h = np.concatenate([np.einsum('kj,kji->ki', at, R), (R[:, :, 2] @ moment)[:, None]],
                       axis=1) * scales
    worth = caps * (h[:, 2] + np.linalg.norm(h[:, (0, 1, 3)], axis=1))
    value = support(worth, bound, [c.finger for c in limits.values()])
    value += force @ load[:3] + moment @ load[3:]
    terms = float((caps * (np.abs(force).sum() + np.abs(moment).sum() * np.abs(points).max(
        initial=0.0)) * (1.0 + scales.max())).sum() + np.abs(load).sum())
    terms += (np.abs(force) @ np.abs(task[:3]) + np.abs(moment) @ np.abs(task[3:])) * abs(
        value) / along
    return float(value / along), ROUNDING * terms / along

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The friction cone of every contact, vectorised over contacts.

Local coordinates are [t1, t2, n, m_n] in the contact frame. Dividing them by
[mu, mu, 1, gamma] turns each cone of the paper (eq. 1 to 3) into a standard second-order cone
|(t1', t2', m')| <= n; a coordinate whose coefficient is zero can carry nothing and drops out.
"""

from grasp_quality.arrays import Array
import numpy as np

UNLOADED = 1e-6  # share of f_max below which a contact counts as not loaded


def coordinate_scales(friction: Array, torsional_friction: Array) -> Array:
    """Return [mu, mu, 1, gamma] of every contact, (k, 4) [-, -, -, m]."""
    scales = np.ones((len(friction), 4))
    scales[:, 0] = scales[:, 1] = friction
    scales[:, 3] = torsional_friction
    return scales


def tangential_norm(local: Array, scales: Array) -> Array:
    """
    Norm |(t1/mu, t2/mu, m_n/gamma)| of every contact, (k,) [N].

    A coordinate that the model cannot transmit makes the norm infinite when it is not zero.

    """
    carried = local[:, (0, 1, 3)]
    weights = scales[:, (0, 1, 3)]
    with np.errstate(divide='ignore', invalid='ignore'):
        scaled = np.where(carried == 0.0, 0.0, np.abs(carried) / weights)
    norm: Array = np.sqrt((scaled * scaled).sum(axis=1))
    return norm


def usage(forces: Array, scales: Array, max_normal_force: Array,
          unloaded: float = UNLOADED) -> Array:
    """
    Share of the friction cone in use, (k,): 0 at the axis, 1 at slip, more outside.

    Parameters
    ----------
    forces : (k, 4) array [N, N, N, N m]
        [t1, t2, n, m_n] in the contact frames, finger on object.
    scales : (k, 4) array
        From ``coordinate_scales``.
    max_normal_force : (k,) array [N]
        Cap f_max of each contact, the measure of ``unloaded``.
    unloaded : float
        A contact with n and |(t/mu, m_n/gamma)| below this share of its cap has usage 0: what a
        solver leaves on a contact that it does not need points anywhere.

    """
    norm, normal = tangential_norm(forces, scales), forces[:, 2]
    return _share(norm, normal, unloaded * max_normal_force)


def usage_of_shares(shares: Array, unloaded: float = UNLOADED) -> Array:
    """
    Share of the friction cone in use, (..., k), as ``usage``.

    Parameters
    ----------
    shares : (..., k, 4) array
        [t1/mu, t2/mu, n, m_n/gamma] / f_max, with zeros where a contact carries nothing.
    unloaded : float
        As for ``usage``.

    """
    squares = shares * shares
    norm = np.sqrt(squares[..., 0] + squares[..., 1] + squares[..., 3])
    return _share(norm, shares[..., 2], unloaded)


def _share(norm: Array, normal: Array, small: Array | float) -> Array:
    with np.errstate(over='ignore'):  # beside a denormal normal force
        share: Array = np.divide(norm, normal, where=normal > 0.0, out=np.full(norm.shape, np.inf))
    share[np.maximum(np.abs(normal), norm) <= small] = 0.0
    return share


def support(local_wrench: Array, scales: Array | float) -> Array:
    """
    Largest work h . x over each cone at normal force one, (k,).

    With h = G_i^T lambda this is h_n + |(mu h_t1, mu h_t2, gamma h_m)|, the support function that
    all dual bounds are made of (docs/derivations.md).

    Parameters
    ----------
    local_wrench : (k, 4) array
        h of every contact.
    scales : (k, 4) array
        From ``coordinate_scales``.

    """
    h = local_wrench * scales
    return h[:, 2] + np.sqrt(h[:, 0] ** 2 + h[:, 1] ** 2 + h[:, 3] ** 2)


def log_det(forces: Array, scales: Array) -> Array:
    """
    Log-determinant of every contact's cone matrix P_i, up to a constant, (k,).

    log(n^2 - |(t1/mu, t2/mu, m_n/gamma)|^2) for a cone with friction and log(n) without:
    the barrier of eq. (11). -inf on the cone's edge and outside.

    """
    norm = tangential_norm(forces, scales)
    normal = forces[:, 2]
    frictional = (scales[:, (0, 1, 3)] > 0.0).any(axis=1)
    det = np.where(frictional, (normal - norm) * (normal + norm), normal)
    inside = (normal > 0.0) & (normal > norm)
    return np.log(np.where(inside, det, 0.0), where=inside, out=np.full(len(det), -np.inf))

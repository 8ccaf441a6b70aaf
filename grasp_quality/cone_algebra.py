# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Second-order cones, many at once: the algebra that an interior-point method needs.

Points are (blocks, d) arrays, one cone a row, axis first, shorter cones padded with zeros: a zero
that stays zero changes none of these results. A half line is a cone whose rest is all padding.
References: Alizadeh and Goldfarb, "Second-order cone programming" (2003); Nesterov-Todd scaling
as in Andersen, Roos and Terlaky (2003).
"""

from __future__ import annotations

from dataclasses import dataclass

from grasp_quality.arrays import Array
import numpy as np


def determinant(u: Array) -> Array:
    """Return u_0^2 - |u_1|^2 of every block, (blocks,); positive inside the cone."""
    norm: Array = np.sqrt((u[:, 1:] ** 2).sum(axis=1))
    return (u[:, 0] - norm) * (u[:, 0] + norm)


def is_interior(u: Array) -> bool:
    """Whether every block lies strictly inside its cone."""
    return bool((u[:, 0] > 0.0).all() and (determinant(u) > 0.0).all())


def product(u: Array, v: Array) -> Array:
    """Jordan product u o v of every block."""
    out = u[:, :1] * v + v[:, :1] * u
    out[:, 0] = (u * v).sum(axis=1)
    return out


def divide(u: Array, q: Array) -> Array:
    """Solve u o v = q for v in every block."""
    axis: Array = (u[:, 0] * q[:, 0] - (u[:, 1:] * q[:, 1:]).sum(axis=1)) / determinant(u)
    out = (q - axis[:, None] * u) / u[:, :1]
    out[:, 0] = axis
    return out


def largest_step(u: Array, du: Array) -> float:
    """Largest t with u + t du in all cones; inf when every t >= 0 is."""
    a = determinant_form(du, du)
    b = determinant_form(u, du)
    c = determinant(u)
    # first positive root of a t^2 + 2 b t + c, written without cancellation
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    denominator = np.where(b <= 0.0, root - b, -(root + b))
    with np.errstate(divide='ignore', invalid='ignore'):
        first = np.where(b <= 0.0, c / denominator, denominator / a)
    # a half line has a double root, which rounding must not hide
    reaches = (a < 0.0) | ((b < 0.0) & (b * b >= a * c * (1.0 - 1e-9)))
    return float(np.where(reaches & (first > 0.0), first, np.inf).min())


def determinant_form(u: Array, v: Array) -> Array:
    """Return u_0 v_0 - u_1 . v_1 of every block: the bilinear form of the determinant."""
    form: Array = u[:, 0] * v[:, 0] - (u[:, 1:] * v[:, 1:]).sum(axis=1)
    return form


@dataclass(frozen=True, eq=False)
class Scaling:
    """
    Nesterov-Todd scaling W of a primal-dual pair: W z = W^-1 u.

    ``point`` (blocks, d) has determinant one and ``size`` (blocks,) is eta, with
    W^2 = eta^2 (2 point point^T - J).

    """

    point: Array
    size: Array

    @classmethod
    def of(cls, u: Array, z: Array) -> Scaling:
        """Scaling of strictly interior u and z."""
        det_u, det_z = determinant(u), determinant(z)
        u_unit = u / np.sqrt(det_u)[:, None]
        z_unit = z / np.sqrt(det_z)[:, None]
        gamma = np.sqrt((1.0 + (u_unit * z_unit).sum(axis=1)) / 2.0)[:, None]
        point = u_unit - z_unit
        point[:, 0] = u_unit[:, 0] + z_unit[:, 0]
        return cls(point / (2.0 * gamma), (det_u / det_z) ** 0.25)

    def apply(self, v: Array, inverse: bool = False) -> Array:
        """Return W v, or W^-1 v, of every block."""
        sign = -1.0 if inverse else 1.0
        w0, w1 = self.point[:, :1], sign * self.point[:, 1:]
        along = (w1 * v[:, 1:]).sum(axis=1, keepdims=True)
        out = np.concatenate(
            [w0 * v[:, :1] + along, v[:, 1:] + (v[:, :1] + along / (1.0 + w0)) * w1], axis=1)
        return out * (self.size if not inverse else 1.0 / self.size)[:, None]

    def squared(self, matrix: Array) -> Array:
        """Return W^2 applied to the columns of a (blocks, d, m) array."""
        along: Array = np.einsum('bd,bdm->bm', self.point, matrix)
        out = 2.0 * self.point[:, :, None] * along[:, None, :] + matrix
        out[:, 0] -= 2.0 * matrix[:, 0]
        return out * (self.size ** 2)[:, None, None]

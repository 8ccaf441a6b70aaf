# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A grasp: contacts, stacked into the arrays that all computations share, and a force bound.

G, the grasp matrix (eq. 4), maps the local forces [t1, t2, n, m_n] of all contacts to the wrench
on the object about the object frame's origin. Everything derived is computed once and cached.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
import math
from typing import TYPE_CHECKING

from grasp_quality import bounds
from grasp_quality.arrays import Array, frozen, Ints, NO_LENGTH
from grasp_quality.contact import Contact
from grasp_quality.contact_set import as_contact_set, ContactSet
from grasp_quality.exceptions import InvalidGraspError
from grasp_quality.friction_cone import coordinate_scales
from grasp_quality.joint_limits import check_limits, JointLimits, JointRows
from grasp_quality.wrench import matrix_of, shift
import numpy as np

MAX_CAP_RATIO = 1e6   # between the caps of one grasp
RANK_TOLERANCE = 1e-9  # singular values below this share of the largest count as zero
COINCIDENT = 1e-8      # distance over distance from the origin: float64 keeps 1e-16 of the latter


@dataclass(frozen=True, eq=False)
class Grasp:
    """
    Contacts that act on one object, with the bound on their normal forces.

    Parameters
    ----------
    contacts : iterable of Contact, or ContactSet
        At least one; names must be unique where given. Kept as a ContactSet.
    bound : str
        'linf' (every contact obeys its own cap), 'l1' (the sum of n_i / f_max,i is at most 1),
        'l2' (their Euclidean norm is), 'finger' (their sum over each finger is).
    joint_limits : JointLimits, optional
        Motor torques that the forces must not exceed, for the same contacts in the same order.

    Raises
    ------
    InvalidGraspError

    """

    contacts: ContactSet
    bound: str = 'linf'
    joint_limits: JointLimits | None = None

    if TYPE_CHECKING:
        groups: tuple[int, ...] = field(init=False)  # of the bound, one a contact
        def __init__(self, contacts: Iterable[Contact], bound: str = 'linf',
                     joint_limits: JointLimits | None = None) -> None: ...

    def __post_init__(self) -> None:
        """Validate and freeze."""
        contacts = as_contact_set(self.contacts)
        if not len(contacts):
            raise InvalidGraspError('a grasp needs at least one contact, got none')
        named = [name for name in contacts.names if name]
        if len(set(named)) < len(named):
            twice = sorted({name for name in named if named.count(name) > 1})
            raise InvalidGraspError(f'contact names must be unique, given twice: {twice}')
        caps = contacts.max_normal_forces
        if caps.max() > MAX_CAP_RATIO * caps.min():
            raise InvalidGraspError(
                f'max_normal_force of one grasp may span a factor of {MAX_CAP_RATIO:g} at most, '
                f'got {caps.min():g} to {caps.max():g} N: no answer could be exact for both')
        check_limits(self.joint_limits, contacts.names)
        object.__setattr__(self, 'contacts', contacts)
        object.__setattr__(self, 'groups', bounds.groups_of(self.bound, contacts.fingers))

    def __len__(self) -> int:
        """Count the contacts."""
        return len(self.contacts)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Name of every contact; 'contact_<index>' where none was given."""
        return tuple(self.name_of(i) for i in range(len(self)))

    def name_of(self, index: int) -> str:
        """Return the name of one contact."""
        return self.contacts.names[index] or f'contact_{index}'

    @property
    def positions(self) -> Array:
        """Contact points (k, 3) [m] in the object frame."""
        return self.contacts.positions

    @property
    def rotations(self) -> Array:
        """R_object_contact of every contact (k, 3, 3); columns t1, t2, inward normal."""
        return self.contacts.rotations

    @property
    def max_normal_forces(self) -> Array:
        """Caps f_max (k,) [N]."""
        return self.contacts.max_normal_forces

    @cached_property
    def scales(self) -> Array:
        """Cone scales [mu, mu, 1, gamma] (k, 4) that the contact models let act."""
        return frozen(coordinate_scales(
            self.contacts.effective_friction, self.contacts.effective_torsional_friction))

    @cached_property
    def matrix(self) -> Array:
        """Grasp matrix G (6, k, 4), eq. (4): local forces to object wrench about the origin."""
        return frozen(matrix_of(self.positions, self.rotations))

    @cached_property
    def centered_matrix(self) -> Array:
        """Grasp matrix (6, k, 4) with torques about ``center``."""
        return frozen(matrix_of(self.positions - self.center, self.rotations))

    @cached_property
    def center(self) -> Array:
        """Mean of the contact points (3,) [m]: the reference point of the scaled problem."""
        return frozen(self.positions.sum(axis=0) / len(self))

    @cached_property
    def lever_arm(self) -> float:
        """
        Length scale of the grasp [m]: largest distance of a contact from their mean.

        Where all contacts coincide, as far as float64 coordinates can tell them apart to eight
        digits, the largest torsional coefficient; their distance from the origin, or else 1 m,
        when that is zero too. Below ``NO_LENGTH`` everything is zero.

        """
        offsets = self.positions - self.center
        reach = math.sqrt((offsets * offsets).sum(axis=1).max())
        away = max(map(abs, self.center.tolist()))
        if reach > max(COINCIDENT * away, NO_LENGTH):
            return reach
        return next(a for a in (float(self.scales[:, 3].max()), away, 1.0) if a > NO_LENGTH)

    @cached_property
    def scaled_matrix(self) -> Array:
        """
        Dimensionless grasp matrix (6, k, 4).

        Columns act on [t1/mu, t2/mu, n, m_n/gamma] as shares of f_max; rows are forces as shares
        of the largest cap and torques about ``center`` as shares of that times ``lever_arm``.

        """
        G = self.centered_matrix * (self.force_units / self.force_scale)
        G[3:] /= self.lever_arm
        return frozen(G)

    @cached_property
    def joint_rows(self) -> JointRows | None:
        """Joint limits in scaled units, JointRows; None without limits."""
        return None if self.joint_limits is None else JointRows(
            self.joint_limits, self.force_units)

    @cached_property
    def work_matrix(self) -> Array:
        """
        Worth of every share for unit multipliers, (6, 4 k), or (6 + j, 4 k) with joint limits.

        Rows are those of ``scaled_matrix``, and what the joints' torques cost, with a minus.

        """
        G = self.scaled_matrix.reshape(6, -1)
        joints = self.joint_rows
        return G if joints is None else frozen(np.vstack([G, -joints.A]))

    @property
    def rests(self) -> bool:
        """Whether no contact force at all is admissible: the joints can carry the hand itself."""
        return self.joint_limits is None or self.joint_limits.holds_itself

    @cached_property
    def blocks(self) -> tuple[Array, Array, Ints]:
        """
        Scaled grasp matrix as the kernel takes it.

        Returns
        -------
        (k, 4, 6) array of rows n, t1, t2, m_n a contact; (k, 6, 6) array -G J G^T of each block;
        (k,) int array of groups

        """
        G = np.ascontiguousarray(self.scaled_matrix[:, :, (2, 0, 1, 3)].transpose(1, 2, 0))
        signed = G * np.array([-1.0, 1.0, 1.0, 1.0])[:, None]
        return G, G.transpose(0, 2, 1) @ signed, np.array(self.groups)

    @cached_property
    def force_units(self) -> Array:
        """Local forces (k, 4) [N, N, N, N m] that a share of one stands for."""
        return frozen(self.scales * self.max_normal_forces[:, None])

    def shares(self, forces: Array) -> Array:
        """Local forces (k, 4) as shares [t1/mu, t2/mu, n, m_n/gamma] / f_max."""
        units = self.force_units
        return np.divide(forces, units, where=units > 0.0, out=np.zeros((len(self), 4)))

    @cached_property
    def force_scale(self) -> float:
        """Force scale of the grasp [N]: the largest cap."""
        return float(self.max_normal_forces.max())

    @cached_property
    def cap_total(self) -> float:
        """Largest sum of normals that the bound allows, as a share of the largest cap."""
        return bounds.support(self.max_normal_forces / self.force_scale, self.bound, self.groups)

    @cached_property
    def least_cap(self) -> float:
        """Smallest cap as a share of the largest."""
        return float(self.max_normal_forces.min()) / self.force_scale

    @cached_property
    def span(self) -> Array:
        """Orthonormal basis (6, rank) of the wrenches that unbounded forces could span."""
        G = self.scaled_matrix.reshape(6, -1)
        norms = np.sqrt((G * G).sum(axis=0))
        U, s, _ = np.linalg.svd(G[:, norms > 0] / norms[norms > 0], full_matrices=False)
        return U[:, s > RANK_TOLERANCE * s[0]]

    @property
    def rank(self) -> int:
        """Rank of the grasp matrix, 1 to 6."""
        return int(self.span.shape[1])

    def spans(self, wrench: Array) -> bool:
        """Tell whether forces of any sign and size could produce this wrench (6,)."""
        w = self.scaled_wrench(wrench)
        rest = w - self.span @ (self.span.T @ w)
        return bool(np.sqrt(rest @ rest) <= RANK_TOLERANCE * np.sqrt(w @ w))

    def scaled_wrench(self, wrench: Array) -> Array:
        """Wrenches (..., 6) about ``center``, as shares of force scale and lever arm."""
        scaled = shift(wrench, self.center) / self.force_scale
        scaled[..., 3:] /= self.lever_arm
        return scaled

    def wrench(self, forces: Array) -> Array:
        """Return G x (6,) [N, N m]: the object wrench of local forces (k, 4) about the origin."""
        return np.asarray(np.einsum('ijk,jk->i', self.matrix, forces))

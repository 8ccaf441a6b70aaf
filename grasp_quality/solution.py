# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Answers: values, forces, their proof and their sensitivities.

Infeasible is an answer, not an error: status INFEASIBLE, alpha 0 and no forces. Sensitivities are
derived from the multipliers when they are read (docs/derivations.md); at a kink they are one
subgradient.
"""

from dataclasses import dataclass
from functools import cached_property

from grasp_quality import sensitivity
from grasp_quality.arrays import Array, Bools, frozen
from grasp_quality.force_center import ForceCenter
from grasp_quality.grasp import Grasp
from grasp_quality.proof import NO_JOINTS, Proof, ZERO_TOLERANCE
from grasp_quality.remarks import remark
from grasp_quality.status import Answer, ForceAnswer, OneLine, Status
import numpy as np

NO_FORCES = frozen(np.zeros((0, 4)))
NO_USAGE = frozen(np.zeros(0))


@dataclass(frozen=True, eq=False)
class Solution(ForceAnswer):
    """
    Answer for one task.

    Attributes
    ----------
    grasp : Grasp
    status : Status
    alpha : float
        Largest factor by which the task wrench can be applied (for a cone: alpha_z); 0 when
        infeasible. With a barrier weight, the factor that the returned forces apply.
    alpha_upper : float
        Dual bound: no admissible forces apply more.
    alpha_lower : float
        Smallest feasible factor >= 0; more than 0 only with an external wrench.
    holdable : bool
        Whether alpha = 0 is feasible: the external wrench alone can be balanced.
    pinned : bool
        Whether alpha is fixed by the external wrench alone, in a rank-deficient grasp that cannot
        produce the task wrench: alpha then says nothing about strength.
    wrench : (6,) array [N, N m]
        Applied besides balancing the external wrench: alpha F, about the object frame's origin.
    forces : (k, 4) array [N, N, N, N m]
        [t1, t2, n, m_n] in the contact frames, finger on object; (0, 4) when infeasible.
    cone_usage : (k,) array
        Share of each friction cone in use; (0,) when infeasible.
    proof : Proof or None
        Evidence; None when infeasible.
    multiplier : (6,) array
        lambda = d alpha / d F_ext [1/N, 1/(N m)].
    joint_multiplier : (j,) array [1/(N m)]
        Signed worth of each joint's torque; empty without joint limits.
    barrier_weight : float
        eps of eq. (11); in the unit of alpha.
    center : ForceCenter or None
        Of forces with an ``alpha_reserve``; where the search for the next contacts may begin.
    size : float
        a0, the largest alpha that the caps alone would allow; 0 when infeasible.

    """

    grasp: Grasp
    status: Status
    alpha: float
    alpha_upper: float
    alpha_lower: float
    holdable: bool
    pinned: bool
    wrench: Array
    forces: Array
    cone_usage: Array
    proof: Proof | None
    multiplier: Array
    bound_multiplier: Array  # (k,) worth of each contact's share of the bound
    reference_forces: Array  # (k, 4) of the largest alpha, whose sensitivities are told
    joint_multiplier: Array
    barrier_weight: float = 0.0
    center: ForceCenter | None = None
    size: float = 0.0

    @property
    def powerless(self) -> bool:
        """Whether alpha is zero as far as a proof can tell: nothing of the task is applied."""
        return self.feasible and self.alpha_upper <= ZERO_TOLERANCE * self.size

    @property
    def remark(self) -> str:
        """Say why alpha is pinned, or zero; '' where it means what it says."""
        return remark(self.pinned, self.powerless)

    @property
    def alpha_interval(self) -> tuple[float, float]:
        """Feasible factors (alpha_lower, alpha)."""
        return self.alpha_lower, self.alpha

    @property
    def dalpha_dexternal_wrench(self) -> Array:
        """Return the slope of the largest alpha by the external wrench (6,) [1/N, 1/(N m)]."""
        return self.multiplier

    @cached_property
    def dalpha_dmax_force(self) -> Array:
        """Return the slope of the largest alpha by each cap f_max (k,) [1/N]."""
        caps = self.grasp.max_normal_forces
        shares = self.reference_forces[:, 2] / caps if self.feasible else np.zeros(len(caps))
        return frozen(self.bound_multiplier * shares / caps)

    @cached_property
    def dalpha_dfriction(self) -> Array:
        """Return the slope of the largest alpha by each friction coefficient mu (k,) [-]."""
        if not self.feasible:
            return frozen(np.zeros(len(self.grasp)))
        slope = sensitivity.friction_slope(self.grasp, self.local_multipliers)
        return frozen(self.reference_forces[:, 2] * slope)

    @property
    def dalpha_dmax_torque(self) -> Array:
        """Return the slope of the largest alpha by each joint's tau_max (j,) [1/(N m)]."""
        return np.abs(self.joint_multiplier)

    @property
    def joint_torques(self) -> Array:
        """Motor torques T x + tau_g (j,) [N m] of the forces; (0,) when infeasible."""
        limits = self.grasp.joint_limits
        return limits.torques(self.forces) if self.feasible and limits else NO_JOINTS

    @cached_property
    def dalpha_dposition(self) -> Array:
        """Return the slope by each contact's position (k, 3) [1/m], in object axes."""
        return frozen(sensitivity.position_slope(self))

    @cached_property
    def dalpha_drotation(self) -> Array:
        """Return the slope by turns of each contact frame about object axes (k, 3) [1/rad]."""
        return frozen(sensitivity.rotation_slope(self))

    @cached_property
    def limited_by(self) -> dict[str, str]:
        """Contacts, or joints, whose limits are worth most to the task, each with its reason."""
        return sensitivity.limited_by(self)

    @property
    def limiting_contact(self) -> str:
        """Name of the first of ``limited_by``; '' for none."""
        return next(iter(self.limited_by), '')

    @property
    def limiting_reason(self) -> str:
        """Reason of the first of ``limited_by``: 'slip', 'cap', 'joint', or '' for none."""
        return next(iter(self.limited_by.values()), '')

    @cached_property
    def local_multipliers(self) -> Array:
        """Return what each local force is worth (k, 4): G_i^T lambda less the joints' price."""
        return sensitivity.local_worth(self.grasp, self.multiplier, self.joint_multiplier)


@dataclass(frozen=True, eq=False)
class ConeSolution(Solution):
    """
    Answer for a task cone: alpha is alpha_z, wrench the wrench reached.

    Attributes
    ----------
    alpha_axis : float or None
        Largest factor along the bare axis; None where only the cone itself was solved.
    alpha_worst : float or None
        Least factor over the sampled directions of the cone's surface; None without samples.

    """

    alpha_axis: float | None = None
    alpha_worst: float | None = None


@dataclass(frozen=True, eq=False)
class PolytopeSolution(Answer):
    """
    Answer for several wrenches, each solved by itself (eq. 18).

    What is guaranteed is conv{0, alpha_i F_i}, not the parallelotope that eq. (19) of the paper
    claims; ``parallelotope_scale`` is the exact share of that which the grasp holds.

    Attributes
    ----------
    status : Status
        INFEASIBLE when any wrench is.
    quality : float
        sum_i w_i alpha_i.
    alphas : (n,) array
    forces : (n, k, 4) array
        (0, k, 4) when infeasible.
    solutions : tuple of Solution
    parallelotope_scale : float or None
        None for more than 8 wrenches, for ellipsoids, and when the task does not ask for it.
    guaranteed_scale : float or None
        For an ellipsoid: min alpha / sqrt(n), by which the whole ellipsoid can be scaled.

    """

    status: Status
    quality: float
    alphas: Array
    forces: Array
    solutions: tuple[Solution, ...]
    parallelotope_scale: float | None = None
    guaranteed_scale: float | None = None

    @property
    def alpha_min(self) -> float:
        """Smallest of the factors."""
        return float(self.alphas.min())


@dataclass(frozen=True, eq=False)
class WrenchMap(OneLine):
    """
    Alpha for many directions (Fig. 3b).

    Attributes
    ----------
    directions : (N, 6) array [N, N m]
    alpha : (N,) array
        0 where infeasible.
    feasible : (N,) bool array
    forces : (N, k, 4) array or None
        On request; zero where infeasible.

    """

    directions: Array
    alpha: Array
    feasible: Bools
    forces: Array | None = None

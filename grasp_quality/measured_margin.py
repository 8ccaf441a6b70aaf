# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Measured against possible: how close measured contact forces are to the limits of the grasp.

The wrench that the measured forces apply is a task like any other: its alpha tells how many times
as much the grasp could apply, and 1 / alpha is the share in use. The smallest change of forces
that restores a wanted slip margin m keeps that wrench and brings every force into a cone whose
friction is (1 - m) times as large: the nearest admissible forces of another grasp.
"""

from dataclasses import dataclass

from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import checked, checked_number, frozen
from grasp_quality.contact_set import ContactSet
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.margin_forces import NO_TASK
from grasp_quality.measures import slip_margin
from grasp_quality.nearest import distances, nearest_forces
from grasp_quality.problem import assemble, build_problem
from grasp_quality.proof import GAP_TOLERANCE
from grasp_quality.solve import prove_optimal
from grasp_quality.status import Status
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
NEGLIGIBLE_SHARE = 1e-9  # share of the caps below which measured forces apply nothing


@dataclass(frozen=True, eq=False)
class MeasuredMargin:
    """
    Measured forces against what the grasp allows.

    Attributes
    ----------
    status : Status
        INFEASIBLE when no admissible forces apply any share of the measured wrench.
    slip_margins : (k,) array
        1 - cone usage of every contact, as ``slip_margin`` gives it; negative outside the cone.
    applied_wrench : (6,) array [N, N m]
        G f of the measured forces, about the object frame's origin.
    load_alpha : float
        Largest multiple of it that the grasp could apply; 0 when there is none.
    load_share : float
        1 / load_alpha: 1 is at the limit, more means outside cones or caps; 0 without a wrench,
        and when INFEASIBLE.
    wanted_margin : float
    change : (k, 4) array [N, N, N, N m] or None
        Smallest change of the forces, in the contact frames, that restores the wanted margin with
        the same wrench; zero where all have it already; None when no forces do.
    sizes : (k,) array [N]
        Of the change of each contact, a moment counted as m_n / gamma.

    """

    status: Status
    slip_margins: Array
    applied_wrench: Array
    load_alpha: float
    load_share: float
    wanted_margin: float
    change: Array | None
    sizes: Array

    @property
    def restorable(self) -> bool:
        """Whether forces with the wanted margin apply the same wrench."""
        return self.change is not None


def measured_margin(grasp: Grasp, forces: ArrayLike, wanted_margin: float = 0.2,
                    time_limit_s: float | None = None) -> MeasuredMargin:
    """
    Compare measured contact forces with what the grasp allows.

    Parameters
    ----------
    grasp : Grasp
        Contacts that the forces were measured at, in the same order.
    forces : (k, 4) array_like [N, N, N, N m]
        Measured [t1, t2, n, m_n] of every contact, in its contact frame, finger on object. A
        moment counts only where the contact model has torsional friction.
    wanted_margin : float
        In [0, 1): slip margin that the change of forces shall restore.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    MeasuredMargin

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    limit = TimeLimit.of(time_limit_s)
    wanted = checked_number(
        wanted_margin, 'wanted_margin', InvalidTaskError, minimum=0.0, below=1.0)
    measured = checked(forces, (len(grasp), 4), 'forces', InvalidTaskError)
    measured = np.where([1, 1, 1, 0], measured, measured * (grasp.scales > 0.0))
    margins = slip_margin(grasp, measured)
    applied = grasp.wrench(measured)
    status, load_alpha, share = _share(grasp, applied, limit)
    change = _restoring(grasp, measured, applied, margins, wanted, limit)
    sizes = np.zeros(len(grasp))
    if change is not None:
        gammas = np.where(grasp.scales[:, 3] > 0.0, grasp.scales[:, 3], 1.0)
        sizes = np.linalg.norm(change / np.column_stack([np.ones((len(grasp), 3)), gammas]),
                               axis=1)
    return MeasuredMargin(status, frozen(margins), frozen(applied), load_alpha, share, wanted,
                          None if change is None else frozen(change), frozen(sizes))


def _share(grasp: Grasp, applied: Array, limit: TimeLimit | None) -> tuple[Status, float, float]:
    """Status, alpha of the applied wrench, and the share of it that is in use."""
    scaled = grasp.scaled_wrench(applied)
    if np.sqrt(scaled @ scaled) <= NEGLIGIBLE_SHARE:
        return Status.OPTIMAL, 0.0, 0.0
    problem = build_problem(grasp, TaskWrench(applied))
    optimum = prove_optimal(problem, limit)
    if optimum is None or optimum.values[0] <= GAP_TOLERANCE * problem.reach:
        return Status.INFEASIBLE, 0.0, 0.0
    alpha = float(optimum.values[0]) * problem.virtual.unit
    return Status.OPTIMAL, alpha, 1.0 / alpha


def _restoring(grasp: Grasp, measured: Array, applied: Array, margins: Array, wanted: float,
               limit: TimeLimit | None) -> Array | None:
    """Smallest change of the measured forces (k, 4) that gives them the wanted margin, or None."""
    problem = assemble(_slippier(grasp, 1.0 - wanted), NO_TASK, -applied)
    shares = problem.grasp.shares(measured)
    near = nearest_forces(problem, shares, limit)
    if near is None:
        return None
    if (margins >= wanted).all() and (distances(problem, near.shares, shares) ** 2
                                      <= GAP_TOLERANCE * problem.grasp.force_scale ** 2).all():
        return np.zeros_like(measured)
    return np.asarray(near.shares * problem.grasp.force_units - measured)


def _slippier(grasp: Grasp, share: float) -> Grasp:
    """Return the grasp with all friction coefficients multiplied by a share."""
    c = grasp.contacts
    return Grasp(ContactSet(
        c.positions, c.rotations, c.models, share * c.friction, share * c.torsional_friction,
        c.max_normal_forces, c.names, c.fingers), grasp.bound, grasp.joint_limits)

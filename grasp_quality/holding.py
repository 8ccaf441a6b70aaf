# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The dual problem: the smallest contact forces that balance a given external wrench.

The force bound becomes the objective: the virtual contact widens it instead of carrying a task
(the paper, section III and its reference [7]). When even unbounded forces inside the friction
cones cannot balance the wrench, or only forces beyond the caps can, the answer is INFEASIBLE and
carries the smallest violation.
"""

import dataclasses
import math

from grasp_quality import friction_cone
from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import Array, frozen
from grasp_quality.grasp import Grasp
from grasp_quality.problem import assemble, NO_WRENCH, VirtualContact
from grasp_quality.proof import USAGE_TOLERANCE
from grasp_quality.solution import NO_FORCES, NO_USAGE
from grasp_quality.solve import prove_optimal
from grasp_quality.status import ForceAnswer, Status
from grasp_quality.time_limit import Limit, TimeLimit
from grasp_quality.wrench import as_wrench, shift
import numpy as np
from numpy.typing import ArrayLike

NEGLIGIBLE = 1e-15  # share of the caps that needs no forces to hold
DUST = 1e-6  # share of what is unbalanced that a proof does not tell from zero


@dataclasses.dataclass(frozen=True, eq=False)
class MinimumForces(ForceAnswer):
    """
    Smallest contact forces that balance an external wrench: the dual problem (section III).

    Attributes
    ----------
    status : Status
        INFEASIBLE when no forces inside cones and caps balance it.
    forces : (k, 4) array [N, N, N, N m]
        Of the contacts on the object; (0, 4) when infeasible.
    peak : float
        Smallest use of the force bound: max n_i / f_max,i for linf. More than 1 says how much
        larger the caps would have to be; inf when no forces inside the cones, up to a million
        times the caps, balance the wrench. Joint limits are not widened: inf also when they alone
        are in the way.
    peak_lower : float
        Dual bound: no forces need less.
    violation : float
        Smallest |G x + F_ext| [N] that remains with forces inside cones and caps, torques
        counted over the grasp's lever arm; 0 when feasible, inf when the joints cannot carry the
        hand itself.
    unbalanced : (6,) array [N, N m]
        That G x + F_ext, about the object frame's origin; zero when feasible, and when the joints
        cannot carry the hand itself.
    cone_usage : (k,) array

    """

    grasp: Grasp
    status: Status
    forces: Array
    peak: float
    peak_lower: float
    violation: float
    cone_usage: Array
    unbalanced: Array

    @property
    def reason(self) -> str:
        """Say why there are no forces, and what is missing; '' when there are."""
        if self.feasible:
            return ''
        if not math.isfinite(self.violation):
            return 'the joints cannot carry the hand itself, with any forces inside the cones'
        size = self.violation * np.repeat([1.0, self.grasp.lever_arm], 3)
        seen = np.where(np.abs(self.unbalanced) > DUST * size, self.unbalanced, 0.0)
        parts = [f'({", ".join(f"{x:.4g}" for x in part)}) {unit}'
                 for part, unit in ((seen[:3], 'N'), (seen[3:], 'N m')) if part.any()]
        left = ' and '.join(parts) or 'next to nothing'
        if math.isfinite(self.peak):
            return ('no forces within cones and caps balance the external wrench: '
                    f'{self.peak:.4g} times the caps would be needed; {left} is left unbalanced')
        others = '' if self.grasp.joint_limits is None else ' and joint limits'
        return (f'no forces inside the friction cones{others} balance the external wrench, '
                f'whatever the caps: {left} is left unbalanced')


def minimum_forces(grasp: Grasp, external_wrench: ArrayLike,
                   time_limit_s: Limit = None) -> MinimumForces:
    """
    Find the smallest contact forces with G x + F_ext = 0.

    Smallest in the sense of the grasp's own bound; alpha of the task -F_ext times ``peak`` is 1,
    unless joint limits, which do not grow with the bound, decide.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    external_wrench : (6,) array_like [N, N m]
        Load on the object, about the object frame's origin.
    time_limit_s : float, optional
        [s]

    Returns
    -------
    MinimumForces

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    time_limit_s = TimeLimit.of(time_limit_s)
    load = as_wrench(external_wrench, 'external_wrench')
    scaled = grasp.scaled_wrench(load)
    size = float(np.sqrt(scaled @ scaled))
    if size <= NEGLIGIBLE and grasp.rests:
        return MinimumForces(grasp, Status.OPTIMAL, np.zeros((len(grasp), 4)), 0.0, 0.0, 0.0,
                             np.zeros(len(grasp)), NO_WRENCH)
    size = size if grasp.rests else 1.0  # else it is the hand's own weight that asks for forces
    widening = VirtualContact(np.zeros((6, 1)), False, np.array([-1.0]), role='widening')
    scaled_grasp = grasp if grasp.joint_limits is None else dataclasses.replace(
        grasp, joint_limits=grasp.joint_limits.scaled(1.0 / size))
    optimum = prove_optimal(assemble(scaled_grasp, widening, load / size), time_limit_s)
    if optimum is None:
        peak = lower = np.inf
    else:
        peak, lower = float(optimum.values[0]) * size, -optimum.proof.upper * size
    if optimum is None or peak > 1.0 + USAGE_TOLERANCE:
        left, unbalanced = violation(grasp, load, time_limit_s)
        return MinimumForces(grasp, Status.INFEASIBLE, NO_FORCES, peak, lower, left, NO_USAGE,
                             unbalanced)
    return MinimumForces(
        grasp, Status.OPTIMAL, frozen(optimum.shares * grasp.force_units * size), peak, lower, 0.0,
        frozen(friction_cone.usage_of_shares(optimum.shares * (size / peak))), NO_WRENCH)


def violation(grasp: Grasp, external_wrench: ArrayLike,
              time_limit_s: Limit = None) -> tuple[float, Array]:
    """
    Smallest G x + F_ext that forces inside cones and caps leave.

    Returns
    -------
    float : its size [N], torques about the contacts' centre and over the grasp's lever arm
    (6,) array [N, N m] : what is left, about the object frame's origin

    """
    columns = np.concatenate([np.zeros((6, 1)), np.eye(6)], axis=1)
    remainder = VirtualContact(columns, True, np.concatenate([[-1.0], np.zeros(6)]))
    optimum = prove_optimal(assemble(grasp, remainder, external_wrench), time_limit_s)
    if optimum is None:
        return np.inf, NO_WRENCH
    left = optimum.values * grasp.force_scale
    left[4:] *= grasp.lever_arm
    return float(left[0]), frozen(shift(left[1:], -grasp.center))

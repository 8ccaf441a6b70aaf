# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Forces to hold with: those that apply exactly a wanted wrench, as far from slip and caps as can be.

``evaluate`` tells the most that a grasp can do, with forces on the edge of cones and caps, and
``minimum_forces`` the least that it needs, on the edge of the cones. A controller that holds an
object wants neither, but the middle between them: ``force_center``, which is unique and moves
smoothly with contacts and load.
"""

from dataclasses import dataclass

from grasp_quality.arguments import require_grasp, require_start
from grasp_quality.arrays import checked_number, frozen
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.force_center import force_center, ForceCenter
from grasp_quality.friction_cone import usage_of_shares
from grasp_quality.grasp import Grasp
from grasp_quality.holding import minimum_forces
from grasp_quality.problem import assemble, VirtualContact
from grasp_quality.solution import NO_FORCES, NO_USAGE
from grasp_quality.status import ForceAnswer, Status
from grasp_quality.time_limit import Limit, TimeLimit
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
NO_TASK = VirtualContact(np.zeros((6, 1)), False, np.array([1.0]))


@dataclass(frozen=True, eq=False)
class HoldForces(ForceAnswer):
    """
    Contact forces that apply exactly a wanted wrench.

    Attributes
    ----------
    grasp : Grasp
    status : Status
        OPTIMAL: the forces with the largest margin. OPTIMAL_NO_INTERIOR: there are forces, but
        none strictly inside all cones and bounds; these are the smallest. INFEASIBLE: none.
    forces : (k, 4) array [N, N, N, N m]
        [t1, t2, n, m_n] in the contact frames, finger on object; (0, 4) when infeasible.
    cone_usage : (k,) array
        Share of each friction cone in use; (0,) when infeasible.
    bound_usage : float
        Share of the force bound in use: max n_i / f_max,i for linf. When infeasible, how much of
        it would be needed; more than 1, inf where no forces inside the cones do.
    center : ForceCenter or None
        To begin the next search from.

    """

    grasp: Grasp
    status: Status
    forces: Array
    cone_usage: Array
    bound_usage: float
    center: ForceCenter | None = None


def hold_forces(grasp: Grasp, external_wrench: ArrayLike | None = None,
                task_wrench: ArrayLike | None = None, alpha: float = 1.0,
                cap_weight: float = 1.0, start: HoldForces | None = None,
                time_limit_s: Limit = None) -> HoldForces:
    """
    Find the forces with the largest margin that apply exactly G x + F_ext = alpha F_task.

    Largest margin means the greatest sum_i log det P_i(x_i) + cap_weight sum_j log(slack of bound
    j), every force as a share of its cap: unique, and smooth in contacts and wrenches. A pair of
    fingers that holds nothing presses with 2 / (2 + cap_weight) of its caps.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object (its weight), about the object frame's origin.
    task_wrench : (6,) array_like [N, N m], optional
        What the fingers shall apply besides balancing it; none when left out.
    alpha : float
        Multiple of the task wrench to apply: 1 for the task as given.
    cap_weight : float
        > 0; how much distance from the caps counts against distance from slip. 1 is the middle,
        more presses less.
    start : HoldForces, optional
        Answer for contacts close by, to begin from; changes the time only.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    HoldForces

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    require_start(start, HoldForces, 'hold_forces')
    load = np.zeros(6) if external_wrench is None else as_wrench(
        external_wrench, 'external_wrench')
    multiple = checked_number(alpha, 'alpha', InvalidTaskError)
    weight = checked_number(cap_weight, 'cap_weight', InvalidTaskError, above=0.0)
    if task_wrench is not None:
        load = load - multiple * as_wrench(task_wrench, 'task_wrench')
    problem = assemble(grasp, NO_TASK, load)
    limit = TimeLimit.of(time_limit_s)
    center = force_center(
        problem, 0.0, weight, None if start is None else start.center, limit)
    if center is not None:
        return HoldForces(
            grasp, Status.OPTIMAL, frozen(center.shares * grasp.force_units),
            frozen(usage_of_shares(center.shares)), center.proof.bound_usage, center)
    least = minimum_forces(grasp, load, limit)
    if least.status is Status.INFEASIBLE:
        return HoldForces(grasp, Status.INFEASIBLE, NO_FORCES, NO_USAGE, least.peak)
    return HoldForces(
        grasp, Status.OPTIMAL_NO_INTERIOR, least.forces, least.cone_usage, least.peak)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Why alpha is what it is: which contacts limit the task, and what would change it.

The multipliers of the optimum answer both (docs/explanations.md). Slopes hold for small changes;
what the best single change really gives is found by solving once more with it made.
"""

from dataclasses import dataclass

from grasp_quality import sensitivity
from grasp_quality.arguments import require_grasp
from grasp_quality.exceptions import InvalidTaskError
from grasp_quality.explanation_text import paragraph
from grasp_quality.grasp import Grasp
from grasp_quality.kinks import Uniqueness, uniqueness
from grasp_quality.problem import build_problem
from grasp_quality.proof import ZERO_TOLERANCE
from grasp_quality.slopes import (
    can_step, changed_along, largest_alpha, one_sided_slopes, Slopes, smooth_slopes)
from grasp_quality.solution import Solution
from grasp_quality.solve import solve
from grasp_quality.task import TaskCone, TaskWrench
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
# one unit of change of each kind: a newton, a hundredth, a millimetre, a degree
NO_SLOPE = 1e-140  # squares of what is smaller leave float64: it has no direction
UNITS = {'max_force': 1.0, 'friction': 0.01, 'position': 1e-3, 'rotation': np.deg2rad(1.0)}


@dataclass(frozen=True, eq=False)
class Change:
    """
    One change of one contact.

    Attributes
    ----------
    contact : str
    kind : str
        'max_force', 'friction', 'position' (along the surface) or 'rotation' (of the normal).
    size : float
        One newton, 0.01, 0.001 m, or one degree in rad.
    direction : (3,) array
        Unit vector in object axes to move along or to turn about; zero for the other kinds.
    gain : float
        What the slope promises alpha to grow by.
    alpha : float
        Largest alpha with the change made, solved anew.

    """

    contact: str
    kind: str
    size: float
    direction: Array
    gain: float
    alpha: float


@dataclass(frozen=True, eq=False)
class Explanation:
    """
    Why alpha is what it is.

    Attributes
    ----------
    solution : Solution
        Answer at eps = 0 that is explained.
    uniqueness : Uniqueness
        Whether forces and multipliers are unique; where not, slopes are one-sided.
    limits : (k,) tuple of str
        Of every contact: 'slip' or 'cap' when a part of alpha hangs on its cap, mostly through
        friction or not; '' when none does. Whether a larger cap helps is in ``forward``.
    shares : (k,) array
        f_max d alpha / d f_max over alpha: without a load, and away from kinks, they and those of
        the joints add up to one.
    joint_shares : (j,) array
        tau_max d alpha / d tau_max over alpha of every joint with a limit.
    forward, backward : Slopes
        For changes in the positive and in the negative sense; the same where alpha is smooth.
    best_change : Change or None
        The single change that gives most; None when none helps.
    text : str
        The same in one paragraph.

    """

    solution: Solution
    uniqueness: Uniqueness
    limits: tuple[str, ...]
    shares: Array
    joint_shares: Array
    forward: Slopes
    backward: Slopes
    best_change: Change | None
    text: str

    @property
    def grasp(self) -> Grasp:
        """Return the grasp that is explained."""
        return self.solution.grasp


def explain(grasp: Grasp, task: TaskWrench | TaskCone, external_wrench: ArrayLike | None = None,
            time_limit_s: float | None = None) -> Explanation:
    """
    Explain the largest alpha of a task.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    task : TaskWrench or TaskCone
        About the object frame's origin [N, N m].
    external_wrench : (6,) array_like [N, N m], optional
        What the world applies on the object besides the fingers.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    Explanation

    Raises
    ------
    InvalidTaskError, SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    if not isinstance(task, (TaskWrench, TaskCone)):
        raise InvalidTaskError(
            f'explain takes a TaskWrench or a TaskCone, got {type(task).__name__}: explain the '
            'wrenches of a polytope or an ellipsoid one by one')
    limit = TimeLimit.of(time_limit_s)
    problem = build_problem(grasp, task, external_wrench)
    solution = solve(problem, limit)
    alpha = largest_alpha(task, external_wrench, limit)
    if not solution.feasible:
        unique = Uniqueness(True, True)
    else:
        unique = uniqueness(problem, limit)
    forward = backward = smooth_slopes(solution)
    if not unique.smooth:
        forward, backward = one_sided_slopes(
            alpha, grasp, ZERO_TOLERANCE * solution.size * solution.powerless)
    worth = solution.dalpha_dmax_force * grasp.max_normal_forces
    counts = solution.feasible and not solution.powerless
    shares = worth / solution.alpha if counts else np.zeros(len(grasp))
    joint_shares = np.zeros(len(solution.joint_multiplier))
    if grasp.joint_limits is not None and counts:
        torques = grasp.joint_limits.max_torques
        joint_shares = solution.dalpha_dmax_torque * torques / solution.alpha
    limits = tuple(
        sensitivity.reason(grasp, solution.local_multipliers, i)
        if shares[i] > sensitivity.NEGLIGIBLE else '' for i in range(len(grasp)))
    best = None
    if solution.feasible:
        made = [(gain, kind, i, way, alpha(changed_along(grasp, i, kind, UNITS[kind] * way)))
                for gain, kind, i, way in candidates(forward, backward)
                if can_step(grasp, i, kind, UNITS[kind])]
        size = max(solution.alpha, sensitivity.LEAST * solution.size)
        made = [row for row in made if row[-1] > solution.alpha + sensitivity.NEGLIGIBLE * size]
        if made:
            gain, kind, i, way, reached = max(made, key=lambda row: row[-1])
            turned = grasp.rotations[i] @ way if kind in ('position', 'rotation') else np.zeros(3)
            best = Change(grasp.name_of(i), kind, UNITS[kind], turned, gain, reached)
    return Explanation(
        solution, unique, limits, shares, joint_shares, forward, backward, best,
        paragraph(solution, unique, limits, shares, joint_shares, forward, backward, best))


def candidates(forward: Slopes, backward: Slopes) -> list[tuple[float, str, int, Array]]:
    """Best change of each kind by slopes: (gain, kind, contact, direction (3,) in its frame)."""
    found = []
    for kind in ('max_force', 'friction'):
        slopes = getattr(forward, kind)
        i = int(np.argmax(slopes))
        found.append((float(slopes[i]) * UNITS[kind], kind, i, np.array([1.0, 0.0, 0.0])))
    for kind in ('position', 'rotation'):
        ahead, behind = getattr(forward, kind)[:, :2], getattr(backward, kind)[:, :2]
        # along either axis only uphill: the derivative where smooth, the better side at a kink
        way = np.where(ahead > -behind, np.maximum(ahead, 0.0), np.minimum(behind, 0.0))
        sizes = np.linalg.norm(way, axis=1)
        i = int(np.argmax(sizes))
        if sizes[i] > NO_SLOPE:
            found.append((float(sizes[i]) * UNITS[kind], kind, i,
                          np.append(way[i] / sizes[i], 0.0)))
    return [row for row in found if row[0] > 0.0]

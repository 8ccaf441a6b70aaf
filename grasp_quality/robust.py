# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Alpha under uncertainty: what contacts, friction and load that are not known exactly do to it.

Draws grasps from the noise of ``uncertainty``, solves each, and says with ``sample_statistics``
what the sample tells about the distribution of alpha. A sample that is infeasible, or that no
solver could prove, counts as alpha 0, so that every error is to the safe side.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from grasp_quality.arguments import require_grasp
from grasp_quality.arrays import checked_number, floats, frozen
from grasp_quality.exceptions import InvalidTaskError, SolverError, SolverTimeoutError
from grasp_quality.grasp import Grasp
from grasp_quality.grasp_set import GraspSet
from grasp_quality.many import evaluate_many, Outcome
from grasp_quality.problem import build_problem, NO_WRENCH
from grasp_quality.sample_statistics import quantile_interval, wilson_interval
from grasp_quality.solve import solve
from grasp_quality.status import OneLine
from grasp_quality.task import TaskCone, TaskPolytope, TaskWrench
from grasp_quality.time_limit import TimeLimit
from grasp_quality.uncertainty import draw, Uncertainty
from grasp_quality.wrench import as_wrench
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Task: TypeAlias = TaskWrench | TaskCone | TaskPolytope

MOST_SAMPLES = 1_000_000
CONFIDENCE = 0.95  # of intervals, unless said otherwise


@dataclass(frozen=True, eq=False)
class RobustAlpha(OneLine):
    """
    The distribution of alpha, as far as a sample tells.

    Attributes
    ----------
    alpha : (N,) array
        Of every sample, in the order of drawing; 0 where infeasible or not proved.
    level, quantile, quantile_lower, quantile_upper : float or (m,) array
        Asked quantiles q, the alpha that a share q of the samples does not exceed, and the
        interval that holds the true one with probability ``confidence``; numbers when one was
        asked for.
    probability, probability_lower, probability_upper : float
        Share of the samples with alpha >= 1, which can apply the task as given, and its interval.
    confidence : float
        Of all intervals, each by itself.
    infeasible, unproved : int
        Samples that are proved infeasible, and those for which no answer could be proved.

    """

    alpha: Array
    level: float | Array
    quantile: float | Array
    quantile_lower: float | Array
    quantile_upper: float | Array
    probability: float
    probability_lower: float
    probability_upper: float
    confidence: float
    infeasible: int
    unproved: int


def robust_alpha(
        grasp: Grasp, task: Task,
        external_wrench: ArrayLike | None = None, *, contact_noise: ArrayLike = 0.0,
        normal_noise: ArrayLike = 0.0, friction_noise: ArrayLike = 0.0,
        load_noise: ArrayLike = 0.0, samples: int = 1000,
        quantile: float | Sequence[float] = 0.05, confidence: float = CONFIDENCE, seed: int = 0,
        time_limit_s: float | None = None) -> RobustAlpha:
    """
    Tell how alpha is distributed when contacts, friction and load are not known exactly.

    Parameters
    ----------
    grasp : Grasp
        Contacts as they are believed to be: the means.
    task : TaskWrench, TaskCone or TaskPolytope
        Exact. Of a cone alpha is alpha_z, of a polytope the smallest alpha of its wrenches.
    external_wrench : (6,) array_like [N, N m], optional
        Mean of what the world applies on the object, about the object frame's origin.
    contact_noise : float or (k,) array_like [m]
        Standard deviation of every coordinate of the contact points.
    normal_noise : float or (k,) array_like [rad]
        Of the tilt of the contact normals about each tangent.
    friction_noise : float or (k,) array_like [-]
        Of the friction coefficients, independent between contacts, cut off at 0. Friction that is
        uncertain but the same everywhere needs no sampling: alpha grows with it, so that the
        quantile of alpha is the alpha of friction's quantile.
    load_noise : float or (6,) array_like [N, N m]
        Of the components of the external wrench.
    samples : int
        N; the interval shrinks with sqrt(N).
    quantile : float or sequence of float
        Levels in (0, 1).
    confidence : float
        Of the intervals, in (0, 1).
    seed : int
        The same seed gives the same answer, with the same version of NumPy.
    time_limit_s : float, optional
        For the whole question [s].

    Returns
    -------
    RobustAlpha

    Raises
    ------
    InvalidTaskError, SolverTimeoutError

    """
    require_grasp(grasp)
    limit = TimeLimit.of(time_limit_s)
    load = NO_WRENCH if external_wrench is None else as_wrench(external_wrench, 'external_wrench')
    noise = Uncertainty(contact_noise, normal_noise, friction_noise, load_noise, len(grasp))
    levels = _checked_levels(quantile)
    sure = checked_number(confidence, 'confidence', InvalidTaskError, above=0.0, below=1.0)
    count = _whole(samples, 'samples', 1, MOST_SAMPLES)
    quantile_interval(np.zeros(count), max(levels), sure)  # are they enough?
    if not isinstance(task, (TaskWrench, TaskCone, TaskPolytope)):
        raise InvalidTaskError(
            f'task must be a TaskWrench, TaskCone or TaskPolytope, got {type(task).__name__}: '
            'give an ellipsoid as the TaskPolytope of the ends of its axes')
    parts = [_alphas(grasps, loads, task, limit) for grasps, loads in draw(
        grasp, load, noise, count, _whole(seed, 'seed', 0, 2 ** 64 - 1))]
    alpha = np.concatenate([part[0] for part in parts])
    ordered = np.sort(alpha)
    rows = np.array([quantile_interval(ordered, level, sure) for level in levels])  # (m, 3)
    value, below, above = (_shaped(column, quantile) for column in rows.T)
    share, least, most = wilson_interval(int((alpha >= 1.0).sum()), count, sure)
    return RobustAlpha(
        alpha=frozen(alpha), level=_shaped(np.array(levels), quantile), quantile=value,
        quantile_lower=below, quantile_upper=above, probability=share, probability_lower=least,
        probability_upper=most, confidence=sure, infeasible=sum(part[1] for part in parts),
        unproved=sum(part[2] for part in parts))


def _shaped(values: Array, quantile: float | Sequence[float]) -> float | Array:
    """Give (m,) values the shape of the question: a number where one was asked for."""
    return float(values[0]) if np.ndim(quantile) == 0 else frozen(values.copy())


def _checked_levels(quantile: float | Sequence[float]) -> list[float]:
    levels = np.atleast_1d(
        floats(quantile, 'quantile', 'a number', InvalidTaskError)).tolist()
    if not levels:
        raise InvalidTaskError('quantile must be a number or several, got none')
    return [checked_number(level, 'quantile', InvalidTaskError, above=0.0, below=1.0)
            for level in levels]


def _whole(value: int, name: str, least: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) \
            or not least <= value <= most:
        raise InvalidTaskError(
            f'{name} must be a whole number from {least} to {most}, got {value!r}')
    return int(value)


def _alphas(grasps: GraspSet, loads: Array, task: Task,
            limit: TimeLimit | None) -> tuple[Array, int, int]:
    """Alpha (N,) of every sample, and how many are infeasible and unproved."""
    if isinstance(task, TaskCone):
        alpha, status = _cone_alphas(grasps, loads, task, limit)
    else:
        wrenches = task.wrenches if isinstance(task, TaskPolytope) else task.wrench[None]
        answer = evaluate_many(grasps, wrenches[:, None], loads, time_limit_s=limit)
        alpha, status = answer.alpha.min(axis=0), answer.status
    unproved = (status == Outcome.UNPROVED).any(axis=0)
    infeasible = (status == Outcome.INFEASIBLE).any(axis=0) & ~unproved
    return (np.where(unproved | infeasible, 0.0, alpha), int(infeasible.sum()),
            int(unproved.sum()))


def _cone_alphas(grasps: GraspSet, loads: Array, cone: TaskCone,
                 limit: TimeLimit | None) -> tuple[Array, NDArray[np.int8]]:
    """Alpha_z (N,) and outcome (1, N) of a task cone, one solve after the other."""
    alpha = np.zeros(len(grasps))
    status = np.full((1, len(grasps)), Outcome.UNPROVED, dtype=np.int8)
    for i, grasp in enumerate(grasps):
        try:
            solution = solve(build_problem(grasp, cone, loads[i]), limit)
        except SolverTimeoutError:
            raise
        except SolverError:
            continue
        alpha[i], status[0, i] = solution.alpha, Outcome[solution.status.name]
    return alpha, status

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The forces with the largest margin, among all that apply a given share of a task.

    maximise sum_i log det P_i(x_i) + w sum_j log(slack_j)   at a fixed alpha

over the friction cones of the contacts and over what the force bound leaves. The maximum is
unique wherever some force is strictly inside, and moves as smoothly as the contacts do: the forces
of the largest alpha are neither (docs/derivations.md). What comes out is proved like any answer:
equilibrium, cones and bound are worked out anew from the forces.
"""

from dataclasses import dataclass
from functools import partial

from grasp_quality.centering import weighted_center
from grasp_quality.problem import ConicProblem
from grasp_quality.proof import Proof, prove
from grasp_quality.time_limit import TimeLimit
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ForceCenter:
    """
    A proved centre.

    Attributes
    ----------
    shares : (k, 4) array
        Local forces [t1/mu, t2/mu, n, m_n/gamma] as shares of the caps.
    values : (t,) array
        Variables of the virtual contact, in its scaled units.
    proof : Proof
        Of equilibrium, cones and bound; its gap means nothing here.
    state : (u, x)
        Where the next centre, of contacts close by, may begin.

    """

    shares: Array
    values: Array
    proof: Proof
    state: tuple[Array, Array]


def force_center(problem: ConicProblem, value: float, cap_weight: float = 1.0,
                 start: ForceCenter | None = None,
                 limit: TimeLimit | None = None) -> ForceCenter | None:
    """
    Find the forces with the largest margin at a fixed value of the task.

    Parameters
    ----------
    problem : ConicProblem
        Of a task wrench or a task cone.
    value : float
        First variable of the virtual contact, alpha in its scaled unit, as it shall be.
    cap_weight : float
        w > 0, weight of the slack of every bound against the friction cones.
    start : ForceCenter, optional
        Of contacts close by; speeds the search up and does not change the answer.
    limit : TimeLimit, optional
        Of the question that this is part of.

    Returns
    -------
    ForceCenter, or None where no force is strictly inside all cones and bounds

    Raises
    ------
    SolverTimeoutError

    """
    layout, virtual = problem.layout, problem.virtual
    blocks, E, e = layout.blocks, problem.E, problem.e  # (blocks, d), -1 where padded
    if virtual.is_cone and value > 0.0:  # the wrench may turn inside the task cone
        row = np.zeros((1, E.shape[1]))
        row[0, layout.virtual[0]] = 1.0
        E, e = np.concatenate([E, row]), np.append(e, value)
    else:
        blocks = blocks[~np.isin(blocks[:, 0], layout.virtual)]
        e = e - E[:, layout.virtual[0]] * value
    padded = blocks < 0
    is_line = padded[:, 1:].all(axis=1)
    is_bound = ~np.isin(blocks[:, 0], layout.contact_variables)
    is_bound &= ~np.isin(blocks[:, 0], layout.virtual)
    # the logarithm of a half line is half of its log det as a cone
    weights = np.where(is_line, 0.5, 1.0) * np.where(is_bound, cap_weight, 1.0)
    begin = None
    if start is not None and start.state[0].shape == blocks.shape:
        begin = start.state
    columns, objective = np.where(padded, 0.0, E[:, blocks]), np.zeros(blocks.shape)
    on_step = None if limit is None else partial(limit.remaining_s, problem)
    found = weighted_center(columns, e, objective, weights, begin, on_step)
    if found is None and begin is not None:
        found = weighted_center(columns, e, objective, weights, on_step=on_step)
    if found is None:
        return None
    u = np.zeros(layout.shape[1])
    u[layout.virtual[0]] = value
    u[blocks[~padded]] = found[0][~padded]
    shares, values = layout.shares(u), u[layout.virtual]
    proof = prove(problem, shares, values, np.zeros(layout.shape[0]))
    return ForceCenter(shares, values, proof, found) if proof.admissible else None

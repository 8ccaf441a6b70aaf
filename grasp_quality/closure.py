# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Force closure: whether the contacts can resist every wrench, if only it is small enough.

A grasp has force closure when its matrix has rank 6 and there is an internal force strictly
inside all friction cones, and inside the joints' limits where there are any. The margin of the
second is itself a conic program: a common share of the caps, pressed by every contact on top of
forces inside the cones, as the virtual contact; the joints' limits shrink by the same share.
"""

from dataclasses import dataclass

from grasp_quality.arguments import require_grasp
from grasp_quality.grasp import Grasp
from grasp_quality.problem import assemble, VirtualContact
from grasp_quality.solve import prove_optimal
from grasp_quality.time_limit import Limit
import numpy as np

MARGIN_TOLERANCE = 1e-8  # share of the caps below which an internal force is not strict


@dataclass(frozen=True)
class ForceClosure:
    """
    Force closure: rank 6 and a strictly interior internal force.

    Attributes
    ----------
    closed : bool
    rank : int
        Of the grasp matrix.
    margin : float
        Largest share of the caps, in [0, 1], by which every contact can stay inside its friction
        cone while the forces balance each other: |(t/mu, m_n/gamma)| <= n - margin f_max; and
        every limited joint inside its limit: |tau| <= (1 - margin) tau_max.

    """

    closed: bool
    rank: int
    margin: float


def force_closure(grasp: Grasp, time_limit_s: Limit = None) -> ForceClosure:
    """
    Decide force closure, with its margin.

    Parameters
    ----------
    grasp : Grasp
        Contacts with their frames, friction, caps and force bound.
    time_limit_s : float, optional
        [s]

    Returns
    -------
    ForceClosure

    Raises
    ------
    SolverError, SolverTimeoutError

    """
    require_grasp(grasp)
    normals = grasp.scaled_matrix[:, :, 2].sum(axis=1, keepdims=True)  # (6, 1)
    pressing = VirtualContact(-normals, False, np.array([1.0]), role='pressing')
    optimum = prove_optimal(assemble(grasp, pressing), time_limit_s)
    if optimum is None:  # the joints cannot carry the hand itself
        return ForceClosure(False, grasp.rank, 0.0)
    margin = max(0.0, min(float(optimum.values[0]), optimum.proof.upper))
    return ForceClosure(grasp.rank == 6 and margin > MARGIN_TOLERANCE, grasp.rank, margin)

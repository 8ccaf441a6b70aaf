# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Answers as plain values for JSON and tables; units are SI and stand in docs/grasp_files.md.

The names are those of the Python interface: what ``Solution.alpha_upper`` is there is
``alpha_upper`` here.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from grasp_quality import ConeSolution, Grasp, PolytopeSolution, Solution
import numpy as np
from numpy.typing import NDArray

Answer: TypeAlias = Solution | PolytopeSolution
Row: TypeAlias = dict[str, Any]


def answer_row(grasp: Grasp, answer: Answer) -> Row:
    """Return an answer as a dictionary of numbers, strings, lists and None."""
    if isinstance(answer, PolytopeSolution):
        return {
            'status': answer.status.name, 'quality': answer.quality,
            'alpha_min': answer.alpha_min, 'alphas': answer.alphas.tolist(),
            'parallelotope_scale': answer.parallelotope_scale,
            'guaranteed_scale': answer.guaranteed_scale,
            'answers': [answer_row(grasp, one) for one in answer.solutions]}
    row = {
        'status': answer.status.name, 'alpha': answer.alpha, 'alpha_upper': answer.alpha_upper,
        'alpha_lower': answer.alpha_lower, 'holdable': answer.holdable, 'pinned': answer.pinned,
        'powerless': answer.powerless, 'remark': answer.remark,
        'friction_margin': answer.friction_margin, 'limited_by': answer.limited_by,
        'limiting_contact': answer.limiting_contact,
        'limiting_reason': answer.limiting_reason, 'wrench': answer.wrench.tolist(),
        'forces': force_rows(grasp, answer.forces, answer.cone_usage),
        'dalpha_dexternal_wrench': answer.dalpha_dexternal_wrench.tolist(),
        'dalpha_dmax_force': answer.dalpha_dmax_force.tolist(),
        'dalpha_dfriction': answer.dalpha_dfriction.tolist(),
        'equilibrium_residual': None if answer.proof is None else answer.proof.residual}
    if isinstance(answer, ConeSolution):
        row.update(alpha_axis=answer.alpha_axis, alpha_worst=answer.alpha_worst)
    return row


def force_rows(grasp: Grasp, forces: NDArray[np.float64], cone_usage: NDArray[np.float64]
               ) -> list[Row]:
    """Return one row a contact; empty where there are no forces."""
    return [
        {'name': name, 'finger': finger, 'force': force.tolist(), 'cone_usage': float(usage),
         'cap_usage': float(force[2] / cap)}
        for name, finger, force, usage, cap in zip(
            grasp.names, grasp.contacts.fingers, forces, cone_usage, grasp.max_normal_forces)]

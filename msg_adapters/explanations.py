# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Explanations: core objects to the fields of an Explain response."""

from grasp_quality.explanation import Explanation
from grasp_quality_msgs.msg import ContactInfluence
from grasp_quality_msgs.srv import Explain
from msg_adapters.results import status_result
from msg_adapters.wrenches import fill_xyz


def fill_explanation(response: Explain.Response, found: Explanation) -> None:
    """Write an explanation into a response; of one that is infeasible only the result."""
    solution = found.solution
    response.result = status_result(solution.status, remark=solution.remark)
    if not solution.feasible:
        return
    response.alpha, response.alpha_upper = float(solution.alpha), float(solution.alpha_upper)
    response.limiting_contact = solution.limiting_contact
    response.limiting_reason = solution.limiting_reason
    response.smooth = found.uniqueness.smooth
    response.contacts = [_influence(found, i) for i in range(len(found.grasp))]
    if found.grasp.joint_limits is not None:
        response.joints = list(found.grasp.joint_limits.names)
        response.joint_shares = found.joint_shares.tolist()
    best = found.best_change
    if best is not None:
        response.best_contact, response.best_kind = best.contact, best.kind
        response.best_size, response.best_alpha = float(best.size), float(best.alpha)
        fill_xyz(response.best_direction, best.direction)
    response.text = found.text


def _influence(found: Explanation, i: int) -> ContactInfluence:
    message = ContactInfluence(
        name=found.grasp.name_of(i), limit=found.limits[i], share=float(found.shares[i]))
    for side, end in ((found.forward, ''), (found.backward, '_backward')):
        setattr(message, f'dalpha_dmax_force{end}', float(side.max_force[i]))
        setattr(message, f'dalpha_dfriction{end}', float(side.friction[i]))
        fill_xyz(getattr(message, f'dalpha_dposition{end}'), side.position[i])
        fill_xyz(getattr(message, f'dalpha_drotation{end}'), side.rotation[i])
    return message

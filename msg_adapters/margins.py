# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Measured margins: core objects to GraspMargin messages."""

from grasp_quality.grasp import Grasp
from grasp_quality.measured_margin import MeasuredMargin
from grasp_quality.status import Status
from grasp_quality_msgs.msg import ContactMargin, GraspMargin
from msg_adapters.results import status_result
from msg_adapters.wrenches import to_wrench
import numpy as np
from std_msgs.msg import Header

NOT_ALLOWED = ('no forces inside the friction cones and the force bound apply any share of the '
               'wrench that the measured forces apply: check friction coefficients and sensors')


def margin_message(header: Header, grasp: Grasp, found: MeasuredMargin) -> GraspMargin:
    """Build a GraspMargin; slip margins are held in [-1, 1], and infeasible ones carry nothing."""
    message = GraspMargin(header=header, result=status_result(found.status, NOT_ALLOWED))
    if found.status is Status.INFEASIBLE:
        return message
    margins = np.clip(found.slip_margins, -1.0, 1.0)
    message.slip_margin = float(margins.min())
    to_wrench(found.applied_wrench, message.applied_wrench)
    message.load_alpha, message.load_share = float(found.load_alpha), float(found.load_share)
    message.wanted_margin, message.restorable = float(found.wanted_margin), found.restorable
    message.largest_change = float(found.sizes.max())
    changes = np.zeros((len(grasp), 6))
    if found.change is not None:
        changes[:, :3] = np.einsum('kij,kj->ki', grasp.rotations, found.change[:, :3])
        changes[:, 3:] = grasp.rotations[:, :, 2] * found.change[:, 3:]
    message.contacts = [
        ContactMargin(name=name, slip_margin=float(margin), change=to_wrench(change))
        for name, margin, change in zip(grasp.names, margins, changes)]
    return message

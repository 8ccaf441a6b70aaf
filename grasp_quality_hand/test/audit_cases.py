# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Two fingers that lift 6 N between them, correct to the last digit, for the audit to judge."""

import dataclasses

from grasp_quality_hand.audit_parts import (
    Contacts, Forces, LocalWrench, Quality, ReceivedContact, Settings)
from grasp_quality_hand.force_records import ForceRecords, GRACE_S, PATIENCE_S
from grasp_quality_hand.force_rules import Force
import numpy as np

SETTINGS = Settings('PCWF', 0.5, 0.005, 10.0, 'linf', ('left', 'right'), (), 0.1)
LEFT = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])   # third column +x
RIGHT = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])  # third column -x
STAMP = 1_000_000_000
LEFT_FORCE = Force('left', np.array([-0.02, 0.0, 0.0]), LEFT[:, 2],
                   np.array([6.0, 0.0, 3.0, 0.0, 0.0, 0.0]), 1.0)
RIGHT_FORCE = Force('right', np.array([0.02, 0.0, 0.0]), RIGHT[:, 2],
                    np.array([-6.0, 0.0, 3.0, 0.0, 0.0, 0.0]), 1.0)
CONTACTS = Contacts(STAMP, 'object', [
    ReceivedContact(LEFT_FORCE.position, LEFT), ReceivedContact(RIGHT_FORCE.position, RIGHT)],
    are_poses=True)
QUALITY = Quality(STAMP, True, 3.0, (3.0, 0.0, 0.0), np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
                  np.array([0.0, 0.0, -3.0, 0.0, 0.0, 0.0]))
FORCES = Forces(STAMP, 'object', [LEFT_FORCE, RIGHT_FORCE], 0.01)
NEXT = dataclasses.replace(  # what the node says of the next sample: nothing before may come still
    QUALITY, stamp=2 * STAMP, optimal=False, alpha=0.0, others=())
LOCAL = LocalWrench(STAMP, 'left', 'left', np.array([-3.0, 0.0, 6.0, 0.0, 0.0, 0.0]))
ALL = (SETTINGS, CONTACTS, QUALITY, FORCES, 3.0, LOCAL)


def changed(part, **fields):
    """Return a part with other values in some fields."""
    return dataclasses.replace(part, **fields)


def judged(*parts, **options):
    """Store parts, let time pass and return (violations, count)."""
    records = ForceRecords(**options)
    for i, part in enumerate(parts):
        records.store(part, 1e-3 * i)
    records.store(NEXT, 1.1 * GRACE_S)
    return records.judge(2.0 * GRACE_S) + records.judge(2.0 * PATIENCE_S), records.count

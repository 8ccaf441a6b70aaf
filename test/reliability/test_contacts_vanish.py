# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Contacts that vanish one by one, down to none, and come back.

Every sample is answered for exactly the contacts in it: with none NO_CONTACTS and no forces, with
too few for the task alpha 0, and as before once they are back.
"""

from grasp_quality_msgs.msg import ResultCode
from grasps import EIGHT
import pytest
from rig import MAX_AGE_S, positions


def test_from_eight_to_none_and_back(hand, poses):
    alphas = {}
    for count in (*range(8, 0, -1), *range(1, 9)):
        found = hand.outputs.answer(poses(EIGHT[:count]), lambda quality, count=count: any(
            m.header.stamp == quality.header.stamp and len(m.forces) == count
            for m in hand.outputs.forces))
        assert positions(found.forces.forces) == positions(EIGHT[:count])
        alpha = found.quality.alpha
        assert alpha == pytest.approx(alphas.setdefault(count, alpha), rel=1e-6, abs=1e-6)
        if count == 1 and len(alphas) == 8:
            hand.outputs.failure(ResultCode.NO_CONTACTS, poses(()))
    assert alphas[1] == 0.0 and alphas[8] > 0.0
    # with the caps of each contact by itself, one more never makes a grasp weaker
    assert all(alphas[k] <= alphas[k + 1] * (1 + 1e-6) + 1e-6 for k in range(1, 8))
    hand.record.check(MAX_AGE_S)

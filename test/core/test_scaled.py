# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Compiled scaling of many grasps is that of each Grasp."""

import dataclasses

from benchmarks.random_grasps import degenerate_grasp
from grasp_quality import GraspSet
from grasp_quality.scaled import Scaled
import numpy as np
import pytest


def test_scaling_is_that_of_grasp():
    for seed in range(200):
        rng = np.random.default_rng(seed)
        grasp = degenerate_grasp(rng)
        if grasp.bound == 'l2':
            continue
        one, many = Scaled.of(grasp), Scaled.of_rows(GraspSet.of([grasp]), np.zeros(1, np.int64))
        for field in dataclasses.fields(Scaled):
            expected = getattr(one, field.name)
            # coincident contacts are known to the rounding of their distance from the origin
            assert getattr(many, field.name) == pytest.approx(
                expected, rel=1e-6, abs=1e-6 * np.abs(expected).max()), field.name
        wrenches = rng.normal(size=(3, 6))
        which = np.zeros(3, np.int64)
        assert one.wrenches(wrenches, which) == pytest.approx(
            grasp.scaled_wrench(wrenches), rel=1e-9, abs=1e-12)

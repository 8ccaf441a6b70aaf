# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The answer that speaks for a task: its forces apply its alpha times the wrench beside it."""

from grasp_quality import evaluate, TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench
from grasp_quality.governing import governing
from known_grasps import antipodal, FX, FY, FZ
import numpy as np
import pytest
from tolerances import SOLVER

MU = 0.3  # pulling along x takes 1, across it 2 mu


@pytest.mark.parametrize('task, alpha', [
    (TaskWrench(FY), 2.0 * MU), (TaskCone(FX, FY, FZ, 0.2), 1.0),
    (TaskPolytope([FX, FY, 0.5 * FX]), 2.0 * MU),
    (TaskEllipsoid([FX, FY]), 2.0 * MU), (TaskEllipsoid([2.0 * FX, FY]), 0.5)],
    ids=['wrench', 'cone', 'polytope', 'ellipsoid', 'long axis'])
def test_the_weakest_governs(task, alpha):
    solution, wrench = governing(task, evaluate(antipodal(MU), task))
    assert solution.alpha == pytest.approx(alpha, rel=SOLVER)
    assert np.allclose(solution.alpha * wrench, solution.wrench, atol=SOLVER)


def test_what_cannot_be_done_at_all_governs():
    task = TaskPolytope([FX, FY])
    solution, wrench = governing(task, evaluate(antipodal(MU), task, -3.0 * FX))
    assert not solution.feasible and np.array_equal(wrench, FX)

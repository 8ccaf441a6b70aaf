# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Every stage behind the first solve looks at the clock too, and says which problem it was."""

from grasp_quality import SolverTimeoutError, TaskCone, TaskWrench
from grasp_quality.barrier import with_margin
from grasp_quality.margin_forces import hold_forces
from grasp_quality.problem import build_problem
from grasp_quality.reserve import with_reserve
from grasp_quality.solve import solve
from known_grasps import antipodal, FX, FY, FZ
import numpy as np
import pytest

OVER_S = 1e-9
TASKS = [TaskWrench(FY), TaskCone(FY, FX, FZ, 0.2)]


@pytest.mark.parametrize('task', TASKS)
def test_the_margin_stages_are_timed(task):
    problem = build_problem(antipodal(), task)
    solution = solve(problem)
    for stage in (with_reserve, with_margin):
        with pytest.raises(SolverTimeoutError, match='time limit of 1e-09 s') as caught:
            stage(problem, solution, 0.1, time_limit_s=OVER_S)
        assert caught.value.problem is not None


def test_holding_forces_are_timed_where_there_is_a_centre():
    with pytest.raises(SolverTimeoutError, match='time limit of 1e-09 s') as caught:
        hold_forces(antipodal(), 0.1 * np.array(FY), time_limit_s=OVER_S)
    assert caught.value.problem is not None

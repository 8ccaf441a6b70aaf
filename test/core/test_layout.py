# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The layout of the conic program: which variable and equation stands where."""

from benchmarks.random_grasps import BOUNDS, random_grasp
from grasp_quality import build_problem, TaskCone, TaskWrench
from grasp_quality.layout import layout_of
from known_grasps import antipodal, FX, FY, FZ, three_finger
import numpy as np
import pytest


@pytest.mark.parametrize('bound', BOUNDS)
@pytest.mark.parametrize('task', [TaskWrench(FX), TaskCone(FX, FY, FZ, 0.4)])
def test_cones_cover_every_variable_once(bound, task):
    for seed in range(10):
        problem = build_problem(random_grasp(np.random.default_rng(seed), bound=bound), task)
        layout = problem.layout
        assert sum(size for _, size in layout.cones) == layout.shape[1]
        blocks = layout.blocks
        assert sorted(blocks[blocks >= 0]) == list(range(layout.shape[1]))
        assert problem.E.shape == layout.shape == (len(problem.e), len(problem.c))


def test_a_pattern_is_laid_out_once():
    first = build_problem(antipodal(0.5), TaskWrench(FX)).layout
    assert build_problem(antipodal(0.2), TaskWrench(FY)).layout is first
    assert build_problem(antipodal(0.5, 0.1), TaskWrench(FX)).layout is not first


def test_shares_come_back_from_their_places():
    problem = build_problem(antipodal(0.5, 0.2), TaskWrench(FX))
    layout = problem.layout
    u = np.zeros(layout.shape[1])
    u[layout.contact_variables] = 1.0 + layout.contact_source
    assert layout.shares(u).ravel().tolist() == list(range(1, 9))


def test_multipliers_of_the_bound_by_contact():
    layout = build_problem(three_finger(bound='finger'), TaskWrench(FX)).layout
    assert layout.contact_multipliers(np.arange(9.0)).tolist() == [6.0, 7.0, 8.0]
    layout = build_problem(three_finger(bound='l1'), TaskWrench(FX)).layout
    assert layout.contact_multipliers(np.arange(7.0)).tolist() == [6.0, 6.0, 6.0]
    layout = build_problem(three_finger(bound='l2'), TaskWrench(FX)).layout
    assert layout.contact_multipliers(np.arange(10.0)).tolist() == [7.0, 8.0, 9.0]


def test_frictionless_contacts_are_half_lines():
    active = np.array([[False, False, True, False]] * 2)
    layout = layout_of(active.tobytes(), (0, 1), False, 1, False, 'task')
    assert layout.cones == (('nonnegative', 5),)

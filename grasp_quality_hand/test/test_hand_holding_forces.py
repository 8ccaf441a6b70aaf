# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of the forces for every load, and of the feedback that keeps an object in place."""

from benchmarks.truth.cases import random_case
from grasp_quality import slip_margin
from grasp_quality_hand.holding_forces import holding_forces
from grasp_quality_hand.pose_feedback import PoseFeedback, within_limits
import numpy as np
import pytest

SOLVER = 1e-6                # of the forces


@pytest.mark.parametrize('index', range(8))
def test_forces_balance_every_share_of_the_load_inside_the_cones(index):
    case = random_case(index, seed=1)
    weight = np.array([0.0, 0.0, -0.05, 0.0, 0.0, 0.0])
    forces = holding_forces(case.grasp, case.task, weight)
    margins = []
    for share in (0.0, 0.3, 0.7, 1.0):
        now = forces.at(share)
        assert np.allclose(case.grasp.wrench(now) + weight, share * forces.alpha * case.task,
                           atol=SOLVER * case.grasp.cap_total)
        assert np.all(now[:, 2] <= case.grasp.max_normal_forces * (1.0 + SOLVER))
        margins.append(slip_margin(case.grasp, now).min())
    assert min(margins) > -SOLVER and margins[0] > 0.01
    assert np.array_equal(forces.at(1.5), forces.at(1.0))
    assert np.array_equal(forces.at(-0.5), forces.at(0.0))


@pytest.mark.parametrize('index', range(8))
def test_feedback_pushes_back_as_far_as_cones_and_caps_allow(index):
    case, rng = random_case(index, seed=2), np.random.default_rng(index)
    idle = 0.9 * holding_forces(case.grasp, case.task).idle    # some room below the caps
    feedback = PoseFeedback(case.grasp, mass=1e-3, inertia=1e-7, frequency=10.0)
    moved, velocity = 1e-3 * rng.normal(size=(2, 6))
    change = case.grasp.wrench(feedback.corrected(idle, moved, velocity)) - case.grasp.wrench(idle)
    inertia = np.repeat([1e-3, 1e-7], 3)
    assert np.allclose(change, -inertia * (100.0 * moved + 20.0 * velocity), atol=1e-12)
    strong = PoseFeedback(case.grasp, mass=1e3, inertia=1.0, frequency=100.0)
    for forces in (strong.corrected(idle, moved, velocity),
                   within_limits(case.grasp, 1e3 * rng.normal(size=idle.shape))):
        assert np.all(forces[:, 2] <= case.grasp.max_normal_forces)
        assert np.all(slip_margin(case.grasp, forces) >= -1e-9)

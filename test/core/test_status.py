# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Answers as they are printed: plain numbers, in one line."""

import dataclasses
import enum

from grasp_quality import (
    ball_radius, evaluate, force_closure, hold_forces, minimum_forces, robust_alpha, TaskCone,
    TaskEllipsoid, TaskPolytope, TaskWrench, volume, wrench_map)
from known_grasps import FX, FY, FZ, three_finger, TX
import numpy as np

GRASP = three_finger(0.5)


def answers():
    """One of each kind."""
    yield evaluate(GRASP, TaskWrench(FY))
    yield evaluate(GRASP, TaskCone(FX, FY, FZ, 0.3))
    yield evaluate(GRASP, TaskPolytope([FX, FY]))
    yield evaluate(GRASP, TaskEllipsoid([FX, FY]))
    yield evaluate(GRASP, TaskWrench(FY), external_wrench=-99.0 * FZ)
    yield evaluate(GRASP, TaskWrench(FY), barrier_weight=0.1)
    yield evaluate(GRASP, TaskWrench(FY), alpha_reserve=0.1)
    yield minimum_forces(GRASP, FY)
    yield minimum_forces(GRASP, 99.0 * FY)
    yield hold_forces(GRASP, FY)
    yield ball_radius(GRASP, relative_width=0.1)
    yield ball_radius(GRASP, subspace='force', relative_width=0.1)
    yield volume(GRASP, relative_width=0.3)
    yield force_closure(GRASP)
    yield robust_alpha(GRASP, TaskWrench(FY), contact_noise=1e-3, samples=80)
    yield wrench_map(GRASP, [FX, TX])


def test_single_numbers_are_plain_and_print_in_one_line():
    for answer in answers():
        for field in dataclasses.fields(answer):
            value = getattr(answer, field.name)
            assert not isinstance(value, np.generic), (answer, field.name)
            if isinstance(value, (bool, int, float, enum.Enum)):
                assert f'{field.name}=' in str(answer)
        assert '\n' not in str(answer) and 'np.' not in str(answer) and len(str(answer)) < 250

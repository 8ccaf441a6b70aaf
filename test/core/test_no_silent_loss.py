# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Complex and masked arrays: wherever numbers enter, nothing of them is dropped unsaid."""

import warnings

import grasp_quality as gq
from grasp_quality.follow import follow
from grasp_quality.reference import state_task_wrench
from known_grasps import antipodal, FX, FY, FZ
import numpy as np
import pytest

TASK = gq.TaskWrench(FY)
SIX = np.array([1.0, 0.2, 0.1, 0.0, 0.0, 0.0])
NORMAL = (0.0, 0.0, 1.0)
PAIR = np.array([[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]])


def complex_of(values):
    """Return the numbers with an imaginary part in the first of them."""
    spoilt = np.array(values, complex)
    spoilt.flat[0] += 0.5j
    return spoilt


def masked_of(values):
    """Return the numbers with the first of them masked."""
    spoilt = np.ma.array(values, float)
    spoilt.mask = np.arange(spoilt.size).reshape(spoilt.shape) == 0
    return spoilt


DOORS = {
    'position': (lambda v: gq.Contact(v, NORMAL), SIX[:3]),
    'normal': (lambda v: gq.Contact((0, 0, 0), v), np.array(NORMAL)),
    'rotation': (lambda v: gq.Contact((0, 0, 0), rotation=v), np.eye(3)),
    'friction': (lambda v: gq.Contact((0, 0, 0), NORMAL, friction=v), 0.5),
    'cap': (lambda v: gq.Contact((0, 0, 0), NORMAL, max_normal_force=v), 1.0),
    'torques': (lambda v: gq.JointLimits(['a', 'b'], v, np.ones((2, 2, 4))), np.ones(2)),
    'torque matrix': (lambda v: gq.JointLimits(['a'], [1.0], v), np.ones((1, 2, 4))),
    'jacobians': (lambda v: gq.JointLimits.of_jacobians(['a'], [1.0], v, [np.eye(3)] * 2),
                  np.ones((1, 2, 6))),
    'positions': (lambda v: gq.GraspSet.of_arrays(v, -PAIR), PAIR),
    'frictions': (lambda v: gq.GraspSet.of_arrays(PAIR, -PAIR, friction=v), np.full(2, 0.5)),
    'task': (gq.TaskWrench, SIX),
    'cone': (lambda v: gq.TaskCone(v, FX, FZ, 0.2), FY),
    'half angle': (lambda v: gq.TaskCone(FY, FX, FZ, v), 0.2),
    'polytope': (gq.TaskPolytope, np.array([FX, FY])),
    'weights': (lambda v: gq.TaskPolytope([FX, FY], v), np.full(2, 0.5)),
    'ellipsoid': (gq.TaskEllipsoid, np.array([FX, FY])),
    'load': (lambda v: gq.evaluate(antipodal(), TASK, v), 0.1 * SIX),
    'barrier weight': (lambda v: gq.evaluate(antipodal(), TASK, None, v), 0.1),
    'least forces': (lambda v: gq.minimum_forces(antipodal(), v), 0.1 * SIX),
    'load to hold': (lambda v: gq.hold_forces(antipodal(), v), 0.1 * SIX),
    'task to hold': (lambda v: gq.hold_forces(antipodal(), None, v), 0.1 * SIX),
    'problem': (lambda v: gq.build_problem(antipodal(), TASK, v), 0.1 * SIX),
    'directions': (lambda v: gq.wrench_map(antipodal(), v), np.array([FX, FY])),
    'slip': (lambda v: gq.slip_margin(antipodal(), v), np.ones((2, 4))),
    'measured': (lambda v: gq.measured_margin(antipodal(), v), np.ones((2, 4))),
    'many tasks': (lambda v: gq.evaluate_many([antipodal()], v), SIX),
    'many loads': (lambda v: gq.evaluate_many([antipodal()], FY, v), 0.1 * SIX),
    'noise': (lambda v: gq.robust_alpha(antipodal(), TASK, load_noise=v, samples=300), 0.1 * SIX),
    'quantile': (lambda v: gq.robust_alpha(antipodal(), TASK, quantile=v, samples=300),
                 np.array([0.1, 0.2])),
    'torque length': (lambda v: gq.ball_radius(antipodal(), v), 1.0),
    'followed forces': (lambda v: follow(
        gq.build_problem(antipodal(), TASK), gq.evaluate(antipodal(), TASK), v, 1.0),
        np.ones((2, 4))),
    'reference': (lambda v: state_task_wrench(antipodal(), v), SIX)}


@pytest.mark.parametrize('spoil, words', [
    (complex_of, 'must be real, got .*0.5j.*: give the real part'),
    (masked_of, 'must have no masked entries, got 1 of .*: give numbers')])
@pytest.mark.parametrize('door', DOORS)
def test_what_would_be_dropped_is_refused(door, spoil, words):
    ask, values = DOORS[door]
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        ask(values)
        with pytest.raises(gq.GraspQualityError, match=words):
            ask(spoil(values))

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Grasps, wrenches and joint limits that hypothesis draws, and shrinks where a law is broken."""

import dataclasses

from grasp_quality import (
    Contact, ContactModel, evaluate, Grasp, JointLimits, SolverError, TaskWrench)
from hypothesis import reject, strategies as st
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tolerances import SOLVER

BOUNDS = ('linf', 'l1', 'l2', 'finger')
part = st.floats(-1.0, 1.0).map(lambda value: round(value, 6))
share = st.floats(0.2, 1.0)
triples = st.tuples(part, part, part)
wrenches = st.tuples(part, part, part, part, part, part).map(np.array).filter(
    lambda w: np.abs(w).max() > 0.1)
rotations = triples.map(lambda v: Rotation.from_rotvec(3.0 * np.array(v)).as_matrix())
points = triples.filter(lambda v: np.linalg.norm(v) > 0.1)


@st.composite
def contacts(draw):
    """Draw a contact near a ball of radius one that presses inward within a tilt."""
    point = np.array(draw(points))
    point /= np.linalg.norm(point)
    finger = draw(st.sampled_from(('thumb', 'index', 'ring')))
    return Contact(
        position=point, normal=-point + 0.4 * np.array(draw(triples)),
        model=draw(st.sampled_from(ContactModel)), friction=draw(st.floats(0.05, 1.5)),
        torsional_friction=draw(st.floats(0.0, 0.3)), max_normal_force=draw(share),
        finger=finger)


@st.composite
def joint_limits(draw, count):
    """Draw limits of up to three joints that gravity alone does not exceed."""
    joints = draw(st.integers(1, 3))
    matrix = np.array([[[*draw(triples), draw(part)] for _ in range(count)]
                       for _ in range(joints)])
    limits = np.array([draw(st.floats(0.1, 2.0)) for _ in range(joints)])
    gravity = limits * [draw(st.floats(-0.5, 0.5)) for _ in range(joints)]
    return JointLimits([f'joint_{j}' for j in range(joints)], limits, matrix, gravity)


@st.composite
def grasps(draw, bounds=BOUNDS, limited=None, most=5):
    """Draw a grasp; ``limited``: with joint limits, without, or either."""
    some = draw(st.lists(contacts(), min_size=1, max_size=most))
    limited = draw(st.booleans()) if limited is None else limited
    return Grasp(some, draw(st.sampled_from(bounds)),
                 draw(joint_limits(len(some))) if limited else None)


def load_within(draw, grasp):
    """Draw a load that some forces well inside cones and caps balance; not all joints can."""
    shares = np.zeros((len(grasp), 4))
    shares[:, 2] = [0.5 * draw(share) / len(grasp) for _ in range(len(grasp))]
    shares[:, 0] = 0.5 * shares[:, 2] * [draw(part) for _ in range(len(grasp))]
    return -grasp.wrench(shares * grasp.force_units)


loads = st.composite(load_within)


def solved(grasp, wrench, **arguments):
    """Answer a task wrench; what cannot be proved is no example of a law."""
    try:
        return evaluate(grasp, TaskWrench(wrench), **arguments)
    except SolverError:
        reject()


def alpha(grasp, wrench, load=None):
    """Alpha of a task wrench; infeasible is 0."""
    return solved(grasp, wrench, external_wrench=load).alpha


def changed(grasp, limits='same', **fields):
    """Return the grasp with fields of all its contacts changed; values are functions of one."""
    return Grasp([
        dataclasses.replace(c, normal=None, **{name: f(c) for name, f in fields.items()})
        for c in grasp.contacts], grasp.bound, grasp.joint_limits if limits == 'same' else limits)


def close(value, size=1.0):
    """Equal within what both proofs promise, relative to the larger of value and the natural."""
    return pytest.approx(value, rel=4.0 * SOLVER, abs=0.02 * size * SOLVER)


def natural(grasp, wrench):
    """Return the alpha that the caps alone would allow."""
    return float(grasp.max_normal_forces.sum() / grasp.force_scale / np.linalg.norm(
        grasp.scaled_wrench(wrench)))

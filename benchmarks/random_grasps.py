# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Random problems, from ordinary to degenerate, for the benchmarks and the tests.

Ordinary grasps hold a unit ball; degenerate ones have contacts on top of each other or in a line,
caps and friction over six decades, frictionless contacts, at any size from 1 mm and 1 mN on.
"""

from grasp_quality import Contact, ContactModel, Grasp, JointLimits
import numpy as np

BOUNDS = ('l1', 'l2', 'linf', 'finger')
MODELS = tuple(ContactModel)


def random_grasp(rng, count=None, bound=None, models=MODELS):
    """Return a grasp of 1 to 12 contacts on the unit sphere, pressing inward within a tilt."""
    contacts = []
    for i in range(count or int(rng.integers(1, 13))):
        position = rng.normal(size=3)
        position /= np.linalg.norm(position)
        contacts.append(Contact(
            position=position, normal=-position + 0.4 * rng.normal(size=3),
            model=models[rng.integers(len(models))], friction=rng.uniform(0.1, 1.2),
            torsional_friction=rng.uniform(0.0, 0.3), max_normal_force=rng.uniform(0.2, 1.0),
            finger=f'finger_{i % 3}'))
    return Grasp(contacts, bound or str(rng.choice(BOUNDS)))


def random_load(rng, grasp):
    """Return a load (6,) that some forces well inside cones and caps balance."""
    normals = rng.uniform(0.4, 0.8, len(grasp)) / len(grasp)
    sides = rng.normal(size=(len(grasp), 3))
    sides *= (0.5 * normals / np.linalg.norm(sides, axis=1))[:, None]
    shares = np.stack([sides[:, 0], sides[:, 1], normals, sides[:, 2]], axis=1)
    return -grasp.wrench(shares * grasp.force_units)


def random_joint_limits(rng, grasp, tightness=None, gravity=0.3):
    """
    Return limits of 1 to 9 joints, each loaded by some of the contacts.

    ``tightness`` is a limit's share of what the normals at their caps load the joint with, by
    default between 0.001 and 10; ``gravity`` is the largest share of a limit that the hand's own
    weight takes.

    """
    count = int(rng.integers(1, 10))
    matrix = 0.1 * rng.normal(size=(count, len(grasp), 4))
    matrix *= rng.uniform(size=(count, len(grasp), 1)) < 0.5
    loads = np.abs(matrix[:, :, 2] * grasp.max_normal_forces).sum(axis=1) + 1e-3
    tightness = 10.0 ** rng.uniform(-3, 1) if tightness is None else tightness
    limits = tightness * loads * rng.uniform(0.3, 1.0, count)
    return JointLimits([f'joint_{i}' for i in range(count)], limits, matrix,
                       gravity * limits * rng.uniform(-1.0, 1.0, count))


def degenerate_grasp(rng):
    """Return a grasp that breaks one habit of ordinary ones, at a random size."""
    length, force = 10.0 ** rng.uniform(-3, 1), 10.0 ** rng.uniform(-3, 4)
    offset = rng.normal(size=3) * rng.choice([0.0, 1.0, 10.0])
    base = rng.normal(size=3)
    habit = rng.choice([
        'coincident', 'collinear', 'friction', 'caps', 'parallel', 'twins', 'frictionless',
        'opposed'])
    contacts = []
    for i in range(int(rng.integers(1, 13))):
        position = rng.normal(size=3)
        position /= np.linalg.norm(position)
        normal = -position + 0.3 * rng.normal(size=3)
        friction, torsional = rng.uniform(0.1, 1.2), rng.uniform(0.0, 0.3)
        cap = rng.uniform(0.2, 1.0)
        if habit == 'coincident':
            position = base + 1e-9 * rng.normal(size=3)
        elif habit == 'collinear':
            position = base * rng.normal()
        elif habit == 'friction':
            friction = 10.0 ** rng.uniform(-6, 0)
        elif habit == 'caps':
            cap = 10.0 ** rng.uniform(-6, 0)
        elif habit == 'parallel':
            normal = base + 1e-6 * rng.normal(size=3)
        elif habit == 'twins':
            position = base if i % 2 else position
        elif habit == 'frictionless':
            friction, torsional = friction * (i % 2), 0.0
        else:
            position = np.array([2.0 * (i % 2) - 1.0, 0.0, 0.0])
            normal = -position
        contacts.append(Contact(
            position=(position + offset) * length, normal=normal,
            model=MODELS[rng.integers(len(MODELS))], friction=friction,
            torsional_friction=torsional * length, max_normal_force=cap * force,
            finger=f'finger_{i % 3}'))
    return Grasp(contacts, str(rng.choice(BOUNDS)))


def degenerate_wrench(rng, grasp):
    """Return a task wrench (6,) of any size: arbitrary, along an axis, or just in reach."""
    length = grasp.lever_arm
    wrench = rng.normal(size=6) * [1.0, 1.0, 1.0, length, length, length]
    kind = rng.integers(6)
    if kind == 0:
        wrench[3:] = 0.0
    elif kind == 1:
        wrench[:3] = 0.0
    elif kind == 2:
        wrench = np.eye(6)[rng.integers(6)]
    elif kind == 3:
        wrench = grasp.wrench(np.abs(rng.normal(size=(len(grasp), 4))) * [0, 0, 1, 0])
    elif kind == 4:
        forces = rng.normal(size=(len(grasp), 4)) * grasp.scales * 0.3
        forces[:, 2] = np.abs(forces[:, 2]) + 1.0
        wrench = grasp.wrench(forces)
    return wrench * 10.0 ** rng.uniform(-3, 3)


def degenerate_load(rng, grasp):
    """Return a load (6,), or None: too heavy, just in reach, or at the very edge of the caps."""
    kind = rng.integers(6)
    if kind < 2:
        return None
    caps = grasp.max_normal_forces
    if kind == 2:
        return (rng.normal(size=6) * caps.max() * rng.choice([0.1, 1.0])
                * np.repeat([1.0, grasp.lever_arm], 3))
    forces = rng.normal(size=(len(grasp), 4)) * grasp.force_units * 0.3
    forces[:, 2] = np.abs(forces[:, 2])
    forces /= max(1.0, (forces[:, 2] / caps).max())
    if kind == 3:
        return -grasp.wrench(forces) * rng.uniform()
    if kind == 4:
        return -grasp.wrench(forces)
    pressing = np.zeros((len(grasp), 4))
    pressing[:, 2] = caps
    return -grasp.wrench(pressing) * (1.0 + 10.0 ** rng.uniform(-12, -3) * rng.choice([-1, 0, 1]))

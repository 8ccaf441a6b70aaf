# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The random grasps and tasks that prediction and physics are compared on.

Every case has a seed of its own, so that it can be repeated alone. A case is drawn again until
its contacts stand apart, the grasp has force closure, and alpha can be measured: a grasp whose
alpha changes by more than 2 % when its contacts move by the distance that counts as slip has a
different alpha by the time it is seen to slip. All this is decided from the prediction alone.
"""

from dataclasses import dataclass, replace

from grasp_quality import Contact, ContactModel, evaluate, force_closure, Grasp, TaskWrench
from grasp_quality_hand.grasp_objects import GraspObject
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SEED = 20261126              # fixed before the first run with it; made with others
COUNT = 128
HALF_SIZE = 0.03             # half edge of the cube, radius of the ball [m]
MASS = 0.01                  # of the object: the lighter, the sooner it shows that it slips [kg]
APART = 0.008                # contacts are no nearer than that [m]
FROM_EDGE = 0.8              # contacts on a cube stay within this share of the half edge
CLOSURE_MARGIN = 0.02        # smallest internal force, as a share of the caps
SHIFT = 1e-4                 # of contacts, as much as counts as slip [m]
SHIFTS = 12                  # random ones that are tried
SENSITIVE = 0.02             # change of alpha with them that is too much
MODELS = (ContactModel.PCWF, ContactModel.SFCE)


@dataclass(frozen=True)
class Case:
    """An object, a grasp of it and a task wrench (6,) of unit force, or unit force times 30 mm."""

    seed: int
    grasp_object: GraspObject
    grasp: Grasp
    task: Array
    too_sensitive: int       # draws before it that were given up for this reason

    @property
    def text(self) -> str:
        """Return what it is in a few words."""
        kind = 'force' if self.task[:3].any() else 'torque'
        contact = self.grasp.contacts[0]
        return (f'{self.grasp_object.name}, {len(self.grasp)} {contact.model.name}, '
                f'mu {contact.friction:.2f}, {kind}')


def random_case(index: int, seed: int = SEED) -> Case:
    """Return a case: shape, model and kind of task by turns, all else at random."""
    rng = np.random.default_rng([seed, index])
    shape = ('box', 'sphere')[index % 2]
    model = MODELS[index // 2 % 2]
    friction, torsional = rng.uniform(0.3, 1.0), rng.uniform(0.002, 0.010)
    count = int(rng.integers(3, 9))
    task, too_sensitive = _task(rng, index // 4 % 2 == 0), 0
    while True:
        places = [_place(rng, shape) for _ in range(count)]
        caps = rng.uniform(2.0, 10.0, count)
        positions = np.array([position for position, _ in places])
        gaps = np.linalg.norm(positions[:, None] - positions, axis=2) + np.eye(count)
        if gaps.min() < APART:
            continue
        grasp = Grasp([
            Contact(position=position, normal=normal, model=model, friction=friction,
                    torsional_friction=torsional if model is ContactModel.SFCE else 0.0,
                    max_normal_force=cap, name=f'point_{i}')
            for i, ((position, normal), cap) in enumerate(zip(places, caps))])
        closure = force_closure(grasp)
        if not closure.closed or closure.margin <= CLOSURE_MARGIN:
            continue
        if _sensitivity(rng, grasp, task) <= SENSITIVE:
            return Case(index, _object(shape, grasp), grasp, task, too_sensitive)
        too_sensitive += 1


def _sensitivity(rng: np.random.Generator, grasp: Grasp, task: Array) -> float:
    """Return the largest change of alpha when all contacts shift sideways, as a share of it."""
    shifted = []
    for _ in range(SHIFTS):
        sideways = rng.normal(size=(len(grasp), 2))
        sideways *= SHIFT / np.linalg.norm(sideways, axis=1, keepdims=True)
        positions = grasp.positions + np.einsum('kij,kj->ki', grasp.rotations[:, :, :2], sideways)
        shifted.append(evaluate(Grasp([
            replace(contact, normal=None, position=position)
            for contact, position in zip(grasp.contacts, positions)]), TaskWrench(task)).alpha)
    alpha = evaluate(grasp, TaskWrench(task)).alpha
    return float(np.abs(np.array(shifted) / alpha - 1.0).max())


def _place(rng: np.random.Generator, shape: str) -> 'tuple[Array, Array]':
    """Return a point on the surface and the inward normal there."""
    if shape == 'sphere':
        outward = rng.normal(size=3)
        outward /= np.linalg.norm(outward)
        return HALF_SIZE * outward, -outward
    axis, side = rng.integers(3), rng.choice([-1.0, 1.0])
    position = rng.uniform(-FROM_EDGE, FROM_EDGE, 3) * HALF_SIZE
    position[axis] = side * HALF_SIZE
    return position, -side * np.eye(3)[axis]


def _task(rng: np.random.Generator, force: bool) -> Array:
    """Return a unit force, or a torque as large as a unit force on the surface."""
    direction = rng.normal(size=3)
    direction /= np.linalg.norm(direction)
    return np.concatenate([direction, np.zeros(3)] if force
                          else [np.zeros(3), HALF_SIZE * direction])


def _object(shape: str, grasp: Grasp) -> GraspObject:
    """Return the object: frictionless itself, as friction stands on the contacts."""
    normals = grasp.rotations[:, :, 2]
    size = (HALF_SIZE,) * 3 if shape == 'box' else (HALF_SIZE,)
    return GraspObject({'box': 'cube', 'sphere': 'ball'}[shape], shape, size, MASS, 0.0,
                       grasp.positions, normals, normals, 0.0, 0.0)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Pulls on the contact-point hand, until the object slips.

Optimised: every contact is commanded the forces of ``holding_forces`` for the load that there is.
Passive: every contact presses with a constant normal force, and friction does the rest, so that
nothing in the commands knows where the end is.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmarks.truth.bound_law import bound_ratio
from benchmarks.truth.cases import Case
from benchmarks.truth.felt import felt_grasp
from benchmarks.truth.references import held_interval
from benchmarks.truth.slow_pull import Pulled, Rig, slow_pull, START
from grasp_quality import evaluate, TaskWrench
from grasp_quality_hand.contact_reading import contact_points
from grasp_quality_hand.holding_forces import holding_forces
from grasp_quality_hand.point_hand_model import build_point_hand
from grasp_quality_hand.pose_feedback import PoseFeedback
from grasp_quality_hand.slip import Pose
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SLIP = 1e-4                  # |dp| + 20 mm |dtheta| [m]
LOWEST = 0.60                # of the shares that the normals of the optimum must be able to hold
LEAST = 0.1                  # share of alpha that balanced normals must be able to hold
GROWTH = 0.06                # of alpha a second and per root of a newton: the object's inertia
SLOWEST, FASTEST = 0.02, 0.2    # hides the beginning of slip for less than 0.3 % of alpha
FREQUENCY = 300.0            # of the pose feedback [rad/s]
STEPS = 4                    # of the simulation for one of the commands


@dataclass(frozen=True)
class PassivePull:
    """
    A pull with constant normal forces.

    Attributes
    ----------
    pulled : Pulled
    normals : ndarray, shape (k,)
        [N]
    at_optimum : bool
        Whether they are those of the optimum.

    """

    pulled: Pulled
    normals: Array
    at_optimum: bool


class PointRig(Rig):
    """The contact-point hand of one case; guided when its contacts press along normals alone."""

    ramp = 0.1

    def __init__(self, case: Case, guided: bool) -> None:
        super().__init__(case.grasp)
        self._guided = guided
        self._hand = build_point_hand(case.grasp_object, case.grasp, guided)
        self._data: Any = mujoco.MjData(self._hand.mujoco)
        self._data.eq_active[self._hand.holder] = 0
        mujoco.mj_forward(self._hand.mujoco, self._data)
        self._inertia = (case.grasp_object.mass,
                         float(self._hand.mujoco.body_inertia[self._hand.object_body].mean()))
        self._feedback = PoseFeedback(case.grasp, *self._inertia, FREQUENCY)
        self._place = self.pose()
        self.period = STEPS * float(self._hand.mujoco.opt.timestep)

    def pose(self) -> Pose:
        """Return the pose of the object."""
        body = self._hand.object_body
        return Pose(self._data.xpos[body].copy(), self._data.xquat[body].copy())

    def feel(self) -> None:
        """Take the contacts to be where they are felt."""
        self.grasp = felt_grasp(self.grasp, contact_points(self._hand, self._data))
        self._feedback = PoseFeedback(self.grasp, *self._inertia, FREQUENCY)

    def bound_ratio(self) -> float:
        """Return the ratio of the bound law now."""
        return bound_ratio(self.grasp, contact_points(self._hand, self._data))

    def _simulate(self, forces: Array, load: Array) -> None:
        """Simulate one period."""
        data, body = self._data, self._hand.object_body
        R = data.xmat[body].reshape(3, 3)
        commands = forces[:, 2] if self._guided else self._commands(forces, R)
        data.ctrl[:] = commands
        data.xfrc_applied[body, :3], data.xfrc_applied[body, 3:] = R @ load[:3], R @ load[3:]
        mujoco.mj_step(self._hand.mujoco, data, nstep=STEPS)

    def _commands(self, forces: Array, R: Array) -> Array:
        """Return the efforts of free spheres, with the feedback on the object's pose."""
        moved = self._place.displacement_to(self.pose())
        velocity = self._data.qvel[:6]    # of the free joint: world axes, then body axes
        forces = self._feedback.corrected(
            forces, np.concatenate([R.T @ moved[:3], R.T @ moved[3:]]),
            np.concatenate([R.T @ velocity[:3], velocity[3:]]))
        world = np.einsum('kij,kj->ki', R @ self.grasp.rotations, forces[:, :3])
        turning = self.grasp.scales[:, 3] > 0.0
        return np.concatenate([np.append(force, moment) if turns else force
                               for force, moment, turns in zip(world, forces[:, 3], turning)])


def optimised_pull(case: Case) -> Pulled:
    """Pull on contacts that are commanded the optimiser's forces for every load."""
    rig = PointRig(case, guided=False)
    for _ in range(2):
        forces = holding_forces(rig.grasp, case.task)
        rig.go(forces.at(START), -START * forces.alpha * case.task)
        rig.feel()
    forces = holding_forces(rig.grasp, case.task)
    return _pull(rig, forces.at, forces.alpha, case.task)


def passive_pull(case: Case) -> PassivePull | None:
    """
    Pull on contacts that press with constant normal forces, while friction does the rest.

    The normal forces are those of the optimum, and the prediction is the package's own alpha,
    where friction holds the smaller loads at these normal forces, too. Elsewhere they are those
    of ``holding_forces`` without load, which balance each other, and the prediction is that of
    ``held_interval``. None where friction can vary the task at neither.
    """
    best = evaluate(case.grasp, TaskWrench(case.task))
    lowest, _ = held_interval(case.grasp, best.forces[:, 2], best.alpha * case.task)
    return _at_the_optimum(case) if lowest < LOWEST else _balanced(case, best.alpha)


def _at_the_optimum(case: Case) -> PassivePull:
    """Pull with the normal forces of the optimum."""
    rig = PointRig(case, guided=True)
    for _ in range(2):
        best = evaluate(rig.grasp, TaskWrench(case.task))
        rig.go(best.forces, -START * best.alpha * case.task)
        rig.feel()
    best = evaluate(rig.grasp, TaskWrench(case.task))
    pulled = _pull(rig, lambda share: best.forces, best.alpha, case.task)
    return PassivePull(pulled, best.forces[:, 2], True)


def _balanced(case: Case, alpha: float) -> PassivePull | None:
    """Pull with normal forces that balance each other; alpha is that of the optimum."""
    forces = holding_forces(case.grasp, case.task).idle
    if not held_interval(case.grasp, forces[:, 2], case.task)[1] > LEAST * alpha:
        return None
    rig = PointRig(case, guided=True)
    rig.go(forces, np.zeros(6))
    rig.feel()
    _, largest = held_interval(rig.grasp, forces[:, 2], case.task)
    return PassivePull(_pull(rig, lambda share: forces, largest, case.task), forces[:, 2], False)


def _pull(rig: Rig, forces_at: Callable[[float], Array], alpha: float, task: Array) -> Pulled:
    """Pull so slowly that the inertia of the object does not count."""
    growth = float(np.clip(GROWTH * np.sqrt(alpha), SLOWEST, FASTEST))
    return slow_pull(rig, forces_at, alpha, task, growth, SLIP)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Contact forces and the motor efforts that exert them: tau = J^T f, saturation, joint limits."""

from collections.abc import Sequence
from dataclasses import dataclass

from grasp_quality import Grasp, JointLimits
from grasp_quality_hand.hand_kinematics import HandKinematics
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pushes:
    """
    What the fingers do to the object; all in one frame.

    Attributes
    ----------
    names : tuple of str
        Of the contacts.
    positions : (k, 3) array [m]
        Contact points.
    forces, moments : (k, 3) arrays [N], [N m]
        Of the finger on the object, moments about the contact point.

    """

    names: tuple[str, ...]
    positions: Array
    forces: Array
    moments: Array

    def moved(self, R: Array, p: Array) -> 'Pushes':
        """Express them in another frame, x_new = R x + p."""
        return Pushes(self.names, self.positions @ R.T + p, self.forces @ R.T,
                      self.moments @ R.T)

    def wrench(self) -> Array:
        """Return the net wrench on the object about the frame's origin, shape (6,) [N, N m]."""
        torque = self.moments + np.cross(self.positions, self.forces)
        return np.concatenate([self.forces.sum(axis=0), torque.sum(axis=0)])


def contact_efforts(hand: HandKinematics, links: Sequence[str], pushes: Pushes) -> Array:
    """
    Motor efforts J^T f (n,) [N m, N] that exert the pushes, gravity aside.

    Parameters
    ----------
    hand : HandKinematics
        In its present posture.
    links : (k,) sequence of str
        Link that makes each contact.
    pushes : Pushes
        In the base frame of the hand.

    """
    efforts = np.zeros(len(hand.joints))
    for link, position, force, moment in zip(
            links, pushes.positions, pushes.forces, pushes.moments):
        efforts += hand.jacobian(link, position).T @ np.concatenate([force, moment])
    return efforts


def saturated(efforts: Array, offset: Array, limits: Array) -> tuple[Array, float]:
    """
    Bring efforts within limits by scaling all contact forces alike.

    Parameters
    ----------
    efforts : (n,) array
        Of the contact forces.
    offset : (n,) array
        That no scaling changes: gravity.
    limits : (n,) array
        > 0, in both directions.

    Returns
    -------
    (n,) array, float : s efforts + offset within the limits, and s in [0, 1], as large as can be;
    where the offset alone is beyond a limit s is 0 and that joint stays at its limit

    """
    room = limits - np.sign(efforts) * offset
    size = np.abs(efforts)
    ratios = np.divide(room, size, where=size > room, out=np.ones_like(size))
    scale = float(np.clip(ratios.min(initial=1.0), 0.0, 1.0))
    if (np.abs(offset) > limits).any():
        scale = 0.0
    return np.clip(scale * efforts + offset, -limits, limits), scale


def joint_limits(hand: HandKinematics, links: Sequence[str], grasp: Grasp, R: Array, p: Array,
                 gravity: bool = True) -> JointLimits:
    """
    Joint limits of a grasp for the optimisation, from the URDF's effort limits.

    Parameters
    ----------
    hand : HandKinematics
        In its present posture.
    links : (k,) sequence of str
        Link that makes each contact.
    grasp : Grasp
        Contacts in the object frame.
    R, p : (3, 3) and (3,) arrays [m]
        R_base_object, and the object frame's origin in the base frame.
    gravity : bool
        Whether the hand's own weight counts; False where something else carries it.

    """
    jacobians = np.stack([hand.jacobian(link, R @ position + p).T
                          for link, position in zip(links, grasp.positions)], axis=1)
    return JointLimits.of_jacobians(
        hand.joints, hand.effort_limits, jacobians, R @ grasp.rotations,
        hand.gravity_efforts() if gravity else None)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The controller of the demo's pulls: contacts, pose and load in, contact forces out.

At every sample of the contacts it commands the forces for the load that there is, at most those
of alpha, with a feedback on the object's pose; `force_to_effort` makes joint efforts of them.

"""

import time
from typing import Any

from geometry_msgs.msg import Point, PoseArray, Vector3
from grasp_quality import Contact, ContactModel, Grasp
from grasp_quality_hand.grasp_objects import GraspObject
from grasp_quality_hand.hand_messages import set_wrench
from grasp_quality_hand.holding_forces import holding_forces, HoldingForces
from grasp_quality_hand.measured_grasp import MeasuredGrasp, rotation
from grasp_quality_hand.pose_feedback import PoseFeedback
from grasp_quality_hand.slip import Pose, slip_distance
from grasp_quality_msgs.msg import ContactForce, ContactForceArray
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
MOVED = (1.0, 2e-3)          # object and fingers, as the feedback moves them [kg, kg m^2]
FREQUENCY = 25.0             # of the feedback [rad/s]
LEAD = 0.01                  # from a command to where it counts [s]
SMOOTHING = 0.3              # weight of the newest of the measured velocities
STILL_SPEED, STILL_SAMPLES = 2e-4, 40    # slower than that [m/s], for so many samples
BLENDING = 0.03              # change from other forces to these, in each sample


class Follower:
    """Commands the contact forces of one task."""

    def __init__(self, client: Any, publisher: Any) -> None:
        self._client, self._publisher = client, publisher
        self._forces: HoldingForces | None = None
        self._commanded: Array | None = None      # (k, 3) along the object's axes [N]
        self.displacement = np.zeros(6)              # of the object from its place, world axes
        client.on_contacts.append(self._on_contacts)

    def take(self, measured: MeasuredGrasp, grasp_object: GraspObject, cap: float,
             task: Array) -> HoldingForces:
        """Take a task (6,) for the grasp as it was measured; return the forces for its loads."""
        grasp = Grasp([
            Contact(position=position, rotation=R, model=ContactModel.SFCE, name=finger,
                    friction=grasp_object.friction, max_normal_force=cap,
                    torsional_friction=grasp_object.torsional_friction)
            for finger, position, R in zip(measured.fingers, measured.positions,
                                           measured.rotations)])
        weight = np.append(-measured.weight, np.zeros(3))
        if self._commanded is None:
            self._commanded = measured.forces_in_object_frame
        self._grasp, self._task = grasp, task
        self._feedback = PoseFeedback(grasp, *MOVED, FREQUENCY)
        self._place, self._velocity = self._pose(), np.zeros(6)
        self._blend, self._blending, self._still = 0.0, 0.0, 0
        self.displacement, self._stamp = np.zeros(6), 0.0
        self._before = self._commanded
        self._forces = holding_forces(grasp, task, weight)
        return self._forces

    def blend(self) -> None:
        """Begin to go from the forces before to those of the task."""
        self._blending = BLENDING

    @property
    def blended(self) -> bool:
        """Return whether the forces of the task have taken over from those before."""
        return self._blend >= 1.0

    @property
    def still(self) -> bool:
        """Return whether the object has not moved for a while."""
        return self._still >= STILL_SAMPLES

    def stop(self) -> None:
        """Command nothing more."""
        self._client.on_contacts.remove(self._on_contacts)

    def _on_contacts(self, message: PoseArray) -> None:
        """Command forces at the contacts as they are."""
        heard = self._client.heard
        if (self._forces is None or heard.load_rate is None
                or len(message.poses) != len(self._grasp)):
            return
        stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
        R = self._measure(stamp)
        load = heard.load + (time.time() - heard.load_stamp + LEAD) * heard.load_rate
        share = float(-load @ self._task / (self._task @ self._task) / self._forces.alpha)
        local = self._feedback.corrected(
            self._forces.at(share), np.concatenate([R.T @ self.displacement[:3],
                                                    R.T @ self.displacement[3:]]),
            np.concatenate([R.T @ self._velocity[:3], R.T @ self._velocity[3:]]))
        self._blend = min(1.0, self._blend + self._blending)
        wanted = np.einsum('kij,kj->ki', self._grasp.rotations, local[:, :3])
        self._commanded = (1.0 - self._blend) * self._before + self._blend * wanted
        moments = self._blend * local[:, 3, None] * self._grasp.rotations[:, :, 2]
        self._publisher.publish(ContactForceArray(header=message.header, forces=[
            _contact_force(*row) for row in zip(
                self._grasp.names, message.poses, self._grasp.rotations[:, :, 2],
                np.column_stack([self._commanded, moments]))]))

    def _measure(self, stamp: float) -> Array:
        """Measure displacement and velocity of the object; return its orientation (3, 3)."""
        pose = self._pose()
        displacement = self._place.displacement_to(pose)
        if self._stamp and stamp > self._stamp:
            velocity = (displacement - self.displacement) / (stamp - self._stamp)
            self._velocity += SMOOTHING * (velocity - self._velocity)
        self._still = self._still + 1 if slip_distance(self._velocity) < STILL_SPEED else 0
        self.displacement, self._stamp = displacement, stamp
        return np.asarray(rotation(np.roll(pose.quaternion, -1)), dtype=np.float64)

    def _pose(self) -> Pose:
        """Return the newest pose of the object."""
        pose = self._client.heard.object_pose.pose
        p, q = pose.position, pose.orientation
        return Pose(np.array([p.x, p.y, p.z]), np.array([q.w, q.x, q.y, q.z]))


def _contact_force(name: str, pose: Any, normal: Array, wrench: Array) -> ContactForce:
    """Return the message of one contact's force and moment (6,) along the object's axes."""
    p = pose.position
    message = ContactForce(name=name, position=Point(x=p.x, y=p.y, z=p.z),
                           normal=Vector3(x=float(normal[0]), y=float(normal[1]),
                                          z=float(normal[2])))
    set_wrench(message.wrench, wrench)
    return message

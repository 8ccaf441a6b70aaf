# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated hand's state as ROS messages; every stamp is given by the caller."""

from geometry_msgs.msg import Pose, PoseArray, PoseStamped, Vector3Stamped, WrenchStamped
from grasp_quality_hand.hand_model import FINGERS
from grasp_quality_msgs.msg import Contact, ContactArray
import numpy as np
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

OBJECT_FRAME = 'object'
BASE_FRAME = 'base'          # of the hand: z up, along the fingers


def pose_array(contacts, stamp):
    """Return the contact frames of MeasuredContacts in the object frame."""
    return PoseArray(header=Header(stamp=stamp, frame_id=OBJECT_FRAME),
                     poses=[contact_pose(contact) for contact in contacts])


def contact_pose(contact):
    """Return the contact frame of a MeasuredContact: +z is the inward normal."""
    pose = Pose()
    _set_pose(pose, contact.position, quaternion(contact.R_object_contact))
    return pose


def contact_wrench(contact, stamp):
    """Return what the finger does to the object, in the contact frame that bears its name."""
    message = WrenchStamped(header=Header(stamp=stamp, frame_id=FINGERS[contact.finger]))
    force, torque = message.wrench.force, message.wrench.torque
    force.x, force.y, force.z, torque.z = contact.force.tolist()
    return message


def contact_array(contacts, grasp_object, stamp):
    """Return every contact with its friction; a finger's second contact is <finger>_1."""
    seen = dict.fromkeys(FINGERS, 0)
    message = ContactArray(header=Header(stamp=stamp, frame_id=OBJECT_FRAME))
    for contact in contacts:
        finger = FINGERS[contact.finger]
        name = f'{finger}_{seen[finger]}' if seen[finger] else finger
        seen[finger] += 1
        message.contacts.append(Contact(
            name=name, finger=finger, pose=contact_pose(contact), model=Contact.MODEL_SFCE,
            friction_coefficient=grasp_object.friction,
            torsional_friction_coefficient=grasp_object.torsional_friction))
    return message


def joint_state(simulation, stamp):
    """Return angles [rad], rates [rad/s] and torques [N m] of the hand's joints."""
    return JointState(header=Header(stamp=stamp, frame_id=BASE_FRAME),
                      name=list(simulation.hand.joint_names),
                      position=simulation.joint_positions().tolist(),
                      velocity=simulation.joint_velocities().tolist(),
                      effort=simulation.joint_efforts().tolist())


def object_pose(simulation, stamp):
    """Return the pose of the object frame in the hand's base frame."""
    message = PoseStamped(header=Header(stamp=stamp, frame_id=BASE_FRAME))
    _set_pose(message.pose, simulation.object_position(), simulation.object_quaternion())
    return message


def load_wrench(load, stamp):
    """Return what a pull does to the object, from a wrench (6,) in the object frame [N, N m]."""
    message = WrenchStamped(header=Header(stamp=stamp, frame_id=OBJECT_FRAME))
    set_wrench(message.wrench, load)
    return message


def set_wrench(wrench, values):
    """Fill a Wrench from shape (6,), force first [N, N m]."""
    force, torque = wrench.force, wrench.torque
    force.x, force.y, force.z, torque.x, torque.y, torque.z = map(float, values)


def up_vector(simulation, stamp):
    """Return the direction away from gravity in the object frame."""
    message = Vector3Stamped(header=Header(stamp=stamp, frame_id=OBJECT_FRAME))
    vector = message.vector
    vector.x, vector.y, vector.z = simulation.up_in_object_frame().tolist()
    return message


def quaternion(R):
    """Return the unit quaternion, as x, y, z, w, of a rotation R with shape (3, 3)."""
    # row and column i of 4 q q^T hold q_i times q: the row with the largest diagonal is the safest
    x, y, z = R
    outer = np.array([
        [1 + x[0] - y[1] - z[2], x[1] + y[0], x[2] + z[0], z[1] - y[2]],
        [x[1] + y[0], 1 - x[0] + y[1] - z[2], y[2] + z[1], x[2] - z[0]],
        [x[2] + z[0], y[2] + z[1], 1 - x[0] - y[1] + z[2], y[0] - x[1]],
        [z[1] - y[2], x[2] - z[0], y[0] - x[1], 1 + x[0] + y[1] + z[2]]])
    row = outer[np.argmax(np.diag(outer))]
    return row / np.linalg.norm(row)


def _set_pose(pose, position, orientation):
    """Fill a Pose from a position, shape (3,), and a quaternion (x, y, z, w)."""
    p, q = pose.position, pose.orientation
    p.x, p.y, p.z = position.tolist()
    q.x, q.y, q.z, q.w = orientation.tolist()

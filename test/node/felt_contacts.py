# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Two contacts with what they measure, for a node that names them left and right."""

from geometry_msgs.msg import PoseArray, WrenchStamped
from grasps import ANTIPODAL, pose_array
from harness import BEST_EFFORT
from std_msgs.msg import Header

NAMES = ('left', 'right')


def felt_contacts(client):
    """Return a function that makes a feed of the two poses and of wrenches by name."""
    poses = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    sensors = {name: client.publisher(WrenchStamped, f'contact_wrenches/{name}', BEST_EFFORT)
               for name in NAMES}

    def make(**measured):
        def publish():
            stamp = client.now()
            for name, value in measured.items():
                sensors[name].publish(WrenchStamped(
                    header=Header(frame_id=name, stamp=stamp), wrench=value))
            poses.publish(pose_array(ANTIPODAL, stamp))
        return publish
    return make

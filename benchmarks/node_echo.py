# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The least that rclpy can do: the node's service and topic, answered with a message made before.

Run by benchmarks.node in a process of its own, as the node is:
``python -m benchmarks.node_echo /namespace``.

"""

import sys

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs.msg import ContactForce, GraspQuality
from grasp_quality_msgs.srv import EvaluateTaskWrench
import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy

CONTACTS = 8


def main(namespace):
    """Answer until a signal comes."""
    rclpy.init()
    node = rclpy.create_node('grasp_quality', namespace=namespace)
    response = EvaluateTaskWrench.Response()
    response.forces.forces = [ContactForce(name=f'contact_{i}') for i in range(CONTACTS)]
    quality = GraspQuality()
    out = node.create_publisher(GraspQuality, '~/quality', 1)

    def pass_on(message):
        quality.header = message.header
        out.publish(quality)

    node.create_service(
        EvaluateTaskWrench, '~/evaluate_task_wrench', lambda request, _: response)
    node.create_subscription(
        PoseArray, '~/contact_poses', pass_on,
        QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print('active', flush=True)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main(sys.argv[1])

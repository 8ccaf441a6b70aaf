# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Ask how far two fingers that pinch a 4 cm cube can lift it against its weight of 2 N.

With a node running (grasp_quality_node, or make demo DEMO_FLAGS=--keep), after . ./env.sh:

    python3 examples/evaluate_grasp.py

Leave request.contacts empty to ask about the contacts that the node received last. In a namespace
append --ros-args -r __ns:=/hand.

"""

from geometry_msgs.msg import Point, Pose, Quaternion
from grasp_quality_msgs.msg import Contact, ResultCode
from grasp_quality_msgs.srv import EvaluateTaskWrench
import rclpy

HALF = 0.5 ** 0.5
LEFT = Pose(position=Point(x=-0.02), orientation=Quaternion(y=HALF, w=HALF))    # +z along +x
RIGHT = Pose(position=Point(x=0.02), orientation=Quaternion(y=-HALF, w=HALF))   # +z along -x

rclpy.init()
node = rclpy.create_node('evaluate_grasp')
client = node.create_client(EvaluateTaskWrench, 'grasp_quality/evaluate_task_wrench')
if not client.wait_for_service(timeout_sec=30.0):
    raise SystemExit(f'no service {client.srv_name}: is grasp_quality_node running?')

request = EvaluateTaskWrench.Request()
request.contacts.header.frame_id = 'cube'
request.contacts.contacts = [Contact(name='left', pose=LEFT), Contact(name='right', pose=RIGHT)]
request.task_wrench.force.z = 2.0  # the weight, upward: alpha is then a safety factor
future = client.call_async(request)
rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
if not future.done():
    raise SystemExit('no answer within 5 s')
answer = future.result()
if answer.result.code != ResultCode.OPTIMAL:  # the numbers beside it mean nothing then
    raise SystemExit(f'no answer: {answer.result.message}')

print(f'alpha = {answer.alpha:.4f} times the weight, limited by {answer.limiting_contact}')
for contact in answer.forces.forces:
    force = contact.wrench.force
    print(f'{contact.name}: {force.x:+.3f} {force.y:+.3f} {force.z:+.3f} N on the object, '
          f'{100 * contact.cone_usage:.0f} % of its friction cone')
rclpy.shutdown()

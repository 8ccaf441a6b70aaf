# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Ask all that a node answers without changing it, of two fingers that pinch a 4 cm cube of 2 N.

With a node running (grasp_quality_node, or make demo DEMO_FLAGS=--keep), after . ./env.sh:

    python3 examples/ask_everything.py

The service that is not here, ``set_task``, tells the live loop what to publish forces for: whoever
calls it moves a hand. In a namespace append --ros-args -r __ns:=/hand.

"""

import math

from geometry_msgs.msg import Point, Pose, Quaternion, Vector3, Wrench
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import Contact, ContactArray, ResultCode
import rclpy

HALF = 0.5 ** 0.5
PINCH = ContactArray(contacts=[  # +z of a contact points into the object
    Contact(name='left', pose=Pose(position=Point(x=-0.02),
                                   orientation=Quaternion(y=HALF, w=HALF))),
    Contact(name='right', pose=Pose(position=Point(x=0.02),
                                    orientation=Quaternion(y=-HALF, w=HALF)))])
PINCH.header.frame_id = 'cube'


def force(x=0.0, y=0.0, z=0.0):
    """Return a wrench that is a force [N]."""
    return Wrench(force=Vector3(x=x, y=y, z=z))


UP, WEIGHT = force(z=2.0), force(z=-2.0)
SIDES = [force(z=2.0), force(x=1.0), force(x=-1.0), force(y=1.0), force(y=-1.0)]

rclpy.init()
node = rclpy.create_node('ask_everything')


def ask(kind, name, **request):
    """Return the answer of a service about the pinch."""
    client = node.create_client(kind, f'grasp_quality/{name}')
    if not client.wait_for_service(timeout_sec=30.0):
        raise SystemExit(f'no service {client.srv_name}: is grasp_quality_node running?')
    future = client.call_async(kind.Request(contacts=PINCH, **request))
    rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
    if not future.done():
        raise SystemExit(f'no answer of {name} within 20 s')
    answer = future.result()
    if answer.result.code != ResultCode.OPTIMAL:  # the numbers beside it mean nothing then
        raise SystemExit(f'no answer of {name}: {answer.result.message}')
    return answer


answer = ask(srv.EvaluateTaskWrench, 'evaluate_task_wrench', task_wrench=UP)
print(f'lift: {answer.alpha:.4f} times the weight, proved below {answer.alpha_upper:.4f}')

answer = ask(srv.MinimumForces, 'minimum_forces', external_wrench=WEIGHT)
print(f'hold: the smallest forces take {answer.peak:.4f} of the caps')

answer = ask(srv.EvaluateTaskCone, 'evaluate_task_cone', axis=UP, lateral_x=force(x=2.0),
             lateral_y=force(y=2.0), half_angle=math.radians(20.0))
print(f'lift within 20 degrees: {answer.alpha:.4f} at best, {answer.alpha_axis:.4f} straight up, '
      f'{answer.alpha_worst:.4f} at worst')

answer = ask(srv.EvaluateTaskPolytope, 'evaluate_task_polytope', task_wrenches=SIDES)
print(f'lift, or 1 N to a side: {", ".join(f"{alpha:.2f}" for alpha in answer.alphas)}; together '
      f'{answer.parallelotope_scale:.4f} of these')

answer = ask(srv.WrenchMap, 'wrench_map', external_wrench=WEIGHT, resolution=10)
print(f'forces that remain beside the weight: {min(answer.alphas):.4f} to {max(answer.alphas):.4f}'
      f' N in {len(answer.alphas)} directions')

answer = ask(srv.BallRadius, 'ball_radius', subspace=srv.BallRadius.Request.SUBSPACE_FORCE)
print(f'any force up to {answer.lower:.4f} N, for certain not up to {answer.upper:.4f} N')

answer = ask(srv.RobustAlpha, 'robust_alpha', task_wrench=UP, friction_noise=0.05, quantile=0.05)
print(f'lift with friction known to 0.05: {answer.alpha_quantile:.4f} or more in 95 % of cases')

answer = ask(srv.Explain, 'explain', task_wrench=UP)
print(answer.text)
rclpy.shutdown()

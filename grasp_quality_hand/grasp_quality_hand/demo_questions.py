# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The questions that the demo puts to the node about one grasp."""

from dataclasses import dataclass

from geometry_msgs.msg import Vector3, Wrench
from grasp_quality_msgs.srv import (
    EvaluateTaskCone, EvaluateTaskPolytope, EvaluateTaskWrench, WrenchMap)
import numpy as np

AXES = ('+x', '-x', '+y', '-y', '+z', '-z')
TILT = np.deg2rad(20.0)          # half angle of the cone: lifting with the hand tilted so far
SIDEWAYS = 0.5                   # acceleration while carrying, in multiples of gravity


@dataclass(frozen=True)
class Answer:
    """A response of the node and the time it took as the client saw it, in seconds."""

    response: object
    round_trip: float

    @property
    def solve_time(self):
        """Return the time that the node spent on solving, in seconds."""
        return self.response.solve_time.sec + 1e-9 * self.response.solve_time.nanosec


@dataclass(frozen=True)
class Answers:
    """All answers about one grasp."""

    lift: Answer             # alpha is a safety factor: the task is the weight, upwards
    axes: tuple              # of Answer, one per AXES; alpha in newtons
    cone: Answer
    polytope: Answer
    force_map: Answer


def ask_all(client, weight):
    """
    Ask everything about the grasp that the hand has now.

    Parameters
    ----------
    client : DemoClient
        Asks the node.
    weight : ndarray, shape (3,)
        The force that carries the object, upwards, in the object frame [N].

    """
    def ask(service, name, **request):
        return Answer(*client.ask(service, name, service.Request(**request)))

    side, other_side = horizontal_directions(weight)
    size = np.linalg.norm(weight)
    axes = np.concatenate([np.eye(3), -np.eye(3)])[[0, 3, 1, 4, 2, 5]]    # (6, 3) as AXES
    return Answers(
        lift=ask(EvaluateTaskWrench, 'evaluate_task_wrench', task_wrench=force(weight)),
        axes=tuple(ask(EvaluateTaskWrench, 'evaluate_task_wrench', task_wrench=force(axis))
                   for axis in axes),
        cone=ask(EvaluateTaskCone, 'evaluate_task_cone', axis=force(weight),
                 lateral_x=force(size * side), lateral_y=force(size * other_side),
                 half_angle=TILT),
        polytope=ask(EvaluateTaskPolytope, 'evaluate_task_polytope',
                     task_wrenches=[force(weight + SIDEWAYS * size * direction)
                                    for direction in (side, -side, other_side, -other_side)]),
        force_map=ask(WrenchMap, 'wrench_map'))


def horizontal_directions(up):
    """Return two unit vectors that are perpendicular to up and to each other."""
    side = np.eye(3)[np.argmin(np.abs(up))]
    side = side - up * (up @ side) / (up @ up)
    side /= np.linalg.norm(side)
    return side, np.cross(up, side) / np.linalg.norm(up)


def force(vector):
    """Return the Wrench of a pure force through the origin of the object frame [N]."""
    x, y, z = np.asarray(vector, float).tolist()
    return Wrench(force=Vector3(x=x, y=y, z=z))

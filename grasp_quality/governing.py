# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Which of a task's answers speaks where there is room for one: live topics, recorded bags."""

from typing import cast

from grasp_quality.arrays import Array
from grasp_quality.solution import PolytopeSolution, Solution
from grasp_quality.task import Task, TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench


def governing(task: Task, solution: Solution | PolytopeSolution) -> tuple[Solution, Array]:
    """Solution that forces and alpha are taken from, and the task wrench that alpha multiplies."""
    if isinstance(solution, PolytopeSolution):
        wrenches = task.ends if isinstance(task, TaskEllipsoid) else (
            cast(TaskPolytope, task).wrenches)
        weakest = min(range(len(solution.solutions)), key=lambda i: (
            solution.solutions[i].feasible, solution.solutions[i].alpha))
        return solution.solutions[weakest], wrenches[weakest]
    if isinstance(task, TaskCone):
        reached = solution.alpha > 0.0
        return solution, solution.wrench / solution.alpha if reached else task.axis
    return solution, cast(TaskWrench, task).wrench

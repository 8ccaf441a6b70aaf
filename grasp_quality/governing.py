# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Which of a task's answers speaks where there is room for one: live topics, recorded bags."""

from grasp_quality.task import TaskCone, TaskPolytope


def governing(task, solution):
    """Solution that forces and alpha are taken from, and the task wrench that alpha multiplies."""
    if isinstance(task, TaskPolytope):
        weakest = min(range(len(solution.solutions)), key=lambda i: (
            solution.solutions[i].feasible, solution.solutions[i].alpha))
        return solution.solutions[weakest], task.wrenches[weakest]
    if isinstance(task, TaskCone):
        reached = solution.alpha > 0.0
        return solution, solution.wrench / solution.alpha if reached else task.axis
    return solution, task.wrench

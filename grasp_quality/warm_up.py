# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Run every kind of solve once, so that the first real query is as fast as the thousandth.

Compiles what a machine has not run yet (about a minute, kept in numba's cache beside the source).
``python -m grasp_quality.warm_up`` does the same from a shell.
"""

from grasp_quality.ball import ball_radius
from grasp_quality.contact import Contact, ContactModel
from grasp_quality.grasp import Grasp
from grasp_quality.measures import evaluate, wrench_map
from grasp_quality.robust import robust_alpha
from grasp_quality.task import TaskWrench


def warm_up(bound: str = 'linf') -> None:
    """Solve a small grasp of every contact model, with a load and with a barrier weight."""
    for model in ContactModel:
        contacts = [Contact((x, 0.0, 0.0), (-x, 0.0, 0.0), model, torsional_friction=0.005,
                            finger=f'finger at {x}') for x in (-0.03, 0.03)]
        grasp = Grasp(contacts, bound)
        evaluate(grasp, TaskWrench([1, 0, 0, 0, 0, 0]), [0, 0, -0.1, 0, 0, 0], 1e-3)
        wrench_map(grasp, [[1, 0, 0, 0, 0, 0]])
        ball_radius(grasp, torque_length=0.03)
        robust_alpha(grasp, TaskWrench([1, 0, 0, 0, 0, 0]), samples=2)


if __name__ == '__main__':
    warm_up()

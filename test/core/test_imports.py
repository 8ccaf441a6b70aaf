# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The core stands alone: no ROS, no messages, and CVXPY for the reference only."""

import subprocess
import sys

import pytest

BLOCK = """
import sys
from importlib.abc import MetaPathFinder

class Block(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.split('.')[0] in {blocked}:
            raise ModuleNotFoundError('blocked: ' + name)

sys.meta_path.insert(0, Block())
"""
ROS = (
    'rclpy', 'geometry_msgs', 'std_msgs', 'builtin_interfaces', 'visualization_msgs',
    'diagnostic_msgs', 'sensor_msgs', 'lifecycle_msgs', 'rcl_interfaces', 'grasp_quality_msgs',
    'msg_adapters', 'ament_index_python')
USE = """
from grasp_quality import *
grasp = Grasp([Contact((-1, 0, 0), (1, 0, 0)), Contact((1, 0, 0), (-1, 0, 0))])
assert abs(evaluate(grasp, TaskWrench([0, 1, 0, 0, 0, 0])).alpha - 1) < 1e-6
assert abs(evaluate(grasp, TaskWrench([0, 1, 0, 0, 0, 0]), barrier_weight=.1).alpha - .82) < .01
force_closure(grasp), minimum_forces(grasp, [0, -.1, 0, 0, 0, 0])
"""


def run(code):
    """Run code in a process of its own."""
    return subprocess.run([sys.executable, '-c', code], capture_output=True, text=True,
                          check=False)


@pytest.mark.parametrize('blocked', [ROS, ('cvxpy',)], ids=['ROS', 'CVXPY'])
def test_core_works_without(blocked):
    done = run(BLOCK.format(blocked=blocked) + USE)
    assert done.returncode == 0, done.stderr


def test_the_block_blocks():
    done = run(BLOCK.format(blocked=('cvxpy',)) + 'import grasp_quality.reference')
    assert 'blocked: cvxpy' in done.stderr


def test_the_public_names_are_there():
    import grasp_quality
    documented = {
        'Contact', 'ContactModel', 'Grasp', 'TaskWrench', 'TaskCone', 'TaskPolytope',
        'TaskEllipsoid', 'evaluate', 'wrench_map', 'minimum_forces', 'force_closure',
        'slip_margin', 'build_problem', 'solve', 'ConicProblem', 'Solution', 'Status',
        'GraspQualityError', 'ball_radius', 'volume', 'grasp_indices'}
    assert documented <= set(grasp_quality.__all__)
    assert all(hasattr(grasp_quality, name) for name in grasp_quality.__all__)

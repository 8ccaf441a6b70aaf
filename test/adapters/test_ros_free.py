# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What reads messages needs no ROS: messages of a recorded bag are as good as those of ROS."""

import subprocess
import sys

from grasp_quality.node_parameters import Type
from grasp_quality_msgs.msg import Contact, ResultCode
from grasp_quality_msgs.srv import SetTask
from msg_adapters import contacts, tasks
from msg_adapters.result_codes import Code
import pytest
from rcl_interfaces.msg import ParameterType

BLOCKED = """
import sys
from importlib.abc import MetaPathFinder

class Block(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.split('.')[0] in ('rclpy', 'ament_index_python') or '_msgs' in name or (
                name.endswith('_interfaces') and '.' not in name):
            raise ModuleNotFoundError('blocked: ' + name)

sys.meta_path.insert(0, Block())
"""
REPLAY = """
from rosbags.typesys import get_typestore, Stores

from grasp_quality import evaluate
from grasp_quality.governing import governing
from grasp_quality.node_inputs import Inputs
from grasp_quality.node_scene import measured_margin
from grasp_quality.node_parameters import Settings
from msg_adapters.result_codes import error_code
from msg_adapters.tasks import live_task, load_from

types = get_typestore(Stores.ROS2_JAZZY).types
def make(name, *fields):
    return types['geometry_msgs/msg/' + name](*fields)
def header(frame, ns):
    stamp = types['builtin_interfaces/msg/Time'](0, ns)
    return types['std_msgs/msg/Header'](stamp, frame)
def stamped(frame, *numbers):
    force, torque = make('Vector3', *numbers[:3]), make('Vector3', *numbers[3:])
    return make('WrenchStamped', header(frame, 5), make('Wrench', force, torque))

half = 0.5 ** 0.5
poses = [make('Pose', make('Point', x, 0.0, 0.0), make('Quaternion', 0.0, turn, 0.0, half))
         for x, turn in ((-0.02, half), (0.02, -half))]
settings = Settings(contact_names=('left', 'right'))
inputs = Inputs(lambda: settings, lambda: 7, lambda: 7)
inputs.store_contacts(make('PoseArray', header('object', 5), poses))
inputs.store_wrench('left', stamped('left', 1.0, 0.0, 4.0, 0.0, 0.0, 0.0))
inputs.store_task_wrench(stamped('', 0.0, 0.0, 2.0, 0.0, 0.0, 0.0))
inputs.store_load(stamped('object', 0.0, 0.0, -1.0, 0.0, 0.0, 0.0))
scene = inputs.scene()
task = live_task(inputs.task, None, 1)
solution, _ = governing(task, evaluate(
    scene.grasp, task, load_from(inputs.loads.newest().wrench, None)))
assert abs(solution.alpha - 4.5) < 1e-5
assert abs(measured_margin(scene) - 0.5) < 1e-12
"""


def test_a_scene_is_read_and_evaluated_without_ros():
    done = subprocess.run([sys.executable, '-c', BLOCKED + REPLAY],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize('module', ['rclpy', 'geometry_msgs.msg', 'grasp_quality_msgs.srv'])
def test_the_block_blocks(module):
    done = subprocess.run([sys.executable, '-c', BLOCKED + f'import {module}'],
                          capture_output=True, text=True, check=False)
    assert 'blocked: ' in done.stderr


def test_numbers_are_those_of_the_messages():
    assert contacts.MODEL_DEFAULT == Contact.MODEL_DEFAULT
    assert {getattr(Contact, 'MODEL_' + model.value): model
            for model in contacts.MODELS.values()} == contacts.MODELS
    assert all(getattr(ResultCode, code.name) == code for code in Code)
    for name in ('WRENCH', 'CONE', 'POLYTOPE'):
        assert getattr(tasks, name) == getattr(SetTask.Request, name)
    for kind in Type:
        assert getattr(ParameterType, 'PARAMETER_' + kind.name) == kind

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A disk too full for logs: the node starts, answers, tells failures and ends as always.

Once its log file cannot grow, once there cannot even be one; both times writing to stdout and
stderr fails with "no space left on device".
"""

from pathlib import Path
import subprocess
import sys

from ament_index_python.packages import get_package_prefix
from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, pose_array, SOLVER, wrench
from harness import BEST_EFFORT, Client, Process
from outputs import Outputs
import pytest
from rig import HERE, MAX_AGE_S, TASK


@pytest.mark.parametrize('log_dir', ['logs', '/dev/null/nowhere'])
def test_the_node_goes_on_when_nothing_can_be_logged(tmp_path, log_dir):
    namespace = f'/full_disk_{"made" if log_dir == "logs" else "refused"}'
    program = Path(get_package_prefix('grasp_quality'), 'lib/grasp_quality/grasp_quality_node')
    process = Process(
        [sys.executable, HERE / 'full_disk.py', program, '--ros-args', '-r',
         f'__ns:={namespace}', '-p', f'max_contact_age:={MAX_AGE_S}', '-p',
         f'task_wrench:={TASK}'],
        tmp_path / 'log.txt', environment={'ROS_LOG_DIR': str(tmp_path / log_dir)})
    client = Client(namespace)
    try:
        outputs = Outputs(client)
        publisher = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
        found = outputs.answer(
            lambda: publisher.publish(pose_array(ANTIPODAL, client.now())))
        assert found.quality.alpha == pytest.approx(10.0, rel=SOLVER)
        outputs.failure(ResultCode.STALE_CONTACTS)
        for _ in range(20):  # each of them is worth a warning
            answer = client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench')
            assert answer.result.code == ResultCode.STALE_CONTACTS
        answer = client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench',
                             contacts=contact_array(ANTIPODAL), task_wrench=wrench(fy=1.0))
        assert answer.result.code == ResultCode.OPTIMAL
        assert process.end() == 0
    finally:
        client.close()
        process.popen.kill()


@pytest.mark.parametrize('ending, code', [
    ('', 120), ('from grasp_quality import node; node._let_go_of_output()', 0)])
def test_what_cannot_be_printed_does_not_decide_the_exit_code(ending, code):
    done = subprocess.run([sys.executable, HERE / 'full_disk.py', sys.executable, '-c',
                           f'print("left over"); {ending}'], check=False)
    assert done.returncode == code

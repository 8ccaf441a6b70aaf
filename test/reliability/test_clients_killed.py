# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Clients that are killed in the middle of a call, or come in crowds.

When one dies in a long call, the live loop and the others notice nothing: short questions are
answered meanwhile, the next long one within the time limits of the two. More questions at
once than ROS 2 has room for by default are answered, each of them.
"""

from callers import start_callers
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, EIGHT, SOLVER, wrench
from msg_adapters import qos
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rig import kill, MAX_AGE_S

pytestmark = pytest.mark.robot


@pytest.fixture
def slow_maps(hand):
    """Make maps take seconds with the bound l2, to end at the time limit of 1 s."""
    def bound(name):
        parameter = Parameter('force_bound', value=name).to_parameter_msg()
        answer = hand.client.call(SetParameters, 'set_parameters', parameters=[parameter])
        assert answer.results[0].successful

    bound('l2')
    yield
    bound('linf')


def test_none_of_many_questions_at_once_is_lost(hand):
    client = hand.client.node.create_client(
        srv.EvaluateTaskWrench, f'{hand.client.target}/evaluate_task_wrench',
        qos_profile=qos.questions())
    hand.client.until(client.service_is_ready, 'the service')
    request = srv.EvaluateTaskWrench.Request(
        contacts=contact_array(ANTIPODAL), task_wrench=wrench(fy=1.0))
    answers = [client.call_async(request) for _ in range(100)]
    hand.client.until(lambda: all(answer.done() for answer in answers), 'all answers')
    assert {answer.result().result.code for answer in answers} == {ResultCode.OPTIMAL}
    assert answers[0].result().alpha == pytest.approx(10.0, rel=SOLVER)


def test_others_go_on_when_a_client_dies_in_mid_call(hand, feeds, slow_maps, tmp_path):
    feeds('--grasp', 'EIGHT')
    hand.outputs.answer(None)
    others = start_callers(tmp_path / 'others.txt', hand.namespace, '--clients', '3')
    doomed = start_callers(
        tmp_path / 'doomed.txt', hand.namespace, '--questions', 'map', says='asked')
    answer = hand.client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench',
                              task_wrench=wrench(fx=1.0))
    assert answer.result.code == ResultCode.OPTIMAL
    kill(doomed)
    assert 'answered' not in doomed.log()  # it was in mid-call
    hand.record.until_answers(20)
    answer = hand.client.call(srv.WrenchMap, 'wrench_map', resolution=45)
    assert answer.result.code == ResultCode.TIMED_OUT
    hand.record.until_answers(20)
    counts = others.counts()
    assert counts['lost'] == 0 and counts['answered'] == counts['asked'] >= 3
    # smallest forces wait for the map, within their own time limit
    assert set(counts['codes']) <= {str(ResultCode.OPTIMAL), str(ResultCode.TIMED_OUT)}
    assert len(hand.record.forces[-1][0].forces) == len(EIGHT)
    hand.record.check(MAX_AGE_S)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Joint limits through the node: by service, live, and refused."""

from geometry_msgs.msg import Twist, Vector3
from grasp_quality_msgs.msg import ContactArray, JointLimit, ResultCode
from grasp_quality_msgs.srv import EvaluateTaskWrench, MinimumForces, WrenchMap
from grasps import ANTIPODAL, contact_array, SOLVER, wrench
from harness import BEST_EFFORT
from outputs import Outputs
import pytest


@pytest.fixture(scope='module')
def client(start):
    return start(contact_source='contact_array', max_contact_age='2.0',
                 task_wrench='[-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]').client


def contacts(client, max_torque=0.3, gravity_torque=0.0, fingers=2):
    """Two fingers that face each other along x; one joint, 0.1 m long, presses the right one."""
    message = contact_array(ANTIPODAL, client.now(), name=['left', 'right'])
    still, pressing = Twist(), Twist(linear=Vector3(x=-0.1))
    message.joint_limits = [JointLimit(
        name='knuckle', max_torque=max_torque, gravity_torque=gravity_torque,
        twists=[still, pressing][:fingers])]
    return message


def ask(client, kind, name, message, **fields):
    return client.call(kind, name, contacts=message, **fields)


def test_the_weak_motor_limits_the_push(client):
    """-x: n = (0.3 - gravity) / 0.1, below the cap of 10 N; the joint is named."""
    for gravity, reached in ((0.0, 3.0), (0.1, 2.0)):
        answer = ask(client, EvaluateTaskWrench, 'evaluate_task_wrench',
                     contacts(client, gravity_torque=gravity), task_wrench=wrench(fx=-1.0))
        assert answer.result.code == ResultCode.OPTIMAL
        assert answer.alpha == pytest.approx(reached, rel=SOLVER)
        assert answer.limiting_contact == 'knuckle'
        assert answer.forces.forces[1].wrench.force.x == pytest.approx(-reached, rel=SOLVER)


def test_other_services_keep_the_limits(client):
    held = ask(client, MinimumForces, 'minimum_forces', contacts(client),
               external_wrench=wrench(fy=-2.0))
    assert held.result.code == ResultCode.OPTIMAL and held.peak == pytest.approx(0.2, rel=SOLVER)
    beyond = ask(client, MinimumForces, 'minimum_forces', contacts(client),
                 external_wrench=wrench(fy=-4.0))
    assert beyond.result.code == ResultCode.INFEASIBLE and not beyond.forces.forces
    answer = ask(client, WrenchMap, 'wrench_map', contacts(client),
                 directions=[wrench(fx=-1.0), wrench(fx=1.0), wrench(fy=1.0)])
    assert list(answer.alphas) == pytest.approx([3.0, 10.0, 3.0], rel=SOLVER)


def test_a_hand_that_cannot_carry_itself_is_infeasible(client):
    answer = ask(client, EvaluateTaskWrench, 'evaluate_task_wrench',
                 contacts(client, gravity_torque=-20.0), task_wrench=wrench(fx=-1.0))
    assert answer.result.code == ResultCode.INFEASIBLE
    assert answer.alpha == 0.0 and not answer.forces.forces


def test_live_answers_keep_the_limits_and_name_the_joint(client):
    publisher = client.publisher(ContactArray, 'contacts', BEST_EFFORT)
    outputs = Outputs(client)
    found = outputs.answer(lambda: publisher.publish(contacts(client)))
    assert found.quality.alpha == pytest.approx(3.0, rel=SOLVER)
    assert found.quality.limiting_contact == 'knuckle'
    bad = outputs.failure(
        ResultCode.INVALID_REQUEST, lambda: publisher.publish(contacts(client, fingers=1)))
    assert 'joint_limits[0].twists' in bad.result.message
    outputs.answer(lambda: publisher.publish(contacts(client)))

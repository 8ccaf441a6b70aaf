# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
An answer that took long is one of the moment it is given in, or none.

A solver that takes its time is injected into a true node. What a question waited for makes nothing
stale: contacts and parameters are read when its turn comes. What is replaced while it is computed
makes it no answer: parameters, an active node, and for forces contacts of ``max_contact_age``.
"""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, pose_array, wrench
from harness import BEST_EFFORT
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from msg_adapters import qos
from msg_adapters.stamps import stamp_ns
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rig import ALLOWANCE_S, faulty, inject, MAX_AGE_S, TASK

LONG_S = 3.0
LONG = 'injected: long'
LOAD = wrench(fy=-1.0)  # held by 1 N of friction at each finger: peak 0.1 of caps of 10 N


@pytest.fixture(scope='module')
def node(start, tmp_path_factory):
    fault = tmp_path_factory.mktemp('fault') / 'fault.txt'
    fault.write_text('none')
    node = start(start_node=faulty(fault), max_contact_age=MAX_AGE_S, task_wrench=TASK,
                 solver_time_limit=30.0)
    node.fault = fault
    publisher = node.client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    node.feed = lambda: publisher.publish(pose_array(ANTIPODAL, node.client.now()))
    node.clients = {}
    for name, kind in (('minimum_forces', srv.MinimumForces), ('explain', srv.Explain)):
        node.clients[name] = node.client.node.create_client(
            kind, f'{node.client.target}/{name}', qos_profile=qos.questions())
        node.client.until(node.clients[name].service_is_ready, name)
    return node


@pytest.fixture(autouse=True)
def healed(node):
    yield
    inject(node, 'none')
    put(node, friction_coefficient=0.5, max_normal_force=10.0)


def put(node, **changes):
    answer = node.client.call(SetParameters, 'set_parameters', parameters=[
        Parameter(name, value=value).to_parameter_msg() for name, value in changes.items()])
    assert all(result.successful for result in answer.results)


def begun(node, ask):
    """Ask a question whose first solve takes ``LONG_S``; return its future while that goes on."""
    seen = node.process.log().count(LONG)
    inject(node, f'long {LONG_S}')
    future = ask()
    node.client.until(lambda: node.process.log().count(LONG) > seen, 'the solve to begin')
    inject(node, 'none')
    assert not future.done()
    return future


def forces(node, **fields):
    return node.clients['minimum_forces'].call_async(
        srv.MinimumForces.Request(external_wrench=LOAD, **fields))


def forces_of_own_contacts(node):
    return forces(node, contacts=contact_array(ANTIPODAL))


def reasons(node, **fields):
    return node.clients['explain'].call_async(
        srv.Explain.Request(task_wrench=wrench(fy=1.0), **fields))


def reasons_of_own_contacts(node):
    return reasons(node, contacts=contact_array(ANTIPODAL))


def answer_of(node, future, feed=None):
    node.client.until(future.done, 'an answer', feed)
    return future.result()


def check_refusal(answer, code, words):
    assert answer.result.code == code and words in answer.result.message, answer.result
    assert answer == type(answer)(result=answer.result, solve_time=answer.solve_time)


def wait_for_fresh(node):
    """Feed until live contacts are answered."""
    def ask():
        return node.client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench', node.feed,
                                task_wrench=wrench(fy=1.0)).result.code == ResultCode.OPTIMAL
    node.client.until(ask, 'fresh contacts', node.feed)


def let_it_arrive(node):
    """Ask twice more: before the second answer the node has begun all that it was asked."""
    for _ in range(2):
        wait_for_fresh(node)


def test_contacts_that_die_while_a_question_waits_are_not_answered(node):
    hog = begun(node, lambda: reasons_of_own_contacts(node))
    wait_for_fresh(node)
    answer = answer_of(node, forces(node))
    assert answer_of(node, hog).result.code == ResultCode.OPTIMAL
    check_refusal(answer, ResultCode.STALE_CONTACTS, 'the newest contacts are')


def test_a_question_that_waited_is_answered_for_contacts_of_now(node):
    hog = begun(node, lambda: reasons_of_own_contacts(node))
    wait_for_fresh(node)
    asked_ns = stamp_ns(node.client.now())
    answer = answer_of(node, forces(node), node.feed)
    now_ns = stamp_ns(node.client.now())
    assert now_ns - asked_ns > 1e9 * MAX_AGE_S  # what it was asked with would be stale
    assert answer_of(node, hog).result.code == answer.result.code == ResultCode.OPTIMAL
    assert now_ns - stamp_ns(answer.forces.header.stamp) < 1e9 * (MAX_AGE_S + ALLOWANCE_S)


def test_contacts_that_die_while_their_forces_are_computed_are_not_answered(node):
    wait_for_fresh(node)
    answer = answer_of(node, begun(node, lambda: forces(node)))
    check_refusal(answer, ResultCode.STALE_CONTACTS, 'the contacts of this answer are')


def test_newer_contacts_do_not_make_forces_of_older_ones_fresh(node):
    wait_for_fresh(node)
    answer = answer_of(node, begun(node, lambda: forces(node)), node.feed)
    check_refusal(answer, ResultCode.STALE_CONTACTS, 'the contacts of this answer are')


def test_what_carries_no_forces_is_answered_for_the_contacts_it_was_asked_with(node):
    wait_for_fresh(node)
    answer = answer_of(node, begun(node, lambda: reasons(node)))
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.alpha == pytest.approx(10.0, rel=1e-4)


def test_a_question_that_waited_obeys_the_parameters_of_now(node):
    begun(node, lambda: reasons_of_own_contacts(node))
    waiting = forces_of_own_contacts(node)
    let_it_arrive(node)
    put(node, max_normal_force=2.0)
    answer = answer_of(node, waiting)
    assert answer.result.code == ResultCode.OPTIMAL
    assert answer.peak == pytest.approx(0.5, rel=1e-4)  # 1 N of 2 N


@pytest.mark.parametrize('ask', [forces_of_own_contacts, reasons_of_own_contacts])
def test_parameters_changed_while_it_is_computed_make_it_no_answer(node, ask):
    future = begun(node, lambda: ask(node))
    put(node, max_normal_force=2.0)
    assert not future.done()
    check_refusal(answer_of(node, future), ResultCode.STALE_CONTACTS, 'parameters were changed')
    assert answer_of(node, ask(node)).result.code == ResultCode.OPTIMAL


@pytest.mark.parametrize('ask', [forces, reasons_of_own_contacts])
def test_a_node_that_was_deactivated_meanwhile_gives_no_answer(node, ask):
    wait_for_fresh(node)
    future = begun(node, lambda: ask(node))
    for transition in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_ACTIVATE):
        assert node.client.call(
            ChangeState, 'change_state', transition=Transition(id=transition)).success
    assert not future.done()
    check_refusal(answer_of(node, future), ResultCode.NOT_ACTIVE, 'was deactivated while')


def test_contacts_of_before_a_deactivation_are_not_answered_to_who_waited(node):
    hog = begun(node, lambda: reasons_of_own_contacts(node))
    wait_for_fresh(node)
    waiting = forces(node)
    let_it_arrive(node)
    for transition in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_ACTIVATE):
        assert node.client.call(
            ChangeState, 'change_state', transition=Transition(id=transition)).success
    assert not hog.done() and not waiting.done()
    check_refusal(answer_of(node, waiting), ResultCode.NO_CONTACTS, 'no contacts received yet')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Managed by hand: the states, what each of them answers, and impossible transitions."""

from geometry_msgs.msg import PoseArray
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
from grasps import ANTIPODAL, contact_array, pose_array, wrench
from harness import BEST_EFFORT
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
import pytest

CONFIGURE, CLEANUP = Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_CLEANUP
ACTIVATE, DEACTIVATE = Transition.TRANSITION_ACTIVATE, Transition.TRANSITION_DEACTIVATE


@pytest.fixture(scope='module')
def client(start):
    return start(autostart='false').client


def change(client, transition):
    return client.call(
        ChangeState, 'change_state', transition=Transition(id=transition)).success


def state(client):
    return client.call(GetState, 'get_state').current_state.id


def ask(client):
    return client.call(srv.EvaluateTaskWrench, 'evaluate_task_wrench',
                       contacts=contact_array(ANTIPODAL), task_wrench=wrench(fy=1.0))


def test_it_answers_in_every_state_but_computes_only_when_active(client):
    def refused():
        answers = [ask(client)] + [client.call(kind, name) for kind, name in (
            (srv.EvaluateTaskCone, 'evaluate_task_cone'),
            (srv.EvaluateTaskPolytope, 'evaluate_task_polytope'),
            (srv.MinimumForces, 'minimum_forces'), (srv.WrenchMap, 'wrench_map'),
            (srv.SetTask, 'set_task'))]
        assert {a.result.code for a in answers} == {ResultCode.NOT_ACTIVE}
        assert all('not active' in a.result.message for a in answers)
        return True

    assert state(client) == State.PRIMARY_STATE_UNCONFIGURED and refused()
    assert change(client, CONFIGURE)
    assert state(client) == State.PRIMARY_STATE_INACTIVE and refused()
    assert change(client, ACTIVATE)
    assert state(client) == State.PRIMARY_STATE_ACTIVE
    assert ask(client).result.code == ResultCode.OPTIMAL
    assert change(client, DEACTIVATE) and refused()
    assert change(client, CLEANUP)
    assert state(client) == State.PRIMARY_STATE_UNCONFIGURED and refused()


@pytest.mark.parametrize('transition', [ACTIVATE, DEACTIVATE, CLEANUP, 99])
def test_an_impossible_transition_is_refused_and_the_node_lives(client, transition):
    assert not change(client, transition)
    assert state(client) == State.PRIMARY_STATE_UNCONFIGURED


def test_an_unknown_label_is_refused(client):
    assert not client.call(
        ChangeState, 'change_state', transition=Transition(label='explode')).success


def test_deactivation_withdraws_what_was_published(client):
    assert change(client, CONFIGURE) and change(client, ACTIVATE)
    contacts = client.publisher(PoseArray, 'contact_poses', BEST_EFFORT)
    quality = client.listen(GraspQuality, 'quality')
    forces = client.listen(ContactForceArray, 'contact_forces')
    client.call(srv.SetTask, 'set_task', kind=1, task_wrench=wrench(fy=1.0))

    def feed():
        contacts.publish(pose_array(ANTIPODAL, client.now()))

    client.fresh(quality, lambda m: m.result.code == ResultCode.OPTIMAL, 'an answer', feed)
    assert change(client, DEACTIVATE)
    client.until(lambda: quality[-1].result.code == ResultCode.NOT_ACTIVE, 'NOT_ACTIVE')
    client.until(lambda: not forces[-1].forces, 'empty forces')
    assert quality[-1].alpha == 0.0 and 'deactivated' in quality[-1].result.message
    silent = len(quality)
    for _ in range(5):  # five answers later, nothing was published
        feed()
        assert ask(client).result.code == ResultCode.NOT_ACTIVE
    assert len(quality) == silent
    assert change(client, ACTIVATE)
    client.fresh(quality, lambda m: m.result.code == ResultCode.OPTIMAL, 'the kept task', feed)


def test_shutdown_from_active_withdraws_too_and_the_process_ends(start):
    node = start()
    client = node.client
    quality = client.listen(GraspQuality, 'quality')
    assert change(client, Transition.TRANSITION_ACTIVE_SHUTDOWN)
    client.until(
        lambda: quality and quality[-1].result.code == ResultCode.NOT_ACTIVE, 'NOT_ACTIVE')
    assert state(client) == State.PRIMARY_STATE_FINALIZED
    assert ask(client).result.code == ResultCode.NOT_ACTIVE
    assert not change(client, ACTIVATE)
    assert node.process.end() == 0

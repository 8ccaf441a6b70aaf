# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Lifecycle transitions in every order while contacts arrive, a hundred of them at random.

Each ends in the state that the lifecycle of ROS 2 says, possible or not; forces are published in
the active state and in no other, and the same process answers to the end.
"""

import time

from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ResultCode
from grasps import ANTIPODAL, contact_array, wrench
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
import numpy as np
from outputs import Outputs
from rig import MAX_AGE_S, Record, start_feed, TASK

STEPS = 100
UNCONFIGURED, INACTIVE, ACTIVE, FINALIZED = (
    State.PRIMARY_STATE_UNCONFIGURED, State.PRIMARY_STATE_INACTIVE, State.PRIMARY_STATE_ACTIVE,
    State.PRIMARY_STATE_FINALIZED)
NEXT = {
    (UNCONFIGURED, Transition.TRANSITION_CONFIGURE): INACTIVE,
    (INACTIVE, Transition.TRANSITION_CLEANUP): UNCONFIGURED,
    (INACTIVE, Transition.TRANSITION_ACTIVATE): ACTIVE,
    (ACTIVE, Transition.TRANSITION_DEACTIVATE): INACTIVE}
SHUTDOWN = {UNCONFIGURED: Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
            INACTIVE: Transition.TRANSITION_INACTIVE_SHUTDOWN,
            ACTIVE: Transition.TRANSITION_ACTIVE_SHUTDOWN}
TRANSITIONS = (0, 1, 2, 3, 4, *SHUTDOWN.values(), 8, 9, 10, 62, 255)


def test_a_random_walk(start, tmp_path):
    node = start(max_contact_age=MAX_AGE_S, task_wrench=TASK)
    client, record = node.client, Record(node.client)
    feed = start_feed(tmp_path / 'feed.txt', node.namespace)
    draw = np.random.default_rng(7)
    state, active_ns = ACTIVE, [[0, None]]  # when it is active, begin and end

    def change(transition):
        return client.call(
            ChangeState, 'change_state', transition=Transition(id=transition)).success

    Outputs(client).answer(None)
    for _ in range(STEPS):
        possible = [t for s, t in NEXT if s == state]
        transition = int(draw.choice(possible if draw.random() < 0.6 else [
            t for t in TRANSITIONS if t != SHUTDOWN[state]]))
        wanted = NEXT.get((state, transition))
        if wanted == ACTIVE:
            active_ns.append([time.time_ns(), None])
        assert change(transition) == (wanted is not None)
        if state == ACTIVE and wanted is not None:
            active_ns[-1][1] = time.time_ns()
        state = wanted or state
        assert client.call(GetState, 'get_state').current_state.id == state
        code = client.call(
            srv.EvaluateTaskWrench, 'evaluate_task_wrench', contacts=contact_array(ANTIPODAL),
            task_wrench=wrench(fy=1.0)).result.code
        assert code == (ResultCode.OPTIMAL if state == ACTIVE else ResultCode.NOT_ACTIVE)
        if state == ACTIVE and draw.random() < 0.3:
            record.until_answers(3)
    while state != ACTIVE:
        state = NEXT[state, 1 if state == UNCONFIGURED else 3]
        active_ns.append([time.time_ns(), None])
        assert change(1 if state == INACTIVE else 3)
    record.until_answers(3)
    assert change(SHUTDOWN[ACTIVE])
    active_ns[-1][1] = time.time_ns()
    assert client.call(GetState, 'get_state').current_state.id == FINALIZED
    assert not any(change(t) for t in TRANSITIONS)
    assert feed.end() == 0
    for message, sent_ns in record.forces:
        assert not message.forces or any(
            begin <= sent_ns <= end for begin, end in active_ns if end is not None)
    assert not record.forces[-1][0].forces
    record.check(MAX_AGE_S)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The live loop: one solve for every new sample of contacts, always of the newest.

Nothing queues: a sample that arrives during a solve replaces the one before it. The watchdog
publishes a failure at its own rate while contacts are missing or stale, so that silence is noticed
at once; of a load that becomes stale between samples it tells once, as every further sample does.
Errors of any kind end in a published code, never in an exception.
"""

import time

from grasp_quality.governing import governing
from grasp_quality.measures import evaluate
from grasp_quality.node_ages import until_stale
from grasp_quality.node_follow import Follower
from grasp_quality.node_quantile import live_quantile
from grasp_quality.node_scene import measured_margin
from grasp_quality.problem import NO_WRENCH
from grasp_quality.task import TaskCone, TaskWrench
from grasp_quality_msgs.msg import GraspQuality, ResultCode
from msg_adapters.errors import InvalidMessageError, NoContactsError, StaleContactsError
from msg_adapters.results import error_result, status_result
from msg_adapters.stamps import to_duration
from msg_adapters.tasks import live_task, load_from
from msg_adapters.wrenches import to_wrench
from std_msgs.msg import Header


class LiveLoop:
    """Evaluates ``inputs`` for ``outputs``, ``margin`` and ``display``; ``monitor`` counts."""

    def __init__(self, inputs, outputs, settings, monitor, display, margin, holding, now):
        self._inputs = inputs
        self._outputs = outputs
        self._settings = settings
        self._monitor = monitor
        self._display = display
        self._holding = holding
        self._margin = margin
        self._follower = Follower()
        self._now = now
        self._task = (None, None, None)  # message, settings, and what they say
        self._answered = False  # and not failed since

    def evaluate(self):
        """Solve the newest contacts for the live task and publish the answer."""
        scene = None
        try:
            scene = self._inputs.scene()
            quality, answer, load = self._answer(scene)
            self._outputs.publish(quality, scene.grasp, *answer, check=self._inputs.left_s)
            self._answered = True
            self._follower.published(scene.grasp, answer[0])
            if quality.result.code == ResultCode.OPTIMAL:
                self._holding.publish(
                    self._outputs, quality, scene.grasp, load, self._inputs.left_s)
            self._display.show(scene, load, quality, *answer)
            self._monitor.count(quality)
        except Exception as exc:
            self._fail(exc, scene)
        if scene is not None:
            self._monitor.note_margin(measured_margin(scene))
            self._margin.show(scene, self._inputs.age_s)

    def forget(self):
        """Begin anew, as after a deactivation: the next forces owe nothing to the last."""
        self._follower.forget()
        self._answered = False

    def watch(self):
        """Publish a failure when there are no fresh contacts, or no load for the last answer."""
        try:
            self._inputs.age_s()
        except (NoContactsError, StaleContactsError) as exc:
            self._fail(exc, None)
            return
        try:
            self._inputs.loads.left_s()
        except StaleContactsError as exc:
            if self._answered:
                self._fail(exc, None, has_margin=True)

    def _fail(self, exc, scene, has_margin=False):
        self._answered = False
        stamp, frame = (self._now(), '') if scene is None else (scene.stamp, scene.frame)
        result = error_result(exc)
        self._monitor.count_failure(result, exc)
        self._outputs.publish_failure(result, stamp, frame)
        self._display.clear(Header(stamp=stamp, frame_id=frame))
        if scene is None and not has_margin:
            self._margin.fail(result, Header(stamp=stamp, frame_id=frame))

    def _answer(self, scene):
        settings = self._settings()
        started = time.perf_counter()
        task, load = self._task_and_load(scene)
        # the watchdog cannot bark during a solve, which must end before contacts or load are stale
        limit = until_stale(self._inputs.left_s(), settings.solver_time_limit)
        solution = evaluate(scene.grasp, task, load, settings.barrier_weight, limit,
                            settings.alpha_reserve, self._follower.start)
        solution, wrench = governing(task, solution)
        single = task if isinstance(task, TaskCone) else TaskWrench(wrench)
        solution, limited = self._follower.settle(
            scene.grasp, single, load, solution, settings.force_rate_limit, limit)
        if single is task:
            solution, wrench = governing(task, solution)
        solve_time = time.perf_counter() - started
        margin = measured_margin(scene)
        quantile, reason = {}, ''
        if solution.feasible:
            left = min(settings.solver_time_limit - solve_time, self._inputs.left_s())
            quantile, reason = live_quantile(scene, task, load, settings, left)
        result = status_result(solution.status, remark=solution.remark)
        result.message = result.message or reason
        quality = GraspQuality(
            header=Header(stamp=scene.stamp, frame_id=scene.frame), result=result,
            task_wrench=to_wrench(wrench),
            external_wrench=to_wrench(NO_WRENCH if load is None else load),
            alpha=solution.alpha, alpha_upper=solution.alpha_upper,
            alpha_lower=solution.alpha_lower, holdable=solution.holdable,
            friction_margin=solution.friction_margin, limiting_contact=solution.limiting_contact,
            force_rate_limited=limited,
            contact_age=to_duration(self._inputs.age_s()), solve_time=to_duration(solve_time),
            slip_measured=margin is not None, measured_slip_margin=margin or 0.0, **quantile)
        return quality, (solution.forces, solution.cone_usage), load

    def _task_and_load(self, scene):
        inputs, settings = self._inputs, self._settings()
        if inputs.task is None:
            raise InvalidMessageError(
                'no task set: call ~/set_task, publish ~/task_wrench or set the parameter '
                'task_wrench; ~/holding_forces need one too, whichever it is')
        # where the object is when its contacts are sensed, not when the task was sent
        transform = inputs.transform(inputs.task.header, scene.frame, scene.stamp)
        message, under, task = self._task
        if transform is not None or message is not inputs.task or under is not settings:
            task = live_task(inputs.task, transform, settings.max_request_size)
            # a transform may be another one for every sample
            self._task = (None if transform is not None else inputs.task, settings, task)
        load = inputs.loads.newest()
        if load is None:
            return task, None
        return task, load_from(
            load.wrench, inputs.transform(load.header, scene.frame, scene.stamp))

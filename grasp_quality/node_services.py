# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of the node: each reads a request, asks the core once, and fills the response.

``Services`` gives every handler the same boundary: whatever goes wrong becomes a fresh response
with a result code, so that a client always gets an answer and never half of one. What may take
long is awaited (``node_worker``), so that the live loop goes on. ``node_questions`` reads the
inputs when its turn comes, and refuses an answer whose inputs were replaced or are stale since.
"""

import inspect
import math
import time

from grasp_quality.ball import ellipsoid_scale
from grasp_quality.directions import force_grid
from grasp_quality.explanation import explain
from grasp_quality.holding import minimum_forces
from grasp_quality.measures import evaluate, wrench_map
from grasp_quality.node_log import Refusals
from grasp_quality.node_questions import Questions
from grasp_quality.node_worker import Worker
from grasp_quality.robust import robust_alpha
from grasp_quality.status import Status
from grasp_quality.task import TaskWrench
from grasp_quality_msgs import srv
from msg_adapters import qos
from msg_adapters.errors import InvalidMessageError, NotActiveError
from msg_adapters.explanations import fill_explanation
from msg_adapters.forces import force_array
from msg_adapters.results import error_result, status_result
from msg_adapters.stamps import to_duration
from msg_adapters.tasks import (
    cone_task, live_task, load_from, polytope_task, wrench_rows, wrench_task)
from msg_adapters.uncertainty import fill_robust_alpha, noise_from, sampling_from
from msg_adapters.worst_case import ellipsoid_from, fill_ball_radius, width_from
from msg_adapters.wrenches import to_wrench
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup

SURFACE_SAMPLES = 32
MANY_CONTACTS = 64  # from which on even a single task may take long


class Services:
    """Handlers of all services; ``is_active()`` tells the lifecycle state."""

    def __init__(self, node, inputs, settings, is_active):
        self._inputs = inputs
        self._settings = settings
        self._is_active = is_active
        self._refusals = Refusals(node.get_logger().warning)
        self._worker = Worker(node)
        self._ask = Questions(inputs, settings, self._check_active, self._worker).asked
        for kind, handler in (
                (srv.EvaluateTaskWrench, self.evaluate_task_wrench),
                (srv.EvaluateTaskCone, self.evaluate_task_cone),
                (srv.EvaluateTaskPolytope, self.evaluate_task_polytope),
                (srv.MinimumForces, self.minimum_forces),
                (srv.WrenchMap, self.wrench_map),
                (srv.RobustAlpha, self.robust_alpha),
                (srv.BallRadius, self.ball_radius),
                (srv.Explain, self.explain),
                (srv.SetTask, self.set_task)):
            waits = inspect.iscoroutinefunction(handler)
            node.create_service(
                kind, f'~/{handler.__name__}', self._bounded(handler), qos_profile=qos.questions(),
                callback_group=MutuallyExclusiveCallbackGroup() if waits else None)

    def _bounded(self, handler):
        async def answer(request, response):
            started = time.perf_counter()
            try:
                self._check_active()
                answering = handler(request, response)
                if answering is not None:
                    await answering
                    self._check_active()  # it may have been deactivated meanwhile
            except Exception as exc:
                response = type(response)(result=error_result(exc))
                self._refusals.tell(f'{handler.__name__}: {response.result.message}')
            response.solve_time = to_duration(time.perf_counter() - started)
            return response
        return answer

    def _check_active(self):
        if not self._is_active():
            raise NotActiveError('the node is not active: configure and activate it, as with '
                                 'ros2 lifecycle set')

    async def _evaluate(self, question, task):
        settings = question.settings
        arguments = (question.grasp, task, question.load, settings.barrier_weight,
                     question.limit, settings.alpha_reserve)
        if isinstance(task, TaskWrench) and not _is_large(question.grasp):
            return evaluate(*arguments)
        return await self._worker.run(evaluate, *arguments)

    async def evaluate_task_wrench(self, request, response):
        """Answer the largest alpha of one wrench, and its forces."""
        async with self._ask(request, response, _is_large) as question:
            task = wrench_task(request.task_wrench, question.transform)
            solution = await self._evaluate(question, task)
            response.result = status_result(solution.status, remark=solution.remark)
            response.alpha, response.alpha_upper = solution.alpha, solution.alpha_upper
            response.alpha_lower, response.holdable = solution.alpha_lower, solution.holdable
            response.forces = _forces(question, solution)
            response.limiting_contact = solution.limiting_contact
            response.dalpha_dexternal_wrench = to_wrench(solution.dalpha_dexternal_wrench)

    async def evaluate_task_cone(self, request, response):
        """Answer the largest alpha_z inside a cone of wrenches."""
        async with self._ask(request, response) as question:
            task = cone_task(request, question.transform, SURFACE_SAMPLES)
            solution = await self._evaluate(question, task)
            response.result = status_result(solution.status, remark=solution.remark)
            if solution.feasible:
                response.alpha, response.alpha_upper = solution.alpha, solution.alpha_upper
                response.alpha_axis = solution.alpha_axis
                response.alpha_worst = solution.alpha_worst
            response.optimal_wrench = to_wrench(solution.wrench)
            response.forces = _forces(question, solution)

    async def evaluate_task_polytope(self, request, response):
        """Answer alpha of every wrench by itself, and what they guarantee together."""
        async with self._ask(request, response) as question:
            task = polytope_task(
                request, question.transform, question.settings.max_request_size)
            answer = await self._evaluate(question, task)
            response.result = status_result(answer.status)
            if answer.status is Status.INFEASIBLE:
                return
            response.quality, response.alpha_min = answer.quality, answer.alpha_min
            response.alphas = answer.alphas.tolist()
            response.parallelotope_scale = answer.parallelotope_scale or 0.0
            response.forces = [_forces(question, s) for s in answer.solutions]

    async def minimum_forces(self, request, response):
        """Answer the smallest forces that balance the external wrench."""
        async with self._ask(request, response) as question:
            answer = await self._worker.run(
                minimum_forces, question.grasp, question.load, question.limit)
            response.result = status_result(answer.status, answer.reason)
            response.peak = answer.peak if math.isfinite(answer.peak) else 0.0
            response.forces = _forces(question, answer)

    async def wrench_map(self, request, response):
        """Answer alpha for many directions."""
        async with self._ask(request, response) as question:
            settings = question.settings
            if request.directions:
                directions = wrench_rows(request.directions, question.transform,
                                         settings.max_request_size, 'directions')
            else:
                directions = self._grid(request.resolution, settings)
            answer = await self._worker.run(
                wrench_map, question.grasp, directions, question.load,
                time_limit_s=question.limit)
            if not answer.feasible.any():
                response.result = status_result(Status.INFEASIBLE)
                return
            response.result = status_result(Status.OPTIMAL)
            missing = len(directions) - int(answer.feasible.sum())
            if missing:
                response.result.message = (
                    f'{missing} of {len(directions)} directions are infeasible: alpha is 0 there')
            response.directions = [to_wrench(d) for d in answer.directions.tolist()]
            response.alphas = answer.alpha.tolist()

    def _grid(self, resolution, settings):
        steps = resolution or max(1, round(math.sqrt(settings.map_directions / 2)))
        if 2 * steps ** 2 > settings.max_request_size:
            raise InvalidMessageError(
                f'resolution must give at most {settings.max_request_size} directions (parameter '
                f'max_request_size), got {steps}, which gives {2 * steps ** 2}')
        return force_grid(steps)

    async def robust_alpha(self, request, response):
        """Answer the quantile of alpha under uncertain contacts, friction and load."""
        async with self._ask(request, response) as question:
            settings = question.settings
            sampling = sampling_from(request, settings.quantile_level, settings.max_request_size)
            fill_robust_alpha(response, await self._worker.run(
                robust_alpha, question.grasp,
                wrench_task(request.task_wrench, question.transform), question.load,
                **noise_from(request), **sampling, time_limit_s=question.limit))

    async def ball_radius(self, request, response):
        """Answer the radius of the largest ball of wrenches, the worst case."""
        async with self._ask(request, response) as question:
            ellipsoid = ellipsoid_from(
                request, question.transform, question.settings.max_request_size)
            fill_ball_radius(response, await self._worker.run(
                ellipsoid_scale, question.grasp, ellipsoid, width_from(request), question.limit))

    async def explain(self, request, response):
        """Answer what limits a task wrench, and what would change its alpha."""
        async with self._ask(request, response) as question:
            task = wrench_task(request.task_wrench, question.transform)
            fill_explanation(response, await self._worker.run(
                explain, question.grasp, task, question.load, question.limit))

    def set_task(self, request, response):
        """Set task and load of the live loop, once they are known to be valid."""
        live_task(request, None, self._settings().max_request_size)
        load_from(request.external_wrench, None)
        self._inputs.set_task(request)
        response.result = status_result(Status.OPTIMAL)


def _is_large(grasp):
    return len(grasp) >= MANY_CONTACTS


def _forces(question, answer):
    return force_array(question.header, question.grasp, answer.forces, answer.cone_usage)

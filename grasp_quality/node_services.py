# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of the node: each reads a request, asks the core once, and fills the response.

``Services`` gives every handler the same boundary: whatever goes wrong becomes a fresh response
with a result code, so that a client always gets an answer and never half of one. What may take
long is awaited (``node_worker``), so that the live loop goes on; the inputs are read before.
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
from grasp_quality.node_worker import Worker
from grasp_quality.robust import robust_alpha
from grasp_quality.status import Status
from grasp_quality.task import TaskWrench
from grasp_quality.time_limit import TimeLimit
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
from std_msgs.msg import Header

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

    def _question(self, request):
        """Grasp, header of the answer, transform of the request's wrenches, load."""
        if request.contacts.contacts:
            grasp, frame = self._inputs.read_grasp(request.contacts)
            stamp = request.contacts.header.stamp
        else:
            scene = self._inputs.scene()
            grasp, frame, stamp = scene.grasp, scene.frame, scene.stamp
        transform = self._inputs.transform(request.header, frame, stamp)
        load = load_from(request.external_wrench, transform)
        return grasp, Header(stamp=stamp, frame_id=frame), transform, load

    def _limit(self):
        """Begin to count the time of this question; waiting for the worker is part of it."""
        return TimeLimit.of(self._settings().solver_time_limit)

    async def _evaluate(self, grasp, task, load):
        settings = self._settings()
        question = (grasp, task, load, settings.barrier_weight, self._limit(),
                    settings.alpha_reserve)
        if isinstance(task, TaskWrench) and len(grasp) < MANY_CONTACTS:
            return evaluate(*question)
        return await self._worker.run(evaluate, *question)

    async def evaluate_task_wrench(self, request, response):
        """Answer the largest alpha of one wrench, and its forces."""
        grasp, header, transform, load = self._question(request)
        solution = await self._evaluate(grasp, wrench_task(request.task_wrench, transform), load)
        response.result = status_result(solution.status, remark=solution.remark)
        response.alpha, response.alpha_upper = solution.alpha, solution.alpha_upper
        response.alpha_lower, response.holdable = solution.alpha_lower, solution.holdable
        response.forces = force_array(header, grasp, solution.forces, solution.cone_usage)
        response.limiting_contact = solution.limiting_contact
        response.dalpha_dexternal_wrench = to_wrench(solution.dalpha_dexternal_wrench)

    async def evaluate_task_cone(self, request, response):
        """Answer the largest alpha_z inside a cone of wrenches."""
        grasp, header, transform, load = self._question(request)
        task = cone_task(request, transform, SURFACE_SAMPLES)
        solution = await self._evaluate(grasp, task, load)
        response.result = status_result(solution.status, remark=solution.remark)
        if solution.feasible:
            response.alpha, response.alpha_upper = solution.alpha, solution.alpha_upper
            response.alpha_axis = solution.alpha_axis
            response.alpha_worst = solution.alpha_worst
        response.optimal_wrench = to_wrench(solution.wrench)
        response.forces = force_array(header, grasp, solution.forces, solution.cone_usage)

    async def evaluate_task_polytope(self, request, response):
        """Answer alpha of every wrench by itself, and what they guarantee together."""
        grasp, header, transform, load = self._question(request)
        task = polytope_task(request, transform, self._settings().max_request_size)
        answer = await self._evaluate(grasp, task, load)
        response.result = status_result(answer.status)
        if answer.status is Status.INFEASIBLE:
            return
        response.quality, response.alpha_min = answer.quality, answer.alpha_min
        response.alphas = answer.alphas.tolist()
        response.parallelotope_scale = answer.parallelotope_scale or 0.0
        response.forces = [force_array(header, grasp, s.forces, s.cone_usage)
                           for s in answer.solutions]

    async def minimum_forces(self, request, response):
        """Answer the smallest forces that balance the external wrench."""
        grasp, header, _, load = self._question(request)
        answer = await self._worker.run(minimum_forces, grasp, load, self._limit())
        response.result = status_result(answer.status, answer.reason)
        response.peak = answer.peak if math.isfinite(answer.peak) else 0.0
        response.forces = force_array(header, grasp, answer.forces, answer.cone_usage)

    async def wrench_map(self, request, response):
        """Answer alpha for many directions."""
        grasp, _, transform, load = self._question(request)
        settings = self._settings()
        if request.directions:
            directions = wrench_rows(
                request.directions, transform, settings.max_request_size, 'directions')
        else:
            directions = self._grid(request.resolution, settings)
        answer = await self._worker.run(
            wrench_map, grasp, directions, load, time_limit_s=self._limit())
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
        grasp, _, transform, load = self._question(request)
        settings = self._settings()
        sampling = sampling_from(request, settings.quantile_level, settings.max_request_size)
        fill_robust_alpha(response, await self._worker.run(
            robust_alpha, grasp, wrench_task(request.task_wrench, transform), load,
            **noise_from(request), **sampling, time_limit_s=self._limit()))

    async def ball_radius(self, request, response):
        """Answer the radius of the largest ball of wrenches, the worst case."""
        grasp, _, transform, _ = self._question(request)
        settings = self._settings()
        ellipsoid = ellipsoid_from(request, transform, settings.max_request_size)
        answer = await self._worker.run(
            ellipsoid_scale, grasp, ellipsoid, width_from(request), self._limit())
        fill_ball_radius(response, answer)

    async def explain(self, request, response):
        """Answer what limits a task wrench, and what would change its alpha."""
        grasp, _, transform, load = self._question(request)
        fill_explanation(response, await self._worker.run(
            explain, grasp, wrench_task(request.task_wrench, transform), load, self._limit()))

    def set_task(self, request, response):
        """Set task and load of the live loop, once they are known to be valid."""
        live_task(request, None, self._settings().max_request_size)
        load_from(request.external_wrench, None)
        self._inputs.set_task(request)
        response.result = status_result(Status.OPTIMAL)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The managed node: parameters, subscriptions, services and publishers, wired to the live loop.

Everything is created at once and answers in every lifecycle state, so that a client never waits
for a service that is not there; only an active node computes. Subscriptions store the newest
message; those of contacts, task and load then evaluate once. Runs in a single-threaded executor.
"""

import functools
import gc
import os

from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality import node_parameters as parameters
from grasp_quality.node_diagnostics import Monitor, PERIOD_S
from grasp_quality.node_guards import guard_services
from grasp_quality.node_holding import HoldingForces
from grasp_quality.node_inputs import Inputs
from grasp_quality.node_live import LiveLoop
from grasp_quality.node_margin import MarginTopic
from grasp_quality.node_markers import Display
from grasp_quality.node_outputs import Outputs
from grasp_quality.node_security import unsecured_reason
from grasp_quality.node_services import Services
from grasp_quality.node_settings import SOURCES
from grasp_quality.warm_up import warm_up
from grasp_quality_msgs.msg import ContactArray
from msg_adapters import qos
from msg_adapters.errors import NotActiveError
from msg_adapters.results import error_result
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import Header

WATCH_SHARE = 0.25  # of the shortest age between two looks of the watchdog
FLUSH_S = 0.5       # longest wait for subscribers to have the last word


class GraspQualityNode(LifecycleNode):
    """
    Tells how much of a task wrench the present grasp can apply; see docs for its interface.

    Raises
    ------
    ValueError
        When a parameter override breaks a rule.

    """

    def __init__(self, **kwargs):
        super().__init__('grasp_quality', **kwargs)
        self.active = False
        self.settings = parameters.declare(self)
        current = lambda: self.settings  # noqa: E731  (settings are replaced, never changed)
        self._monitor = Monitor(self)
        self._inputs = Inputs(current, lambda: self.get_clock().now().nanoseconds)
        self._inputs.set_task_wrench(self.settings.task_wrench)
        self._listen_to_transforms()
        self._outputs = Outputs(self)
        self._outputs.declare_wrenches(self.settings.contact_names)
        self._display = Display(self, current)
        self._margin = MarginTopic(self._outputs.margin, current)
        self._live = LiveLoop(
            self._inputs, self._outputs, current, self._monitor, self._display, self._margin,
            HoldingForces(self.get_logger()), lambda: self.get_clock().now().to_msg())
        self._handlers = Services(self, self._inputs, current, lambda: self.active)
        self._subscribe()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._watchdog = self.create_timer(
            WATCH_SHARE * self.settings.shortest_age, self._guarded(self._on_watch),
            clock=steady)
        self.create_timer(
            1.0 / self.settings.marker_rate, self._guarded(self._display.draw), clock=steady)
        self.create_timer(PERIOD_S, self._guarded(self._report), clock=steady)
        self.add_on_set_parameters_callback(
            lambda changes: parameters.check(self.settings, changes))
        self.add_post_set_parameters_callback(self._guarded(self._on_parameters))
        guard_services(self)
        self._unknown = parameters.unknown_overrides(self)
        for text in self._unknown:
            self.get_logger().warning(text)

    def _listen_to_transforms(self):
        try:
            import tf2_ros
        except ImportError:  # not on PyPI; messages must then come in the object frame
            return
        self._inputs.tf_buffer = tf2_ros.Buffer()
        self._tf_listener = tf2_ros.TransformListener(self._inputs.tf_buffer, self)

    def _subscribe(self):
        def subscribe(message_type, topic, receive, profile):
            self.create_subscription(
                message_type, topic, receive, profile,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False))

        def sample(receive):
            receive = self._guarded(receive)
            return lambda message, info: receive(message, info['source_timestamp'])

        def then_evaluate(keep):
            def receive(*message):
                keep(*message)
                self._evaluate()
            return receive

        # what is ready runs in this order: contacts find all else of their instant received
        inputs, sensor, command = self._inputs, qos.newest_sample(), qos.newest_command()
        for name in self.settings.contact_names:
            subscribe(WrenchStamped, f'~/contact_wrenches/{name}',
                      sample(functools.partial(inputs.store_wrench, name)), sensor)
        subscribe(WrenchStamped, '~/task_wrench',
                  self._guarded(then_evaluate(inputs.store_task_wrench)), command)
        subscribe(WrenchStamped, '~/external_wrench',
                  sample(then_evaluate(inputs.store_load)), command)
        source = self.settings.contact_source
        subscribe(PoseArray if source == 'pose_array' else ContactArray, SOURCES[source],
                  sample(then_evaluate(inputs.store_contacts)), sensor)

    def _guarded(self, callback):
        """Keep every exception inside the callback it came from."""
        @functools.wraps(callback, assigned=())
        def run(*args):
            try:
                return callback(*args)
            except Exception as exc:
                self.get_logger().error(
                    f'internal error, please report it: {type(exc).__name__}: {exc}',
                    throttle_duration_sec=1.0)
        return run

    def _evaluate(self):
        if self.active:
            self._live.evaluate()

    def _on_watch(self):
        if self.active:
            self._live.watch()

    def _report(self):
        """Report once a second; who publishes contacts elsewhere is looked up while none come."""
        elsewhere = self._elsewhere() if self._inputs.contacts is None else ''
        if elsewhere and elsewhere != self._inputs.elsewhere:
            self.get_logger().warning(f'no contacts received yet{elsewhere}')
        self._inputs.elsewhere = elsewhere
        self._monitor.report(self._inputs.problems, (
            *self._unknown, *self._inputs.doubts(), *self._outputs.rivals()))

    def _elsewhere(self):
        own = self.settings.contact_source
        other, = SOURCES.keys() - {own}
        here, there = (self.count_publishers(self.resolve_topic_name(SOURCES[source]))
                       for source in (own, other))
        if here or not there:
            return ''
        return (f'; nobody publishes there, but somebody on {SOURCES[other]}: to listen there, '
                f'start the node with contact_source {other}')

    def set_parameters_atomically(self, parameter_list):
        """Refuse unknown names by name, which rclpy 7.1 loses on the way to its answer."""
        unknown = [p.name for p in parameter_list if not self.has_parameter(p.name)]
        if unknown:
            return SetParametersResult(
                successful=False, reason=f'there are no parameters of these names: {unknown}')
        return super().set_parameters_atomically(parameter_list)

    def _on_parameters(self, changes):
        self.settings = parameters.changed(self.settings, changes)
        names = [change.name for change in changes]
        if 'task_wrench' in names:
            self._inputs.set_task_wrench(self.settings.task_wrench)
        if not {'max_contact_age', 'max_load_age'}.isdisjoint(names):
            self._watchdog.timer_period_ns = int(1e9 * WATCH_SHARE * self.settings.shortest_age)
            self._watchdog.reset()  # else it sleeps on for one old period; _evaluate looks now
        if any(name in parameters.TABLE for name in names):
            self._evaluate()

    def on_configure(self, state):
        """Warm up: the first query after activation shall be as fast as the thousandth."""
        warm_up(self.settings.force_bound)
        # what is there now stays: to look through it again would stop the live loop for 0.1 s
        gc.collect()
        gc.freeze()
        return super().on_configure(state)

    def on_activate(self, state):
        """Begin to compute and to publish, unless security that was asked for is missing."""
        unsecured = unsecured_reason(os.environ)
        if unsecured and not self.settings.allow_unsecured:
            self.get_logger().error(unsecured)
            return TransitionCallbackReturn.FAILURE
        if unsecured:
            self.get_logger().warning(f'allow_unsecured is set: {unsecured}')
        result = super().on_activate(state)
        self.active = result == TransitionCallbackReturn.SUCCESS
        return result

    def on_deactivate(self, state):
        """Say that nothing published before holds any longer, then fall silent."""
        self.silence('the node was deactivated')
        return super().on_deactivate(state)

    def on_shutdown(self, state):
        """Say that nothing published before holds any longer, and end."""
        self.silence('the node was shut down')
        return super().on_shutdown(state)

    def silence(self, reason):
        """Publish NOT_ACTIVE with empty forces, see it delivered, and stop computing."""
        was_active, self.active = self.active, False
        self._inputs.clear()
        self._live.forget()
        self._monitor.forget()
        if was_active:
            stamp = self.get_clock().now().to_msg()
            result = error_result(NotActiveError(reason))
            self._outputs.publish_failure(result, stamp)
            self._display.clear(Header(stamp=stamp))
            self._margin.fail(result, Header(stamp=stamp))
            self._outputs.flush(FLUSH_S, self._display.publishers)

    def on_error(self, state):
        """Compute nothing after a transition that went wrong."""
        self.active = False
        return super().on_error(state)

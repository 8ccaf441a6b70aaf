# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Diagnostics: what the live loop did since the last report, on /diagnostics."""

import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from grasp_quality.node_log import Changes
from grasp_quality_msgs.msg import ResultCode
from msg_adapters.results import code_name
from msg_adapters.stamps import seconds

PERIOD_S = 1.0
FAULTS = (ResultCode.SOLVER_FAILED, ResultCode.TIMED_OUT, ResultCode.TRANSFORM_FAILED)


class Monitor:
    """Counts answers and failures, logs changes of the result code, and reports them."""

    def __init__(self, node):
        self._node = node
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', 10)
        self._result = ResultCode()
        self._changes = Changes(self._say)
        self._since = time.monotonic()
        self._answers = self._failures = 0
        self._slowest_s = self._oldest_s = 0.0
        self._values = {}
        self._lowest_margin = None  # measured, since the last report

    def note_margin(self, margin):
        """Note the smallest measured slip margin of a sample, or None."""
        if margin is not None:
            self._lowest_margin = min(margin, 1.0 if self._lowest_margin is None
                                      else self._lowest_margin)

    def count(self, quality):
        """Note an answer of the live loop."""
        self._answers += 1
        self._slowest_s = max(self._slowest_s, seconds(quality.solve_time))
        self._oldest_s = max(self._oldest_s, seconds(quality.contact_age))
        self._values = {'alpha': f'{quality.alpha:.6g}',
                        'friction margin': f'{quality.friction_margin:.4g}',
                        'measured slip margin': f'{quality.measured_slip_margin:.4g}'
                        if quality.slip_measured else 'not measured',
                        'limiting contact': quality.limiting_contact}
        if quality.quantile_computed:
            self._values['alpha quantile'] = f'{quality.alpha_quantile:.6g}'
        self._note(quality.result)

    def count_failure(self, result, error):
        """Note a failure of the live loop."""
        self._failures += 1
        self._values = {}
        self._note(result)
        if result.message.startswith('internal error'):
            self._node.get_logger().error(
                f'{type(error).__name__}: {error}', throttle_duration_sec=1.0)

    def _note(self, result):
        self._changes.note(result.code, result.message or 'live answers are optimal')
        self._result = result

    def _say(self, code, words):
        logger, text = self._node.get_logger(), f'{code_name(code)}: {words}'
        if code == ResultCode.OPTIMAL:
            logger.info(text)
        else:
            logger.warning(text)

    def forget(self):
        """Log nothing more of what was so: the node falls silent."""
        self._changes.forget()

    def report(self, problems=(), doubts=()):
        """Publish, start counting anew; sentences on ignored inputs, and of what to be warned."""
        self._changes.end_period()
        now = time.monotonic()
        elapsed = max(now - self._since, 1e-9)
        values = {
            'result': code_name(self._result.code),
            'lifecycle': 'active' if self._node.active else 'not active',
            'answers per second': f'{self._answers / elapsed:.1f}',
            'failures per second': f'{self._failures / elapsed:.1f}',
            'longest solve time [ms]': f'{1e3 * self._slowest_s:.3f}',
            'oldest contacts [ms]': f'{1e3 * self._oldest_s:.3f}',
            **self._values}
        slipping = self._warned_margin()
        if slipping:
            values['lowest measured slip margin'] = f'{self._lowest_margin:.4g}'
        for i, problem in enumerate(problems):
            values[f'ignored input {i}'] = problem
        for i, doubt in enumerate(doubts):
            values[f'warning {i}'] = doubt
        status = DiagnosticStatus(
            level=self._level(problems or slipping or doubts),
            name=f'{self._node.get_name()}: live loop',
            message='; '.join(filter(None, [
                self._result.message or code_name(self._result.code),
                f'{len(problems)} measured wrenches ignored' if problems else '', slipping,
                *doubts])),
            hardware_id=self._node.get_fully_qualified_name(),
            values=[KeyValue(key=key, value=value) for key, value in values.items()])
        message = DiagnosticArray(status=[status])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)
        self._since, self._answers, self._failures = now, 0, 0
        self._slowest_s = self._oldest_s = 0.0
        self._lowest_margin = None

    def _warned_margin(self):
        limit = self._node.settings.margin_warning
        if self._lowest_margin is None or self._lowest_margin >= limit:
            return ''
        return (f'measured slip margin {self._lowest_margin:.3g} is below margin_warning '
                f'{limit:g}')

    def _level(self, warned):
        if not self._node.active:
            return DiagnosticStatus.WARN
        if self._result.code in FAULTS:
            return DiagnosticStatus.ERROR
        if self._result.code != ResultCode.OPTIMAL or warned:
            return DiagnosticStatus.WARN
        return DiagnosticStatus.OK

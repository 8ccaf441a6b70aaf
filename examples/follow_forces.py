# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Follow the holding forces of the live loop as a controller must: safe whenever they do not hold.

With a node running that has a task and gets contacts (make demo DEMO_FLAGS=--keep), after
. ./env.sh:

    python3 examples/follow_forces.py

``holding_forces`` balance the load, topic ``external_wrench``, with the largest margin to the
friction cones and the caps. They hold while they are not empty and the contacts behind them are
not old. Any failure of the node empties them, its silence makes them old, and so does a sensor
that stops: one rule for all.

To apply a task on top of holding, ``level`` times: publish load - level * task as
``external_wrench``; alpha then says how much of the task is possible beyond that. No share of
``contact_forces`` does this: they apply alpha times the task, the most that the hand can, and
divided by alpha they do not carry the load.

"""

import signal

from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time


class FollowForces(Node):
    """Decides 100 times a second between the newest forces and safety."""

    def __init__(self):
        super().__init__('follow_forces')
        self._max_age_s = self.declare_parameter('max_age', 0.1).value
        self._array, self._quality, self._told = ContactForceArray(), GraspQuality(), ''
        self.create_subscription(
            ContactForceArray, 'grasp_quality/holding_forces', self._store_forces, 1)
        self.create_subscription(GraspQuality, 'grasp_quality/quality', self._store_result, 1)
        self.create_timer(0.01, self._control)

    def _store_forces(self, message):
        self._array = message

    def _store_result(self, message):
        self._quality = message

    def _control(self):
        age = self.get_clock().now() - Time.from_msg(self._array.header.stamp)
        result = self._quality.result
        if result.code != ResultCode.OPTIMAL:
            self._tell('safe', result.message or 'nothing was heard of the node')
        elif not self._array.forces:
            self._tell('safe', 'there are no holding forces')
        elif abs(age.nanoseconds) > 1e9 * self._max_age_s:
            self._tell('safe', f'the contacts are {1e-9 * age.nanoseconds:.2f} s old')
        else:  # here a controller takes tau = J^T f + gravity of the fingers, f as they are
            self._tell('follow', ', '.join(item.name for item in self._array.forces))

    def _tell(self, mode, why):
        if mode != self._told:
            print(f'{mode}: {why}', flush=True)
        self._told = mode


stopping = []
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda *_: stopping.append(True))
# rclpy's own handlers would end the context in the middle of a message
rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
node = FollowForces()
while not stopping:
    rclpy.spin_once(node, timeout_sec=0.1)

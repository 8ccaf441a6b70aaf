# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The faults of ``soak``: each puts everything back, and then the node has to answer again.

Nobody restarts the node for that; where it is killed itself, that is the fault. It is stopped only
while it is at rest: between the last look at the clock and the write of a message there is no
instant at which a stopped process could notice.
"""

from collections import Counter
import math
import signal
import time

from benchmarks.witness import SENSOR
from geometry_msgs.msg import PoseArray
from grasps import EIGHT, pose_array
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
import numpy as np
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter
from rig import kill

GOOD = ({'friction_coefficient': 0.4}, {'max_normal_force': 8.0, 'force_bound': 'l1'},
        {'contact_model': 'SFCE'}, {'solver_time_limit': 0.5}, {'alpha_reserve': 0.05})
BAD = ({'friction_coefficient': math.nan}, {'friction_coefficient': 1.0, 'force_bound': 'l3'},
       {'max_normal_force': 0.0}, {'contact_names': ['a']}, {'max_contact_age': 'soon'})
USUAL = {'friction_coefficient': 0.5, 'max_normal_force': 10.0, 'force_bound': 'linf',
         'contact_model': 'PCWF', 'solver_time_limit': 1.0, 'alpha_reserve': 0.0}


def _name(fault):
    return fault.__name__.replace('_', ' ')


class Faults:
    """Draws faults from a seed; ``done`` counts them, ``broken`` holds what went wrong."""

    def __init__(self, soak, seed, may_restart):
        self._soak = soak
        self._draw = np.random.default_rng(seed)
        self._may_restart = may_restart
        self._kinds = (
            self.publisher_killed, self.publisher_twice, self.frozen_stamps, self.bad_messages,
            self.client_killed, self.parameters_changed, self.lifecycle_cycle, self.pause)
        self._left = []
        self.done = Counter()
        self.broken = []

    def one(self):
        """Do what is next of a shuffled deck of all faults, and wait for an answer after it."""
        if not self._left:
            self._left = [self._kinds[i] for i in self._draw.permutation(len(self._kinds))]
            if self._may_restart():
                self._left.append(self.node_killed)  # first
        fault = self._left.pop()
        self.done[_name(fault)] += 1
        fault()
        witness, after_ns = self._soak.witness, time.time_ns()
        try:
            witness.until(
                lambda: witness.answers and witness.answers[-1][0] > after_ns, 'an answer')
        except AssertionError:
            self.broken.append(f'no answer after {fault.__name__}')

    @property
    def each_has_been(self):
        """Whether every kind of fault has been, so that nothing is new to the node any more."""
        return all(self.done[_name(kind)] for kind in self._kinds)

    def _seconds(self, least, most):
        return float(self._draw.uniform(least, most))

    def publisher_killed(self):
        """Kill the publisher; another comes."""
        kill(self._soak.feed)
        self._soak.watch(self._seconds(0.05, 0.5))
        self._soak.feed = self._soak.new_feed()

    def publisher_twice(self):
        """Let a second publisher say other contacts, a little behind or ahead."""
        second = self._soak.new_feed('--grasp', 'CIRCLE', '--stamps',
                                     f'{self._seconds(-0.02, 0.02):.4f}')
        self._soak.watch(self._seconds(0.5, 2.0))
        kill(second)

    def frozen_stamps(self):
        """Repeat one stamp for a while; then another publisher comes."""
        self._soak.feed.popen.send_signal(signal.SIGUSR1)
        self._soak.watch(self._seconds(0.3, 1.0))
        kill(self._soak.feed)
        self._soak.feed = self._soak.new_feed()

    def bad_messages(self):
        """Publish what cannot be used between good samples."""
        client = self._soak.witness.client
        publisher = client.publisher(PoseArray, 'contact_poses', SENSOR)
        for _ in range(50):
            message = pose_array(EIGHT, client.now())
            spoilt = message.poses[self._draw.integers(len(EIGHT))]
            kind = self._draw.integers(4)
            if kind == 0:
                spoilt.position.x = float(self._draw.choice([math.nan, math.inf, 1e300]))
            elif kind == 1:
                spoilt.orientation.w += 0.5
            elif kind == 2:
                message.header.frame_id = ''
            else:
                message.poses = []
            publisher.publish(message)
            self._soak.watch(0.01)

    def client_killed(self):
        """Kill clients in the middle of their calls; others come."""
        which = self._draw.integers(len(self._soak.callers))
        kill(self._soak.callers[which])
        self._soak.callers[which] = self._soak.new_callers()

    def parameters_changed(self):
        """Change parameters twenty times, well and badly, and put them back."""
        for _ in range(20):
            is_good = bool(self._draw.integers(2))
            some = (GOOD if is_good else BAD)[self._draw.integers(len(GOOD))]
            if self._set(some) != is_good:
                self.broken.append(f'{some} was not {"taken" if is_good else "refused"}')
        self._set(USUAL)

    def _set(self, changes):
        return self._soak.witness.client.call(
            SetParametersAtomically, 'set_parameters_atomically', parameters=[
                Parameter(name, value=value).to_parameter_msg()
                for name, value in changes.items()]).result.successful

    def lifecycle_cycle(self):
        """Deactivate, perhaps clean up, and come back."""
        there = [Transition.TRANSITION_DEACTIVATE]
        back = [Transition.TRANSITION_ACTIVATE]
        if self._draw.integers(2):
            there.append(Transition.TRANSITION_CLEANUP)
            back.insert(0, Transition.TRANSITION_CONFIGURE)
        for transition in [*there, *back]:
            if not self._soak.witness.client.call(
                    ChangeState, 'change_state', transition=Transition(id=transition)).success:
                self.broken.append(f'transition {transition} was refused')
            self._soak.watch(self._seconds(0.0, 0.3))

    def pause(self):
        """Stop the node for longer than contacts are fresh, while they go on."""
        soak = self._soak
        soak.feed.popen.send_signal(signal.SIGSTOP)
        soak.witness.until(
            lambda: soak.witness.newest_is_answered() or self._failed_lately(),
            'the newest sample to be answered')
        soak.node.popen.send_signal(signal.SIGSTOP)
        soak.feed.popen.send_signal(signal.SIGCONT)
        soak.watch(self._seconds(0.15, 1.0))
        soak.node.popen.send_signal(signal.SIGCONT)

    def _failed_lately(self):
        failures = self._soak.witness.failures
        return bool(failures) and failures[-1][1] > next(reversed(
            self._soak.witness.samples.values()), 0)

    def node_killed(self):
        """Kill the node and start it again."""
        kill(self._soak.node)
        self._soak.node = self._soak.new_node()

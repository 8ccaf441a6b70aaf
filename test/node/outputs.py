# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""All output topics of a node, heard together: an answer with its parts, or a failure."""

from types import SimpleNamespace

from geometry_msgs.msg import WrenchStamped
from grasp_quality_msgs.msg import ContactForceArray, GraspQuality, ResultCode
from grasps import numbers
from msg_adapters.stamps import stamp_ns
from std_msgs.msg import Float64


def _by_stamp(messages):
    """Return messages by their stamp [ns], of one stamp the last."""
    return {stamp_ns(m.header.stamp): m for m in messages}


class Outputs:
    """Subscriptions to alpha, quality, contact_forces and optimal_wrenches of some names."""

    def __init__(self, client, names=(), feed=None):
        self._client = client
        self.quality = client.listen(GraspQuality, 'quality')
        self.forces = client.listen(ContactForceArray, 'contact_forces')
        self.alpha = client.listen(Float64, 'alpha')
        self.wrenches = {
            name: client.listen(WrenchStamped, f'optimal_wrenches/{name}', feed) for name in names}

    def forget(self):
        """Drop what was heard until now."""
        for heard in (self.quality, self.forces, self.alpha, *self.wrenches.values()):
            heard.clear()

    def answer(self, feed, condition=lambda quality: True, names=None):
        """
        Feed contacts until they have an OPTIMAL answer; return its parts, joined by stamp.

        ``names`` are those of the contacts that must have forces: measurements of an instant may
        arrive after its poses.

        """
        self.forget()
        begin = stamp_ns(self._client.now())
        found = self._client.until(
            lambda: self._complete(begin, condition, names), 'an OPTIMAL answer', feed)
        self._client.until(
            lambda: any(m.data == found.quality.alpha for m in self.alpha), 'its alpha', feed)
        return found

    def failure(self, code, feed=None):
        """Wait for the code on ~/quality, check all topics for the failure contract."""
        self.forget()
        quality = self._client.until(
            lambda: next((m for m in self.quality if m.result.code == code), None),
            f'result code {code}, after {self._last()}', feed)
        self._client.until(self._withdrawn, 'zero and nothing on all topics', feed)
        assert quality.result.message
        assert (quality.alpha, quality.alpha_upper, quality.alpha_lower) == (0.0, 0.0, 0.0)
        assert not quality.holdable and quality.friction_margin == 0.0
        assert quality.limiting_contact == ''
        return quality

    def _last(self):
        return self.quality[-1].result if self.quality else 'silence'

    def _complete(self, begin, condition, names):
        fitting = [m for m in self.quality if m.result.code == ResultCode.OPTIMAL
                   and stamp_ns(m.header.stamp) >= begin and condition(m)]
        if not fitting:
            return None
        forces = _by_stamp(m for m in self.forces if m.forces)
        wrenches = {name: _by_stamp(heard) for name, heard in self.wrenches.items()}
        for quality in fitting:
            stamp = stamp_ns(quality.header.stamp)
            if stamp not in forces or (
                    names and [item.name for item in forces[stamp].forces] != names):
                continue
            if all(stamp in heard for heard in wrenches.values()):
                return SimpleNamespace(quality=quality, forces=forces[stamp], wrenches={
                    name: heard[stamp] for name, heard in wrenches.items()})
        return None

    def _withdrawn(self):
        return (
            self.forces and not self.forces[-1].forces and self.alpha
            and self.alpha[-1].data == 0.0
            and all(heard and not numbers(heard[-1].wrench).any()
                    for heard in self.wrenches.values()))

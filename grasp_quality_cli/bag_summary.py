# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What a replay amounts to, kept in a fixed amount of memory: counts, extremes and curves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any

from grasp_quality_cli.bag_answers import Answered
from grasp_quality_cli.bag_trace import Trace
from msg_adapters.result_codes import Code

DRAWN_CONTACTS = 10


class Summary:
    """
    Takes answers in the order of time.

    Attributes
    ----------
    codes : Counter of str
    reasons : dict
        Code: words of its first answer that is not OPTIMAL.
    alpha, friction_margin, measured_margin : Trace
    normals, measured_normals : dict of str to Trace
        Normal force of the first contacts [N].
    first_ns, last_ns : int or None

    """

    def __init__(self) -> None:
        self.codes: Counter[str] = Counter()
        self.reasons: dict[str, str] = {}
        self.alpha, self.friction_margin, self.measured_margin = Trace(), Trace(), Trace()
        self.normals: dict[str, Trace] = {}
        self.measured_normals: dict[str, Trace] = {}
        self.left_out: set[str] = set()
        self.first_ns: int | None = None
        self.last_ns: int | None = None

    def add(self, batch: Iterable[Answered]) -> None:
        """Take answers."""
        for row in batch:
            time_ns = row.sample.time_ns
            self.first_ns = time_ns if self.first_ns is None else self.first_ns
            self.last_ns = time_ns
            self.codes[row.code.name] += 1
            if row.code is not Code.OPTIMAL:
                self.reasons.setdefault(row.code.name, row.message)
            self.alpha.add(time_ns, row.alpha)
            if row.code is Code.OPTIMAL:
                self.friction_margin.add(time_ns, row.friction_margin)
            if row.measured_margin is not None:
                self.measured_margin.add(time_ns, row.measured_margin)
            self._add_forces(row)

    def _add_forces(self, row: Answered) -> None:
        scene = row.sample.scene
        if scene is None:
            return
        for i, name in enumerate(scene.grasp.names):
            if name not in self.normals:
                if len(self.normals) == DRAWN_CONTACTS:
                    if len(self.left_out) < 1000:
                        self.left_out.add(name)
                    continue
                self.normals[name], self.measured_normals[name] = Trace(), Trace()
            if len(row.forces):
                self.normals[name].add(row.sample.time_ns, float(row.forces[i, 2]))
            measured = scene.forces[i]
            if measured is not None:
                self.measured_normals[name].add(row.sample.time_ns, float(measured[2]))

    @property
    def samples(self) -> int:
        """How many contact samples there were."""
        return sum(self.codes.values())

    def row(self) -> dict[str, Any]:
        """Return the numbers for JSON."""
        bins = self.alpha.bins
        return {
            'samples': self.samples, 'codes': dict(self.codes), 'reasons': self.reasons,
            'first_ns': self.first_ns, 'last_ns': self.last_ns,
            'alpha_min': min((b[2] for b in bins), default=None),
            'alpha_max': max((b[3] for b in bins), default=None),
            'measured_slip_margin_min': min(
                (b[2] for b in self.measured_margin.bins), default=None)}

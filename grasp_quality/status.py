# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What every answer can be asked: whether there are forces, and how far they are from slip."""

import enum

from grasp_quality.arrays import Array


class Status(enum.Enum):
    """Outcome of a measure."""

    OPTIMAL = 'optimal'
    OPTIMAL_NO_INTERIOR = 'optimal, but without friction margin: no strictly interior force exists'
    INFEASIBLE = 'infeasible'


class Answer:
    """An answer with a status."""

    status: Status

    @property
    def feasible(self) -> bool:
        """Whether there are forces: any status but INFEASIBLE."""
        return self.status is not Status.INFEASIBLE


class ForceAnswer(Answer):
    """An answer with one set of contact forces, and the use (k,) of each friction cone."""

    cone_usage: Array

    @property
    def friction_margin(self) -> float:
        """1 minus the largest cone usage; 0 when infeasible."""
        return 1.0 - float(self.cone_usage.max()) if self.feasible else 0.0

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What every answer can be asked: whether there are forces, and how far they are from slip."""

from __future__ import annotations

import dataclasses
import enum
from typing import Any, TYPE_CHECKING

from grasp_quality.arrays import Array

if TYPE_CHECKING:
    from _typeshed import DataclassInstance


class Status(enum.Enum):
    """Outcome of a measure."""

    OPTIMAL = 'optimal'
    OPTIMAL_NO_INTERIOR = 'optimal, but without friction margin: no strictly interior force exists'
    INFEASIBLE = 'infeasible'


class OneLine:
    """A dataclass that ``print`` shows in one line; ``repr`` has its arrays and its grasp too."""

    def __str__(self: DataclassInstance) -> str:
        """State the name, the status and the single numbers."""
        single = ((field.name, getattr(self, field.name)) for field in dataclasses.fields(self))
        told = ', '.join(f'{name}={_told(value)}' for name, value in single
                         if isinstance(value, (Status, bool, int, float)))
        return f'{type(self).__name__}({told}, ...)'


def _told(value: Any) -> str:
    if isinstance(value, Status):
        return value.name
    return f'{value:.6g}' if isinstance(value, float) else str(value)


class Answer(OneLine):
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

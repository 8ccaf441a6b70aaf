# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""One deadline for a whole question, however many solves it takes."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from grasp_quality.arrays import checked_number
from grasp_quality.exceptions import InvalidTaskError, SolverTimeoutError

if TYPE_CHECKING:
    from grasp_quality.problem import ConicProblem


class TimeLimit:
    """
    A deadline on the steady clock.

    Parameters
    ----------
    seconds : float
        From now [s].
    way_out : str
        End of the sentence when it is over.

    """

    def __init__(self, seconds: float, way_out: str = 'raise it or ask for less') -> None:
        self._seconds, self._way_out = seconds, way_out
        self._end = time.monotonic() + seconds

    @classmethod
    def of(cls, limit: Limit) -> TimeLimit | None:
        """
        Return a TimeLimit of a number of seconds; None and a running TimeLimit stay.

        Raises
        ------
        InvalidTaskError
            When it is no finite number.

        """
        if limit is None or isinstance(limit, TimeLimit):
            return limit
        return cls(checked_number(limit, 'time_limit_s', InvalidTaskError))

    @property
    def is_over(self) -> bool:
        """Whether nothing is left."""
        return time.monotonic() >= self._end

    def remaining_s(self, problem: ConicProblem | None = None) -> float:
        """
        Return what is left [s], more than 0.

        Raises
        ------
        SolverTimeoutError
            When nothing is left; it carries the problem.

        """
        left = self._end - time.monotonic()
        if left <= 0.0:
            raise SolverTimeoutError(
                f'the time limit of {self._seconds:g} s is over: {self._way_out}',
                problem, 'MaxTime')
        return left


Limit = TimeLimit | float | None  # how a question's time limit may be given [s]

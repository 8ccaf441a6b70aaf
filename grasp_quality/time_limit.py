# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""One deadline for a whole question, however many solves it takes."""

import time

from grasp_quality.exceptions import SolverTimeoutError


class TimeLimit:
    """
    A deadline on the steady clock.

    Parameters
    ----------
    seconds : float
        From now [s].

    """

    def __init__(self, seconds):
        self._seconds = seconds
        self._end = time.monotonic() + seconds

    @classmethod
    def of(cls, limit):
        """Return a TimeLimit of a number of seconds; None and a running TimeLimit stay."""
        return limit if limit is None or isinstance(limit, cls) else cls(float(limit))

    @property
    def is_over(self):
        """Whether nothing is left."""
        return time.monotonic() >= self._end

    def remaining_s(self, problem=None):
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
                f'the time limit of {self._seconds:g} s is over: raise it or ask for less',
                problem, 'MaxTime')
        return left

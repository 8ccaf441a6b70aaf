# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Errors of the core library; every one derives from GraspQualityError.

Input errors are ValueErrors too, so that callers who do not know this library catch them by habit.
Each message names the value, the rule that it breaks and the way out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grasp_quality.problem import ConicProblem


class GraspQualityError(Exception):
    """Base of everything that this library raises on purpose."""


class InvalidContactError(GraspQualityError, ValueError):
    """A contact's geometry or parameters break a rule."""


class InvalidGraspError(GraspQualityError, ValueError):
    """A set of contacts, or its force bound, breaks a rule."""


class InvalidTaskError(GraspQualityError, ValueError):
    """A task, or an argument of a measure, breaks a rule."""


class SolverError(GraspQualityError, RuntimeError):
    """
    The solver gave no answer that its own proof confirms.

    ``problem`` is the ConicProblem that failed, ``status`` the solver's own word for what
    happened.

    """

    def __init__(self, message: str, problem: ConicProblem | None = None,
                 status: str = '') -> None:
        super().__init__(message)
        self.problem = problem
        self.status = status


class SolverTimeoutError(SolverError):
    """The solver ran into its time limit before its answer was proved."""

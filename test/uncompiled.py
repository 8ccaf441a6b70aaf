# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A pytest plugin for scripts/coverage.sh: what can run as plain Python is left as that.

Machine code cannot be traced. The judge, the search for the largest ball and the scaling are
ordinary Python that numba compiles; the kernel is not (its numbers are vector registers).
"""

from collections.abc import Callable
from typing import Any

import numba

PLAIN = {f'grasp_quality.{name}' for name in ('ball_search', 'judge', 'scaled')}
compiled = numba.njit


def njit(*functions: Any, **options: Any) -> Any:
    """Compile a function, unless it is one of those to be traced."""
    def decorate(function: Callable[..., Any]) -> Any:
        return function if function.__module__ in PLAIN else compiled(**options)(function)

    return compiled(*functions, **options) if functions else decorate


numba.njit = njit

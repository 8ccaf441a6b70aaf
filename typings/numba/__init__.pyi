# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
# numba has no stubs: what mypy has to know of it. Compiled functions are called as written.

from collections.abc import Callable
from typing import Any, TypeVar

_Function = TypeVar('_Function', bound=Callable[..., Any])

def njit(**options: Any) -> Callable[[_Function], _Function]: ...

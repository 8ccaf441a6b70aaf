# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Exit codes, and JSON as it is printed."""

from __future__ import annotations

from collections.abc import Mapping
import json
import math
from typing import Any

INFEASIBLE = 1  # answered, and the answer is no
READ_IN_PART = 1  # a bag or a dataset has parts that could not be read
WRONG_INPUT = 2  # as for a wrong option
NOT_SOLVED = 3
STOPPED = 4  # a study before its end

EPILOG = (
    'Exit codes: 0 answered; 1 infeasible, or a bag or dataset that could be read in part only; '
    '2 wrong input, with file and line; 3 no answer could be proved; 4 a study stopped before its '
    'end, to go on with the same command.')


def print_json(row: Mapping[str, Any]) -> None:
    """Print one JSON object on standard output; numbers that JSON does not know become null."""
    print(json.dumps(plain(row), indent=2))


def plain(value: Any) -> Any:
    """Replace what JSON does not know (inf, nan) by None."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value

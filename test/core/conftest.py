# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The core's tests: every warning is an error, and the benchmarks' problems can be imported."""

from pathlib import Path
import sys

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))


def pytest_collection_modifyitems(items):
    """Turn warnings into errors for the tests of this folder."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents:
            item.add_marker(pytest.mark.filterwarnings('error'), append=False)

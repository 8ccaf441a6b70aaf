# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The examples run against a real node, with what the tests of the node are made of."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parents[1] / 'node'))

from node_fixtures import ros_log_dir, start  # noqa: E402, F401

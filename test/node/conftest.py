# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A node process for each module of tests, and a client for it."""

from node_fixtures import ros_log_dir, start  # noqa: F401

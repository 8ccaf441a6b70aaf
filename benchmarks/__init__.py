# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of docs/performance.md; run as ``python -m benchmarks``."""

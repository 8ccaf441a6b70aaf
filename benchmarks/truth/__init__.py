# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Prediction against physics, docs/truth.md; run as ``python -m benchmarks.truth``."""

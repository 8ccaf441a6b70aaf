# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What counts as equal, in one place; relative to the larger of the values and one."""

EXACT = 1e-12        # the same arithmetic in another order
CLOSED_FORM = 1e-9   # formulas against formulas, and what is centred to the last digit
SOLVER = 1e-6        # what the proof of an answer promises

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages are spoilt, read and answered by the code of the node; an independent check judges.

``cases`` makes a question from a seed, ``spoiling`` changes some of its fields, ``asking`` puts
it to the node's own code, ``refusals`` tells what has to be refused, ``judging`` whether the
answer is true, ``crosschecks`` what another solver says. ``python -m benchmarks.fuzz`` runs all.
"""

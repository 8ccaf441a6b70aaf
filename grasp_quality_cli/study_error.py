# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Errors of a study; each text says what to do."""

from grasp_quality.exceptions import GraspQualityError


class StudyError(GraspQualityError):
    """A study cannot begin."""


class StoppedError(StudyError):
    """A study stopped before its end; what is done is kept."""

    def __init__(self, reason: str) -> None:
        super().__init__(f'{reason}; what is done is kept: the same command goes on from there')

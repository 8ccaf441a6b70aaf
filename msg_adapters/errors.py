# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Errors of reading messages; each stands for one result code."""

from grasp_quality.exceptions import GraspQualityError


class InvalidMessageError(GraspQualityError, ValueError):
    """A field of a message breaks a rule; the text names the field, the value and the rule."""


class TransformError(GraspQualityError, LookupError):
    """A frame cannot be brought into the object frame."""


class NoContactsError(GraspQualityError):
    """There are no contacts to evaluate."""


class StaleContactsError(GraspQualityError):
    """What is to be answered for, contacts or load, is too old, from the future, or replaced."""


class NotActiveError(GraspQualityError):
    """The lifecycle node is not active."""

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Subscriptions of the audit that are read in its own time."""

from typing import Any

from rclpy.callback_groups import CallbackGroup


class ByHand(CallbackGroup):
    """
    Subscriptions that no executor looks at.

    Thousands of messages a second, each by itself through an executor, would take a core; taken
    together before they are judged they take an eighth of that.

    """

    def can_execute(self, entity: Any) -> bool:
        """Leave everything alone."""
        return False

    def beginning_execution(self, entity: Any) -> bool:
        """Leave everything alone."""
        return False

    def ending_execution(self, entity: Any) -> None:
        """Leave everything alone."""

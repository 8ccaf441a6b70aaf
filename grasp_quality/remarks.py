# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What has to be said beside an alpha that is no measure of strength, for whoever shows it."""

ZERO = "0 (to the solver's accuracy)"
UNREACHABLE = 'the contacts cannot produce the task wrench at all'
PINNED = f'alpha is pinned: {UNREACHABLE}, the external wrench alone decides alpha'
PINNED_TO_ZERO = f'alpha is pinned to {ZERO}: {UNREACHABLE}'
POWERLESS = (f'alpha is {ZERO}: no contact forces inside the friction cones and the force bound '
             'apply any of the task')


def remark(pinned: bool, powerless: bool) -> str:
    """Say why alpha is pinned, or zero; '' where it means what it says."""
    if pinned:
        return PINNED_TO_ZERO if powerless else PINNED
    return POWERLESS if powerless else ''

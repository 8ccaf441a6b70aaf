# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of the objects that public functions are given, with errors that name the way out."""

from collections.abc import Iterable

from grasp_quality.exceptions import InvalidGraspError, InvalidTaskError
from grasp_quality.grasp import Grasp
from grasp_quality.joint_limits import refuse_limits

WAY_OUT = 'make one with Grasp(contacts)'


def require_grasp(grasp: object, name: str = 'grasp') -> None:
    """Raise an InvalidGraspError when something is no Grasp."""
    if not isinstance(grasp, Grasp):
        raise InvalidGraspError(f'{name} must be a Grasp, got {type(grasp).__name__}: {WAY_OUT}')


def require_made(value: object, kind: type, name: str, maker: str) -> None:
    """Raise an InvalidTaskError when something is not what a function of the library makes."""
    if not isinstance(value, kind):
        raise InvalidTaskError(
            f'{name} must be a {kind.__name__}, got {type(value).__name__}: make one with {maker}')


def require_start(start: object, kind: type, maker: str) -> None:
    """Raise an InvalidTaskError when what to start from is neither an answer nor None."""
    if start is not None:
        require_made(start, kind, 'start', f'{maker}, or leave it out')


def plain_grasps(grasps: Iterable[Grasp]) -> list[Grasp]:
    """Return at least one grasp, all without joint limits; raise an InvalidGraspError if not."""
    if isinstance(grasps, Grasp):
        raise InvalidGraspError('grasps must be several, got one Grasp: give [grasp]')
    if not isinstance(grasps, Iterable):
        raise InvalidGraspError(
            f'grasps must be several, got {type(grasps).__name__}: give a list of Grasp')
    listed = list(grasps)
    if not listed:
        raise InvalidGraspError('evaluating many grasps needs at least one, got none')
    for i, grasp in enumerate(listed):
        require_grasp(grasp, f'grasps[{i}]')
        refuse_limits(grasp.joint_limits, 'the evaluation of many grasps')
    return listed

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""An explanation in words that an operator can read, one paragraph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grasp_quality.kinks import Uniqueness
from grasp_quality.sensitivity import ALIKE, NEGLIGIBLE
from grasp_quality.slopes import Slopes
from grasp_quality.solution import Solution
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from grasp_quality.explanation import Change

Array = NDArray[np.float64]
DEGREE = np.deg2rad(1.0)
WAYS = {'slip': 'by slip', 'cap': 'by its force cap', 'joint': 'by its torque limit'}


def paragraph(solution: Solution, unique: Uniqueness, limits: tuple[str, ...], shares: Array,
              joint_shares: Array, forward: Slopes, backward: Slopes, best: Change | None) -> str:
    """Say what limits the task, which single change helps most, and where the slopes end."""
    if not solution.feasible:
        return ('The grasp cannot balance the external wrench with any share of the task: no '
                'forces inside the friction cones and the force bound do.')
    grasp, remark = solution.grasp, solution.remark
    words = [] if solution.powerless else [
        f'The grasp applies {solution.alpha:.4g} times the task.']
    if remark:
        words.append(f'{remark[0].upper()}{remark[1:]}.')
    order = [int(i) for i in _largest_first(shares) if limits[i]]
    listed = [f'{grasp.name_of(i)} {WAYS[limits[i]]} ({100.0 * shares[i]:.0f} %)' for i in order]
    joints = () if grasp.joint_limits is None else grasp.joint_limits.names
    listed += [f'{joints[j]} {WAYS["joint"]} ({100.0 * joint_shares[j]:.0f} %)'
               for j in _largest_first(joint_shares) if joint_shares[j] > NEGLIGIBLE]
    if listed:
        words.append(f'It is limited by {", ".join(listed)}.')
    elif not solution.powerless:
        words.append('No larger force cap would raise that.')
    if best is None:
        words.append('No single change of a newton of cap, 0.01 of friction, a millimetre or a '
                     'degree of one contact raises it.')
    else:
        words.append(f'The best single change: {_in_words(best)}, which gives {best.alpha:.4g}.')
    if best is None and solution.powerless:
        return ' '.join(words)
    i = order[0] if order else 0
    words.append(
        f'At {grasp.name_of(i)} a newton of cap is worth {forward.max_force[i]:.3g}, 0.01 of '
        f'friction {0.01 * forward.friction[i]:.3g}, a millimetre along its surface up to '
        f'{1e-3 * _steepest(forward.position[i], backward.position[i]):.3g} and a degree of its '
        f'normal up to {DEGREE * _steepest(forward.rotation[i], backward.rotation[i]):.3g}.')
    if not unique.smooth:
        words.append(
            f'Alpha has a kink here ({_reason(unique)}): a change one way may be worth another '
            'amount than the same change the other way, and slopes are given for both.')
    return ' '.join(words)


def _largest_first(shares: Array) -> NDArray[np.intp]:
    """Return the order of shares (k,), the largest first; alike ones stay in order."""
    most = shares.max(initial=0.0)
    return np.argsort(-np.where(shares >= (1.0 - ALIKE) * most, most, shares), kind='stable')


def _in_words(change: Change) -> str:
    along = '({:.2f}, {:.2f}, {:.2f})'.format(*change.direction)
    return {'max_force': f'one newton more force cap at {change.contact}',
            'friction': f'0.01 more friction at {change.contact}',
            'position': f'move {change.contact} by 1 mm along {along}',
            'rotation': f'turn the normal of {change.contact} by 1 degree about {along}',
            }[change.kind]


def _reason(unique: Uniqueness) -> str:
    if unique.forces:
        return 'the multipliers are not unique'
    if unique.multipliers:
        return 'the forces are not unique'
    return 'neither forces nor multipliers are unique, or none can tell'


def _steepest(ahead: Array, behind: Array) -> float:
    """Largest gain by a step of one unit along the surface, or about its tangents."""
    gains = np.maximum(np.maximum(ahead[:2], -behind[:2]), 0.0)
    return float(np.hypot(*gains))

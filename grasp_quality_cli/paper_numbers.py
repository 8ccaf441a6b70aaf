# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the paper's figures show, in numbers: computed here, beside what they must be.

Each expected value is a closed form, or a value that the figures' subject fixes (docs/paper.md).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, cast

from grasp_quality import evaluate, Grasp, TaskCone, TaskWrench
from grasp_quality_cli.paper_grasps import eight_contacts, pinch, three_fingers
import numpy as np
from numpy.typing import NDArray

FX, FY, FZ = np.eye(6)[:3]
HALF_ANGLE = np.deg2rad(60.0)
TILTS = tuple(range(0, 51, 10))                            # of Fig. 5 [degrees]
SINGLE = (1.866, 1.482, 1.262, 1.128, 1.048, 1.008)        # what Fig. 5's direction reaches
FLAT = 0.1                                                 # friction of the flat grasp
FLAT_TILTS = (0, 10, 20, 30, 45)                           # [degrees]
FLAT_HALF_ANGLE = np.deg2rad(50.0)
WEIGHTS = (0.0, 0.01, 0.1, 0.5, 2.0)                       # eps of eq. (11)


@dataclass(frozen=True)
class Number:
    """One number: of which figure, what it is, what it must be, what came out."""

    figure: str
    what: str
    expected: float
    here: float

    def row(self) -> dict[str, Any]:
        """Return it for JSON."""
        return asdict(self)


def tilted(degrees: float) -> NDArray[np.float64]:
    """Return the unit force -x, turned towards +y."""
    tilt = np.deg2rad(degrees)
    return np.asarray(-np.cos(tilt) * FX + np.sin(tilt) * FY)


def cone_about(axis: NDArray[np.float64], half_angle: float) -> TaskCone:
    """Return the cone of forces about a force in the x y plane."""
    across = np.cross(FZ[:3], axis[:3])
    return TaskCone(axis, np.append(across, np.zeros(3)), FZ, half_angle)


def alpha(grasp: Grasp, wrench: NDArray[np.float64], weight: float = 0.0) -> float:
    """Return alpha of one wrench."""
    return float(evaluate(grasp, TaskWrench(wrench), barrier_weight=weight).alpha)


def flat_alpha(degrees: float, friction: float = FLAT) -> float:
    """
    Return alpha of the pinch for a direction tilted from x, in closed form.

    One normal is 1, the other 1 - alpha cos, so that both press; equilibrium about z makes the
    tangential forces equal, and the lesser normal bounds them: alpha sin = 2 mu (1 - alpha cos).

    """
    tilt = np.deg2rad(degrees)
    return float(2.0 * friction / (np.sin(tilt) + 2.0 * friction * np.cos(tilt)))


def numbers() -> list[Number]:
    """Compute all numbers of docs/paper.md."""
    return [*_fig_3(), *_fig_5(), *_fig_6(), *_fig_7()]


def _fig_3() -> list[Number]:
    found = []
    for friction, bound, along, across in ((0.25, 'linf', 4.0, 2.0), (0.5, 'l1', 1.0, 0.5)):
        grasp = eight_contacts(friction, bound)
        label = f'mu = {friction:g}, {bound}'
        forces = [alpha(grasp, wrench) for wrench in (FX, FY, FZ)]
        found += [Number('3', f'{label}: force along {axis} [N]', expected, force)
                  for axis, expected, force in zip('xyz', (along, across, across), forces)]
        found.append(Number('3', f'{label}: along x over along y', 2.0, forces[0] / forces[1]))
    return found


def _fig_5() -> list[Number]:
    grasp, best = three_fingers(), 1.0 + np.sqrt(3.0) / 2.0
    found = []
    for degrees, single in zip(TILTS, SINGLE):
        cone = evaluate(grasp, cone_about(tilted(degrees), HALF_ANGLE))
        found.append(Number('5', f'tilt {degrees} deg: single direction [N]', single,
                            cast(float, cone.alpha_axis)))
        found.append(Number('5', f'tilt {degrees} deg: along -x, with the cone [N]', best,
                            -float(cone.wrench[0])))
    return found


def _fig_6() -> list[Number]:
    grasp, found = pinch(FLAT), []
    for degrees in FLAT_TILTS:
        cone = evaluate(grasp, cone_about(tilted(degrees), FLAT_HALF_ANGLE))
        found.append(Number('6', f'tilt {degrees} deg: single direction [N]', flat_alpha(degrees),
                            cast(float, cone.alpha_axis)))
        found.append(Number('6', f'tilt {degrees} deg: along -x, with the cone [N]', 1.0,
                            -float(cone.wrench[0])))
    return found


def _fig_7() -> list[Number]:
    grasp, friction = pinch(0.5), 0.5
    found = []
    for eps in WEIGHTS:
        answer = evaluate(grasp, TaskWrench(FY), barrier_weight=eps)
        closed = 2.0 * friction ** 2 / (np.sqrt(friction ** 2 + eps ** 2) + eps)
        found.append(Number('7', f'eps = {eps:g}: alpha [N]', closed, answer.alpha))
        found.append(Number('7', f'eps = {eps:g}: friction margin',
                            1.0 - closed / (2.0 * friction), answer.friction_margin))
    return found

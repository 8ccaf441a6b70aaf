# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality map``: the largest force, or torque, in every direction as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from grasp_quality import Grasp, wrench_map
from grasp_quality.directions import force_grid
from grasp_quality.proof import ZERO_TOLERANCE
from grasp_quality.remarks import ZERO
from grasp_quality_cli.grasp_file import read_grasp_file
from grasp_quality_cli.output import INFEASIBLE, print_json
from grasp_quality_cli.task_text import ArgumentError, chosen_load, LOAD_HELP, require_folder
import numpy as np
from numpy.typing import NDArray
from rich.console import Console
import typer

PICTURES = ('.png', '.pdf', '.svg')


def map_grasp(
        grasp: Annotated[Path, typer.Argument(help='Grasp file, see docs/grasp_files.md.')],
        output: Annotated[Path, typer.Option(
            '--output', '-o', help='Picture: .png, .pdf or .svg.')] = Path('map.png'),
        torque: Annotated[bool, typer.Option(
            '--torque', help='Map torques about the origin, not forces through it.')] = False,
        resolution: Annotated[int, typer.Option(
            help='Steps r of the polar angle; there are 2 r^2 directions, 2,592 of them for 36.',
            min=3, max=400)] = 36,
        external_wrench: Annotated[str | None, typer.Option(
            help=LOAD_HELP + ' Instead of that of the grasp file.', show_default=False)] = None,
        json: Annotated[bool, typer.Option(
            '--json', help='Print directions and alphas as JSON too.')] = False
) -> None:
    """
    Draw the largest force that a grasp can apply in each direction.

    The surface has radius alpha; so has its colour. The torque (with --torque: the force) is zero.

    Example: grasp-quality map examples/three_finger.yaml -o map.png
    """
    from grasp_quality_cli.map_picture import draw_map  # matplotlib is slow to import

    if output.suffix not in PICTURES:
        raise ArgumentError(f'--output must end in {", ".join(PICTURES)}, got {str(output)!r}')
    require_folder(output)
    source = read_grasp_file(grasp)
    directions = force_grid(resolution)
    if torque:
        directions = np.roll(directions, 3, axis=1)
    found = wrench_map(
        source.grasp, directions, chosen_load(external_wrench, source.external_wrench))
    kind, unit = ('torque', 'N m') if torque else ('force', 'N')
    draw_map(output, source.grasp, directions[:, 3:] if torque else directions[:, :3],
             found.alpha, f'Largest {kind} in each direction: {grasp.name}', unit)
    row = {'directions': directions.tolist(), 'alpha': found.alpha.tolist(),
           'feasible': found.feasible.tolist(), 'alpha_min': float(found.alpha.min()),
           'alpha_max': float(found.alpha.max()), 'picture': str(output)}
    if json:
        print_json(row)
    else:
        alpha = without_noise(source.grasp, directions, found.alpha)
        nothing = np.count_nonzero((alpha == 0.0) & found.feasible)
        Console(markup=False).print(
            f'{len(directions):,} directions: from {alpha.min():.6g} to {alpha.max():.6g} {unit}; '
            f'{np.count_nonzero(~found.feasible):,} infeasible'
            + (f'; {nothing:,} are {ZERO}: the contacts apply nothing there' if nothing else '')
            + f'\n{output}', soft_wrap=True)
    if not found.feasible.any():
        raise typer.Exit(INFEASIBLE)


def without_noise(grasp: Grasp, directions: NDArray[np.float64],
                  alpha: NDArray[np.float64]) -> NDArray[np.float64]:
    """Set the alphas (N,) of wrenches (N, 6) to zero that a proof does not tell from it."""
    sizes = grasp.cap_total / np.linalg.norm(grasp.scaled_wrench(directions), axis=1)
    return np.where(alpha > ZERO_TOLERANCE * sizes, alpha, 0.0)

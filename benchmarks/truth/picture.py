# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of docs/truth.md: every pull as a point, beside what was predicted for it."""

from pathlib import Path

from benchmarks.truth.trials import Results
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import numpy as np

TRUE, WRONG = '#0072B2', '#D55E00'
LIMITS = (0.55, 1.75)


def draw(results: Results, path: Path) -> None:
    """Save the picture as a PNG file."""
    points, known = results.points, [p for p in results.points if p.passive]
    rows = [
        ('contact points,\noptimised forces', [p.optimised.ratio for p in points], TRUE),
        ('contact points,\nconstant normals', [p.pulled.ratio for p in results.passive], TRUE),
        ("D'Claw, ball", [p.ratio for p in results.dclaw['ball, PCWF']], TRUE),
        ("D'Claw, cube", [p.ratio for p in results.dclaw['cube, PCWF']], TRUE),
        ('friction 10 %\ntoo large', [p.wrong[0] for p in known], WRONG),
        ('friction 10 %\ntoo small', [p.wrong[1] for p in known], WRONG),
        ('cones of\nfour edges', [p.four_edges[1] for p in known], WRONG)]
    figure = Figure(figsize=(9.0, 4.8))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.17, 0.12, 0.80, 0.78))
    rng = np.random.default_rng(0)
    axes.axvspan(0.98, 1.02, color='0.88', zorder=0)
    axes.axvline(1.0, color='0.4', linewidth=0.8)
    for row, (_, ratios, colour) in enumerate(rows):
        shown = np.clip(np.nan_to_num(ratios, nan=np.inf, posinf=np.inf), *LIMITS)
        axes.scatter(shown, row + rng.uniform(-0.28, 0.28, len(shown)), s=9, color=colour,
                     alpha=0.6, linewidths=0)
    axes.set_yticks(range(len(rows)), [name for name, _, _ in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(*LIMITS)
    axes.set_xlabel('load at slip, measured / predicted (grey: within 2 %)')
    axes.set_title('Blue: predicted by grasp_quality. Orange: wrong on purpose.')
    for side in ('top', 'right'):
        axes.spines[side].set_visible(False)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)

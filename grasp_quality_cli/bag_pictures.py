# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The curves of a report: alpha, margins and normal forces over the time of the bag."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from io import BytesIO

from grasp_quality_cli.bag_summary import Summary
from grasp_quality_cli.bag_trace import Trace
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import numpy as np

MARKERS = 'osD^vPX*<>'  # beside the colour, for whoever cannot tell colours apart
GAP = 8.0               # times the usual step between bins: a line is not drawn across


def pictures(summary: Summary) -> Iterator[tuple[str, str, bytes]]:
    """Draw what there is: (heading, explanation, PNG)."""
    if not summary.samples:
        return
    start = summary.first_ns or 0
    yield ('alpha', 'Largest factor by which the task can be applied, 0 where there is no answer; '
           'the band spans the least and the largest of what falls together at this scale.',
           _picture({'alpha': summary.alpha}, 'alpha [-]', start))
    margins = {'of the forces at alpha': summary.friction_margin,
               'measured': summary.measured_margin}
    yield ('Friction margin', '1 minus the largest cone usage: 1 on the axis of the friction '
           'cones, 0 about to slip, below 0 outside.',
           _picture(margins, 'friction margin [-]', start))
    left = (f' {len(summary.left_out)} more contacts are in the table of forces only.'
            if summary.left_out else '')
    yield ('Normal forces at alpha', 'Contact forces that apply alpha times the task.' + left,
           _picture(summary.normals, 'normal force [N]', start))
    if any(trace.bins for trace in summary.measured_normals.values()):
        yield ('Measured normal forces', 'As measured at the contacts.' + left,
               _picture(summary.measured_normals, 'normal force [N]', start))


def _picture(traces: Mapping[str, Trace], label: str, start_ns: int) -> bytes:
    """Draw curves over the seconds since the first contacts."""
    figure = Figure(figsize=(9.6, 3.8), dpi=100, layout='constrained')
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    there = {name: trace for name, trace in traces.items() if trace.bins}
    colours = colormaps['viridis'](np.linspace(0.0, 0.85, max(len(there), 2)))
    for i, (name, trace) in enumerate(there.items()):
        _curve(axes, trace, name, start_ns, colours[i], MARKERS[i % len(MARKERS)], i / len(there))
    axes.set_xlabel('time since the first contacts [s]')
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)
    if len(there) > 1 or 'alpha' not in there:
        axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)
    png = BytesIO()
    figure.savefig(png)
    return png.getvalue()


def _curve(axes: Axes, trace: Trace, name: str, start_ns: int, colour: object, marker: str,
           shift: float) -> None:
    """Draw one curve; ``shift`` (0 to 1) keeps its markers off those of the others."""
    bins = np.array(trace.bins)  # (b, 5)
    seconds = (bins[:, :2].mean(axis=1) - start_ns) * 1e-9
    least, largest = bins[:, 2].copy(), bins[:, 3].copy()
    steps = np.diff(seconds)
    if len(steps):
        broken = np.flatnonzero(steps > GAP * np.median(steps)) + 1
        seconds = np.insert(seconds, broken, seconds[broken])
        least, largest = (np.insert(v, broken, np.nan) for v in (least, largest))
    every = max(len(seconds) // 8, 1)
    axes.fill_between(seconds, least, largest, color=colour, alpha=0.35, linewidth=0)
    axes.plot(seconds, (least + largest) / 2, color=colour, label=name, linewidth=1.4,
              marker=marker, markersize=5, markevery=(int(shift * every), every))

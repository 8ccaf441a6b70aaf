# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The page's readings: verdict, live plot of alpha and margins, table of contacts."""

from collections import deque
from typing import Any

from grasp_quality_hand import viewer_words
from grasp_quality_hand.viewer_picture import Picture
from grasp_quality_msgs.msg import ResultCode
import numpy as np
import viser
from viser import uplot

PLOT_S = 20.0           # of time on the plot [s]
PLOT_PERIOD_S = 0.2     # between two updates of the plot [s]
TABLE_PERIOD_S = 0.1    # between two updates of the table [s]
ALPHA, MARGIN, SLIP = '#b35900', '#009e73', '#0072b2'


class Panel:
    """Readings at the top of a viser server's controls."""

    def __init__(self, server: viser.ViserServer, target: str) -> None:
        self._target = target
        self._samples: deque[tuple[float, float, float, float]] = deque()
        self._plotted = self._tabled = 0.0
        self._count = 0
        gui = server.gui
        self._status = gui.add_html(viewer_words.status(Picture(), target))
        self._table = gui.add_html(viewer_words.table(Picture()))
        self._plot = gui.add_uplot(
            _columns([]),
            (uplot.Series(label='time [s]'),
             uplot.Series(label='alpha [-]', stroke=ALPHA, width=2, scale='alpha'),
             uplot.Series(label='friction margin [-]', stroke=MARGIN, width=2, scale='margin'),
             uplot.Series(label='measured slip margin [-]', stroke=SLIP, width=2, dash=(4, 3),
                          scale='margin')),
            scales={'x': uplot.Scale(time=False, range=(-PLOT_S, 0.0)),
                    'alpha': uplot.Scale(auto=True, range=(0.0, None)),
                    'margin': uplot.Scale(auto=False, range=(-1.05, 1.05))},
            axes=(uplot.Axis(label='seconds ago', labelSize=18, size=32),
                  uplot.Axis(scale='alpha', label='alpha [-]', labelSize=18, size=44,
                             stroke=ALPHA),
                  uplot.Axis(scale='margin', side=1, label='margins [-]', labelSize=18, size=40,
                             stroke=SLIP, grid={'show': False})),
            legend=uplot.Legend(show=True, live=False), height=220, padding=(14, 0, 4, 0))
        self._legend = gui.add_html(viewer_words.legend(Picture()))

    def show(self, picture: Picture, now: float) -> None:
        """Show a picture taken at a time of the steady clock [s]."""
        self._count += 1
        self._status.content = viewer_words.status(picture, self._target, self._count)
        self._samples.append((now, *_readings(picture)))
        while self._samples[0][0] < now - PLOT_S:
            self._samples.popleft()
        if now - self._plotted >= PLOT_PERIOD_S:
            self._plotted = now
            self._plot.data = _columns(
                [(time - now, *values) for time, *values in self._samples])
        if now - self._tabled >= TABLE_PERIOD_S:
            self._tabled = now
            self._table.content = viewer_words.table(picture)
            self._legend.content = viewer_words.legend(picture)


def _readings(picture: Picture) -> tuple[float, float, float]:
    """Return alpha, friction margin, measured margin; NaN leaves a gap in the plot."""
    quality = picture.quality
    if quality is None:
        return np.nan, np.nan, np.nan
    optimal = quality.result.code == ResultCode.OPTIMAL
    return (quality.alpha, quality.friction_margin if optimal else np.nan,
            quality.measured_slip_margin if quality.slip_measured else np.nan)


def _columns(rows: list[Any]) -> tuple[Any, ...]:
    return tuple(np.array(rows, dtype=float).reshape(-1, 4).T)

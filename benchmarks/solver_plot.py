# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The log-log picture of docs/performance.md: time of one problem over the contacts."""

from pathlib import Path

import matplotlib
matplotlib.use('Agg')
from matplotlib import pyplot  # noqa: E402

PATH = Path(__file__).parents[1] / 'docs' / 'images' / 'solvers.png'
LINES = (
    ('rebuilt', 'CVXPY rebuilt', '#b0b0b0', '--'), ('cached', 'CVXPY cached', '#808080', '-'),
    ('qhull', 'qhull, 8 edges, l1', '#c49a00', '-'), ('scs', 'SCS, 1e-6', '#8c6bb1', '-'),
    ('ecos', 'ECOS', '#41ab5d', '-'), ('clarabel', 'Clarabel', '#2171b5', '-'),
    ('kernel', 'kernel, one direction', '#cb181d', '-'),
    ('grasps', 'evaluate_many, 2,592 grasps', '#cb181d', ':'),
    ('map', 'wrench_map, 2,592 directions', '#cb181d', '--'))


def draw(sizes, path=PATH):
    """Draw the seconds of one problem by contacts and way, and save."""
    figure, axes = pyplot.subplots(figsize=(7.5, 5.0), dpi=110)
    for name, label, color, style in LINES:
        counts = [count for count in sizes if name in sizes[count]]
        axes.loglog(counts, [1e6 * sizes[count][name] for count in counts], style, color=color,
                    marker='o', markersize=3.5, label=label)
    axes.set_xticks(list(sizes), [str(count) for count in sizes])
    axes.minorticks_off()
    axes.set_xlabel('contacts')
    axes.set_ylabel('time of one problem [us]')
    axes.grid(True, which='major', color='#e5e5e5')
    axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)

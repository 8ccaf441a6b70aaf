# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The generated parts of docs/performance.md: text between two comments, prose around it kept."""

import os
from pathlib import Path
import platform

PATH = Path(__file__).parents[1] / 'docs' / 'performance.md'


def write(name, text, path=PATH):
    """Put the text between the markers of that name; at the end where there are none."""
    begin, end = f'<!-- {name}:begin -->', f'<!-- {name}:end -->'
    whole = f'{begin}\n{text}\n{end}'
    document = path.read_text() if path.exists() else '# Performance\n'
    before, found, rest = document.partition(begin)
    if found:
        path.write_text(before + whole + rest.partition(end)[2])
    else:
        path.write_text(f'{document.rstrip()}\n\n{whole}\n')


def table(head, rows):
    """Write rows of values as a Markdown table."""
    lines = [head, ['---'] * len(head), *rows]
    return '\n'.join('| ' + ' | '.join(map(str, line)) + ' |' for line in lines)


def machine():
    """Describe what the figures were measured on."""
    return (f'Python {platform.python_version()} on {platform.machine()} with {os.cpu_count()} '
            f'cores, load of the machine before: {os.getloadavg()[0]:.1f}.')

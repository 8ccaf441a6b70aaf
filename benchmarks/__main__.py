# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Measure, print, and write the sections of docs/performance.md.

``python -m benchmarks`` runs them all, ``python -m benchmarks speed agreement`` those two; with
``--dry`` the document is left alone.
"""

import argparse
import importlib

from benchmarks import document

SECTIONS = ('speed', 'agreement', 'robustness', 'node', 'uncertainty', 'study', 'derivatives',
            'worst_case', 'solvers', 'kernel_check', 'first_call', 'viewing', 'continuity')


def main():
    """Run the sections that the command line names."""
    parser = argparse.ArgumentParser(description='Figures of docs/performance.md.')
    parser.add_argument('sections', nargs='*', metavar='section',
                        help=f'of {", ".join(SECTIONS)}; all when left out')
    parser.add_argument('--dry', action='store_true', help='print only')
    arguments = parser.parse_args()
    unknown = set(arguments.sections) - set(SECTIONS)
    if unknown:
        parser.error(f'no section {", ".join(sorted(unknown))}; there are {", ".join(SECTIONS)}')
    for name in arguments.sections or SECTIONS:
        text = importlib.import_module(f'benchmarks.{name}').measure()
        print(text, end='\n\n', flush=True)
        if not arguments.dry:
            document.write(name, text)


if __name__ == '__main__':
    main()

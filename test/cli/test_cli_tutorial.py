# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The tutorial as its reader follows it: files are saved, commands run, results compared."""

import functools
import os
from pathlib import Path
import re
import subprocess

from ament_index_python.packages import get_package_prefix
from harness import claim_domain, end_with_parent, START_S
import pytest

ROOT = Path(__file__).parents[2]

BLOCK = re.compile(r'(?:<!-- (?P<mark>[^\n]*) -->\n)?```(?P<kind>\w+)\n(?P<text>.*?)```\n', re.S)


def blocks():
    """Code blocks of the tutorial in their order: (mark before it, kind, text)."""
    found = [match.group('mark', 'kind', 'text') for match in BLOCK.finditer(
        (ROOT / 'docs' / 'tutorial.md').read_text())]
    assert {kind for _, kind, _ in found} == {'bash', 'yaml', 'python', 'text'}
    return found


def environment():
    """Return what env.sh adds, and a ROS domain of its own on this machine only."""
    programs = [str(Path(get_package_prefix(package)) / 'lib' / package)
                for package in ('grasp_quality', 'grasp_quality_hand')]
    return {**os.environ, 'PATH': ':'.join([*programs, os.environ['PATH']]), 'COLUMNS': '100',
            'ROS_DOMAIN_ID': str(claim_domain()[0]), 'PYTHONUNBUFFERED': '1'}


def words(text):
    """Forget how lines are broken and spaced."""
    return ' '.join(text.split())


def test_every_step_works(tmp_path):
    printed, ran = '', 0
    for mark, kind, text in blocks():
        if kind in ('yaml', 'python'):
            (tmp_path / mark.removeprefix('file: ')).write_text(text)
        elif kind == 'bash' and mark is None:
            done = subprocess.run(
                ['bash', '-euo', 'pipefail', '-c', text], cwd=tmp_path, env=environment(),
                capture_output=True, text=True, check=False, timeout=START_S,
                preexec_fn=functools.partial(end_with_parent, os.getpid()))
            assert done.returncode == 0, f'{text}\n{done.stdout}\n{done.stderr}'
            printed, ran = done.stdout, ran + 1
        elif kind == 'text':
            for line in text.splitlines():
                assert words(line) in words(printed), printed
    assert ran >= 7 and (tmp_path / 'map.png').exists()
    assert (tmp_path / 'results' / 'report.html').exists()


@pytest.mark.parametrize('mark, kind, text', blocks())
def test_every_file_has_a_name_and_only_the_set_up_is_left_out(mark, kind, text):
    if kind in ('yaml', 'python'):
        assert mark.startswith('file: ')
    if mark is not None and mark.startswith('not run'):
        assert 'make setup' in text

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The command line runs in this process, as its executable runs it."""

from pathlib import Path
import sys

from grasp_quality_cli.main import main
import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / 'test' / 'core'), str(ROOT / 'test' / 'node')]


@pytest.fixture
def examples():
    """Folder of the example files."""
    return ROOT / 'examples'


@pytest.fixture
def run(capsys):
    """Return a function that runs the program: (exit code, standard output, standard error)."""
    def program(*arguments):
        code = main([str(argument) for argument in arguments])
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return program

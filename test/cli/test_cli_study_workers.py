# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Workers of a study end with their parent, also when it ends before they have begun."""

import os
import subprocess
import sys

PROGRAM = 'from grasp_quality_cli.study_workers import _end_with_parent as end; end({}); print(1)'


def begin(parent):
    """Run what a worker runs first, as a child of this process."""
    return subprocess.run(
        [sys.executable, '-c', PROGRAM.format(parent)], check=False, capture_output=True,
        text=True)


def test_a_worker_of_a_parent_that_is_gone_ends_at_once():
    assert begin(os.getpid()).stdout == '1\n'
    orphan = begin(1 if os.getpid() != 1 else 2)
    assert (orphan.stdout, orphan.returncode) == ('', 1)

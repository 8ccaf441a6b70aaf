# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Killed processes once more with the transports that a robot has: shared memory and UDP.

The other tests talk by UDP alone (``transports``). What a process killed with SIGKILL leaves in
shared memory must not keep the others from what the tests below promise. They run as they are, in
a pytest of their own, because a process keeps the transports it has begun with.
"""

import os
from pathlib import Path
import subprocess
import sys

from harness import end_with_parent
import pytest
import transports

HERE = Path(__file__).parent
LONGEST_S = 600.0


@pytest.mark.parametrize('name', [
    '../node/test_transports.py', 'test_publishers.py', 'test_restart_under_load.py',
    'test_clients_killed.py'])
def test_what_is_promised_holds_with_shared_memory(name):
    done = subprocess.run(
        [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', HERE / name],
        env={**os.environ, transports.CHOICE: 'default'}, capture_output=True, text=True,
        check=False, timeout=LONGEST_S, preexec_fn=end_with_parent)
    assert done.returncode == 0, done.stdout + done.stderr

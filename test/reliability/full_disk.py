# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Run a command as on a full disk: no file can grow, and all that it prints fails."""

import os
import resource
import signal
import sys

signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # a write fails with EFBIG, as with ENOSPC
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
full = os.open('/dev/full', os.O_WRONLY)
os.dup2(full, 1)
os.dup2(full, 2)
os.environ.pop('PYTHONUNBUFFERED', None)  # it hides what is left over at the end
os.environ.pop('COVERAGE_PROCESS_CONFIG', None)  # it would end on what it cannot write
os.execv(sys.argv[1], sys.argv[1:])  # noqa: S606

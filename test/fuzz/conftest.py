# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Questions of the fuzzer and the laws of the core: the same ones in every run."""

import os
from pathlib import Path
import sys

from hypothesis import settings

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / 'test' / 'core')]
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'
settings.register_profile('the same every time', deadline=None, derandomize=True, database=None)

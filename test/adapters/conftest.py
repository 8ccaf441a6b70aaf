# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Message fields are checked in all adapter tests; messages read this when they are imported."""

import os

from hypothesis import settings

os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'
settings.register_profile('busy machine', deadline=None)
settings.load_profile('busy machine')

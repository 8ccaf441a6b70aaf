# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Processes of clients, beside those of ``rig``."""

import json
import sys

from harness import Process
from rig import HERE


class Callers(Process):
    """A process of clients."""

    def counts(self):
        """End it and return what it counted."""
        assert self.end() == 0, self.log()
        return json.loads(self.log().splitlines()[-1])


def start_callers(log, namespace, *options, says='each answered'):
    """Start a process of clients, and wait for a word of it."""
    callers = Callers([sys.executable, HERE / 'call_services.py', f'{namespace}/grasp_quality',
                       *options], log)
    callers.until_it_says(says)
    return callers

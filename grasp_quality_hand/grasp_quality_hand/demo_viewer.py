# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The viewer's page as a part of the demo: it shows how well the weight could be lifted."""

import re
import time
from typing import Any

from grasp_quality_hand.demo_processes import ChildProcess, DemoFailure, executable
from grasp_quality_hand.demo_questions import force
from grasp_quality_hand.fetch_dclaw import dclaw_directory, URDF
from grasp_quality_hand.measured_grasp import GRAVITY
from grasp_quality_msgs.srv import SetTask

DEADLINE_S = 60.0


def show_page(client: Any, children: list[ChildProcess], output: Any) -> str:
    """
    Start the viewer, make lifting the live task, and say where the page is.

    Parameters
    ----------
    client : DemoClient
        Has heard the object's mass and the direction up.
    children : list of ChildProcess
        Gets the viewer.
    output : Path
        Folder of its log.

    Returns
    -------
    str
        Address of the page.

    """
    log = output / 'viewer.log'
    children.append(ChildProcess(
        'the viewer', [executable('grasp_quality_hand', 'viewer'), '--ros-args', '-p',
                       'controls:=true', '-p', f'urdf:={dclaw_directory() / URDF}'], log))
    weight = client.heard.mass * GRAVITY * client.heard.up
    client.ask(SetTask, 'set_task', SetTask.Request(
        kind=SetTask.Request.WRENCH, task_wrench=force(weight)))
    deadline = time.monotonic() + DEADLINE_S
    while not (found := re.search(r'open (http://\S+) in', log.read_text(errors='replace'))):
        children[-1].check()
        if time.monotonic() > deadline:
            raise DemoFailure(f'the viewer did not start within {DEADLINE_S:.0f} s; see {log}')
        time.sleep(0.1)
    print(f'\nThe live grasp is at {found[1]}', flush=True)
    return found[1]

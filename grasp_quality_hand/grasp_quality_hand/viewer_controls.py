# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The page's controls: task, friction and load, set through the services of the node.

A slider sends while it is moved: one request is on its way at a time, and the newest position
goes out when its answer is there. Nothing is sent before somebody touches a control, and nothing
at all unless the controls are enabled: any page that the browser shows can speak to this one's
server. A task goes out with the load that the node has, not with one that this page remembers.
"""

import dataclasses
from html import escape
import threading
import time
from typing import Any

from grasp_quality_hand.viewer_calls import Caller
from grasp_quality_hand.viewer_tasks import (
    angles, CONE, FORCE, KINDS, POLYTOPE, PRESETS, set_task_request, TaskChoice, TORQUE)
from grasp_quality_msgs.msg import GraspQuality, ResultCode
from grasp_quality_msgs.srv import SetTask
from msg_adapters.results import code_name
from msg_adapters.wrenches import wrench_array
import numpy as np
import viser

TORQUE_ONLY = 1e-3  # a force below this share of the torque [1/m] is read as none

OWN_LOAD_S = 1.0  # for which a load set here counts before the node is heard to have it

SILENT = 'no answer, is the node running?'
SHOWN_ONLY = 'shown only: start the viewer with controls:=true to set task, load and friction'
NO_LOAD = ('task not sent: it would take away a load that is not known while the node evaluates '
           'nothing; set the load here first')


class Controls:
    """Sliders and buttons of a viser server that set the task of a node."""

    def __init__(self, server: viser.ViserServer, caller: Caller, target: str,
                 enabled: bool) -> None:
        self._caller, self._target = caller, target
        self._sender = NewestOnly()
        self._touched = False
        self._followed: tuple[float, ...] = ()
        self._node_load: tuple[float, ...] | None = None  # [N, N m]
        self._own_load: tuple[float, ...] = ()
        self._own_until = 0.0
        gui: Any = server.gui
        with gui.add_folder('Task (object frame)'):
            self._kind = gui.add_dropdown('task', KINDS)
            self._quantity = gui.add_dropdown('of', (FORCE, TORQUE))
            self._azimuth = gui.add_slider('azimuth [deg]', -180.0, 180.0, 1.0, 0.0)
            self._elevation = gui.add_slider('elevation [deg]', -90.0, 90.0, 1.0, 90.0)
            self._size = gui.add_number('size [N, N m]', 1.0, min=1e-6, step=0.1)
            self._half_angle = gui.add_slider('half angle [deg]', 0.0, 85.0, 1.0, 20.0)
            self._preset = gui.add_dropdown('wrenches', PRESETS)
            quick = gui.add_button_group('direction', ('+x', '-x', '+y', '-y', '+z', '-z'))
        with gui.add_folder('Load and friction'):
            self._load = gui.add_vector3('load [N]', (0.0, 0.0, 0.0), step=0.1)
            self._friction = gui.add_slider(
                'friction [-]', 0.05, 2.0, 0.01, 0.5,
                hint='Of the contacts that bring no coefficient of their own')
        self.map_shown = gui.add_checkbox('show force map', True)
        self._reply = gui.add_html(_reply_html('', True))
        tasks = (self._kind, self._quantity, self._azimuth, self._elevation, self._size,
                 self._half_angle, self._preset)
        self._show_what_counts()
        if not enabled:
            quick.visible = False
            for control in (*tasks, self._load, self._friction):
                control.disabled = True  # and no callback that would send: a page can lie
            self._say(SHOWN_ONLY, True)
            return
        for control in tasks:
            control.on_update(self._on_task)
        self._load.on_update(self._on_load)
        quick.on_click(lambda event: self._point_along(event.target.value))
        self._friction.on_update(self._on_friction)

    def follow(self, quality: GraspQuality | None, friction: float) -> None:
        """Stand where the node stands; the task as long as nobody has touched a control."""
        self._follow_load(quality)
        if self._touched or quality is None:
            return
        task = wrench_array(quality.task_wrench, 'task_wrench')
        if self._followed == (*task, friction):
            return  # setting it again could undo a movement that is on its way from the page
        self._followed = (*task, friction)
        self._friction.value = float(np.clip(friction, self._friction.min, self._friction.max))
        force, torque = np.linalg.norm(task[:3]), np.linalg.norm(task[3:])
        if max(force, torque) > 0.0:
            self._quantity.value = FORCE if force > TORQUE_ONLY * torque else TORQUE
            vector = task[:3] if self._quantity.value == FORCE else task[3:]
            self._azimuth.value, self._elevation.value = map(round, angles(vector))
            self._size.value = float(np.linalg.norm(vector))

    def _follow_load(self, quality: GraspQuality | None) -> None:
        """Take over the node's load; without a task it evaluated nothing and tells none."""
        load = None
        if quality is not None and wrench_array(quality.task_wrench, 'task_wrench').any():
            load = tuple(wrench_array(quality.external_wrench, 'external_wrench').tolist())
        if load not in (None, self._node_load) and time.monotonic() >= self._own_until:
            self._load.value = load[:3]
        self._node_load = load

    @property
    def choice(self) -> TaskChoice:
        """Return what the controls stand at."""
        return TaskChoice(
            self._kind.value, self._quantity.value, self._azimuth.value, self._elevation.value,
            self._size.value, self._half_angle.value, self._preset.value)

    def _on_task(self, event: Any) -> None:
        self._show_what_counts()
        if event.client is not None:  # moved by somebody, not by follow()
            self._send_task()

    def _show_what_counts(self) -> None:
        self._half_angle.visible = self._kind.value == CONE
        self._preset.visible = self._kind.value == POLYTOPE

    def _point_along(self, name: str) -> None:
        vector = np.zeros(3)
        vector['xyz'.index(name[1])] = 1.0 if name[0] == '+' else -1.0
        self._azimuth.value, self._elevation.value = map(round, angles(vector))
        self._send_task()

    def _on_load(self, event: Any) -> None:
        if event.client is not None:
            torque = (self._node_load or (0.0,) * 6)[3:]
            self._own_load = (*self._load.value, *torque)
            self._own_until = time.monotonic() + OWN_LOAD_S
            self._send_task()

    def _send_task(self) -> None:
        load = self._own_load if time.monotonic() < self._own_until else self._node_load
        if load is None:
            self._say(NO_LOAD, False)
            return
        self._touched = True
        request = set_task_request(dataclasses.replace(self.choice, load=load))
        self._sender.send(lambda done: self._caller.call(
            SetTask, f'{self._target}/set_task', request, done), self._on_task_answer)

    def _on_task_answer(self, response: Any) -> None:
        if response is None:
            self._say(f'{self._target}/set_task: {SILENT}', False)
        elif response.result.code != ResultCode.OPTIMAL:
            self._say(f'{code_name(response.result.code)}: {response.result.message}', False)
        else:
            self._say('task set', True)

    def _on_friction(self, event: Any) -> None:
        if event.client is None:
            return
        self._touched = True
        value = self._friction.value
        self._sender.send(lambda done: self._caller.set_number(
            self._target, 'friction_coefficient', value, done), self._on_friction_answer)

    def _on_friction_answer(self, reason: str | None) -> None:
        if reason is None:
            self._say(f'{self._target}/set_parameters: {SILENT}', False)
        else:
            self._say(reason or 'friction set', not reason)

    def _say(self, text: str, good: bool) -> None:
        self._reply.content = _reply_html(text, good)


class NewestOnly:
    """Sends one request at a time; of those that come meanwhile only the newest goes out."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._busy = False
        self._next: tuple[Any, Any] | None = None

    def send(self, request: Any, answered: Any) -> None:
        """Call ``request(done)`` now or when the one before is answered."""
        with self._lock:
            if self._busy:
                self._next = request, answered
                return
            self._busy = True
        self._start(request, answered)

    def _start(self, request: Any, answered: Any) -> None:
        def done(answer: Any) -> None:
            try:
                answered(answer)
            finally:
                with self._lock:
                    following, self._next = self._next, None
                    self._busy = following is not None
                if following is not None:
                    self._start(*following)
        request(done)


def _reply_html(text: str, good: bool) -> str:
    colour = '#555' if good else '#a33'
    return (f'<div id="gq-reply" style="margin:4px 12px;font-size:12px;color:{colour}">'
            f'{escape(text)}</div>')

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Replay: the node's input topics of a bag into the node's own inputs, at the time of the bag.

Every contact message becomes one sample, judged as the node would have judged it at that moment:
the newest measured wrenches, task and load count, and contacts that are too old are a failure.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from grasp_quality.node_inputs import Inputs
from grasp_quality.node_scene import Scene
from grasp_quality.node_settings import Settings
from grasp_quality.task import TaskWrench
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_record import Record
from grasp_quality_cli.bag_types import BagTypes, UnknownTypeError
from grasp_quality_cli.grasp_file import Task
from msg_adapters.errors import InvalidMessageError
from msg_adapters.stamps import stamp_ns
from msg_adapters.tasks import live_task, load_from
import numpy as np
from numpy.typing import NDArray

SOURCES = {'pose_array': ('contact_poses', 'geometry_msgs/msg/PoseArray'),
           'contact_array': ('contacts', 'grasp_quality_msgs/msg/ContactArray')}
WRENCH_STAMPED = 'geometry_msgs/msg/WrenchStamped'
MEASURED = 'contact_wrenches/'
NO_TASK = ('there is no task: give --task, the parameter task_wrench, or a bag with the topic '
           '{node}/task_wrench')


@dataclass
class Sample:
    """
    Contacts of one moment, or why there are none that can be used.

    Attributes
    ----------
    time_ns : int
        When they were recorded, since the epoch.
    stamp_ns : int
        Of their header; 0 where there is none.
    scene : Scene or None
    task : TaskWrench, TaskCone, TaskPolytope or TaskEllipsoid, or None
    load : (6,) array [N, N m] or None
        External wrench.
    error : Exception or None
        Instead of scene and task.

    """

    time_ns: int
    stamp_ns: int
    scene: Scene | None = None
    task: Task | None = None
    load: NDArray[np.float64] | None = None
    error: Exception | None = None


class BagInputs:
    """Takes records in, gives samples out."""

    def __init__(self, settings: Settings, node: str, task: Task | None,
                 load: NDArray[np.float64] | None, problems: Problems) -> None:
        self._settings, self._node, self._problems = settings, node.rstrip('/'), problems
        self._task, self._load = task, load
        self._parameter_task: Task | None = None
        self._types = BagTypes()
        self._now = 0
        self._last: dict[str, int] = {}  # topic: time of its newest message
        self._inputs: Any = Inputs(lambda: settings, lambda: self._now, lambda: self._now)
        self._contacts, contacts_type = SOURCES[settings.contact_source]
        self._wanted = {self._contacts: contacts_type}
        if task is None:
            self._wanted['task_wrench'] = WRENCH_STAMPED
        if load is None:
            self._wanted['external_wrench'] = WRENCH_STAMPED

    def set_task_wrench(self, wrench: tuple[float, ...]) -> None:
        """Take the parameter task_wrench, which counts until a task was recorded."""
        if wrench and self._task is None:
            self._parameter_task = TaskWrench(np.array(wrench))

    def wants(self, topic: str) -> bool:
        """Tell whether a topic is an input that is replayed."""
        name = self._short(topic)
        return name in self._wanted or name.startswith(MEASURED)

    def _short(self, topic: str) -> str:
        return topic.removeprefix(self._node + '/') if topic.startswith(self._node) else ''

    def take(self, record: Record) -> Sample | None:
        """Store a record; return the sample that it makes, if it holds contacts."""
        name = self._short(record.topic)
        self._note_gap(name, record)
        wanted = self._wanted.get(name, WRENCH_STAMPED)
        if record.msgtype != wanted:
            self._note('unknown type', record, f'{record.msgtype} instead of {wanted}: not read')
            return None
        try:
            message: Any = self._types.decode(record)
        except UnknownTypeError as exc:
            self._note('unknown type', record, str(exc))
            return None
        except Exception as exc:  # whatever bad bytes make of the decoder
            self._note('bad message', record, f'cannot be decoded: {exc}')
            return None
        return self._stored(name, record, message)

    def _stored(self, name: str, record: Record, message: Any) -> Sample | None:
        self._now = max(self._now, record.time_ns)
        if name == self._contacts:
            if not self._inputs.store_contacts(message):
                self._note('late contacts', record, 'stamped before those that came before them: '
                           'the node passes over them')
                return None
            return self._sample(record, stamp_ns(message.header.stamp))
        if name == 'task_wrench':
            self._inputs.store_task_wrench(message)
        elif name == 'external_wrench':
            self._inputs.store_load(message)
        else:
            self._inputs.store_wrench(name.removeprefix(MEASURED), message)
        return None

    def _sample(self, record: Record, stamp: int) -> Sample:
        sample = Sample(record.time_ns, stamp)
        try:
            scene = self._inputs.scene()
            for text in self._inputs.problems:
                self._note('bad measurement', record, text)
            sample.task, sample.load = self._task_and_load(scene)
            sample.scene = scene
        except Exception as exc:  # a boundary: one bad message never ends the reading
            sample.error = exc
        return sample

    def _task_and_load(self, scene: Scene) -> tuple[Task, NDArray[np.float64] | None]:
        inputs, task, load = self._inputs, self._task, self._load
        if task is None:
            if inputs.task is None and self._parameter_task is not None:
                task = self._parameter_task
            elif inputs.task is None:
                raise InvalidMessageError('no task was recorded before these contacts')
            else:
                task = live_task(inputs.task, inputs.transform(
                    inputs.task.header, scene.frame, scene.stamp),
                    self._settings.max_request_size)
        held = inputs.loads.newest() if load is None else None
        if held is not None:
            load = load_from(held.wrench, inputs.transform(
                held.header, scene.frame, scene.stamp))
        return task, load

    def _note_gap(self, name: str, record: Record) -> None:
        """Note where a stream of contacts or measurements stops for longer than contacts live."""
        last = self._last.get(name)
        self._last[name] = max(record.time_ns, last or 0)
        if last is None or name in ('task_wrench', 'external_wrench'):
            return
        gap_s = (record.time_ns - last) * 1e-9
        if gap_s > self._settings.max_contact_age:
            self._note('gap', record, f'nothing for {gap_s:.3f} s before this message; '
                       f'max_contact_age is {self._settings.max_contact_age:g} s')
        elif gap_s < 0.0:
            self._note('time runs back', record, f'by {-gap_s:.3f} s in the bag')

    def _note(self, kind: str, record: Record, text: str) -> None:
        self._problems.add(kind, record.topic, text, record.time_ns)

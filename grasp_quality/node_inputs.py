# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the node has received: the newest message of every topic, and how old it is.

Nothing is judged on arrival. ``scene`` turns the newest contacts into core objects when they are
asked for; a message that cannot be used is an error there, and the next good one is all it takes
to recover. How old contacts and loads are ``node_ages`` tells. A task holds until it is replaced,
and so does a load unless ``max_load_age`` says otherwise (``node_loads``). With
``min_contact_force`` an answer rests on the wrenches of the contacts that it counts as loaded too;
one that does not count needs none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
import time
from typing import Any, cast

from grasp_quality.arrays import Array
from grasp_quality.contact_set import ContactSet
from grasp_quality.grasp import Grasp
from grasp_quality.moving import moved
from grasp_quality.node_ages import Ages, Received, Subject
from grasp_quality.node_felt import doubts, Felt
from grasp_quality.node_loads import Loads
from grasp_quality.node_scene import Scene
from grasp_quality.node_settings import Settings, SOURCES
from msg_adapters.contacts import contacts_from_array, contacts_from_poses
from msg_adapters.errors import InvalidMessageError, NoContactsError, StaleContactsError
from msg_adapters.frames import object_frame_of, Transform, transform_to
from msg_adapters.joint_limits import joint_limits_from
from msg_adapters.measured import local_force
from msg_adapters.message_types import Framed, Stamp, Stamped, StampedWrench
from msg_adapters.tasks import HeldLoad, HeldTask, NoFrame
from msg_adapters.wrenches import to_wrench

NEWEST = Subject(
    'the newest contacts are', 'max_contact_age',
    'send contacts more often, or raise max_contact_age')
ANSWERED = Subject(
    'the contacts of this answer are', 'max_contact_age',
    'ask for less at once, send contacts with the question, or raise max_contact_age')
FELT = Subject(
    'the measured wrench of {} is', 'max_contact_age',
    'send one with every sample of contacts, or raise max_contact_age')
NOT_LOADED = (
    'no contact is loaded: no measured normal force, of the finger on the object, reaches '
    'min_contact_force')


class Inputs:
    """
    Newest messages, of ROS or of a recorded bag: only their fields are read.

    ``settings()`` returns the current Settings; the clocks are those of Ages. ``sent_ns`` is when
    a message was sent, by the system clock of the sender.

    """

    def __init__(self, settings: Callable[[], Settings], now_ns: Callable[[], int],
                 steady_ns: Callable[[], int] = time.monotonic_ns,
                 system_ns: Callable[[], int] = time.time_ns) -> None:
        self._settings = settings
        self._ages = Ages(settings, now_ns, steady_ns, system_ns)
        self._contacts: Received | None = None
        # contact message, settings, Grasp, object frame
        self._read: tuple[Any, Settings, Grasp, str] | None = None
        self._wrenches: dict[str, Received] = {}  # by contact
        self.task: Any = None      # SetTask.Request or HeldTask
        self.loads = Loads(settings, self._ages)
        self.tf_buffer: Any = None  # tf2_ros.Buffer where tf2 is installed
        self._felt: Felt | None = None  # by the contacts of the last scene
        self.loaded_by: dict[str, Received] = {}  # wrenches that the last scene rests on, by name
        self.elsewhere = ''  # who else publishes contacts, while none have come
        self.cleared = 0  # how often

    def clear(self) -> None:
        """Forget contacts and measurements, as on deactivation; keep the task."""
        self._contacts = self._felt = None
        self._wrenches, self.loaded_by = {}, {}
        self.cleared += 1

    @property
    def contacts(self) -> Received | None:
        """Newest contact message; None before any."""
        return self._contacts

    @property
    def problems(self) -> tuple[str, ...]:
        """Why measured wrenches of the last scene cannot be used."""
        return () if self._felt is None else tuple(self._felt.refused.values())

    def doubts(self) -> tuple[str, ...]:
        """Say what is doubtful about the measured forces of the contacts that there are now."""
        try:
            self.age_s()
        except (NoContactsError, StaleContactsError):
            return ()
        return () if self._felt is None else doubts(self._felt, self._settings(), self._wrenches)

    def store_contacts(self, message: Stamped, sent_ns: int | None = None) -> bool:
        """Keep a PoseArray or ContactArray, unless one with a later stamp is fresh; tell if so."""
        if self._ages.is_late(message, self._contacts, NEWEST):
            return False
        self._contacts = self._ages.received(message, sent_ns)
        return True

    def store_wrench(
            self, name: str, message: StampedWrench, sent_ns: int | None = None) -> None:
        """Keep the measured WrenchStamped of a contact."""
        self._wrenches[name] = self._ages.received(message, sent_ns)

    def set_task(self, request: Any) -> None:
        """Keep a SetTask request: its task, and its external wrench as the load."""
        self.task = request
        self.loads.give(HeldLoad(request.external_wrench, request.header))

    def store_task_wrench(self, message: StampedWrench) -> None:
        """Keep a WrenchStamped as the task of the live loop; the load stays."""
        self.task = HeldTask(message.wrench, message.header)

    def store_load(self, message: StampedWrench, sent_ns: int | None = None) -> None:
        """Keep a WrenchStamped as the external wrench of the live loop."""
        self.loads.store(message, sent_ns)

    def set_task_wrench(self, wrench: Sequence[float]) -> None:
        """Keep fx fy fz tx ty tz in the object frame as the task; empty leaves the task alone."""
        if len(wrench):
            self.task = HeldTask(to_wrench(wrench), NoFrame())

    def age_s(self) -> float:
        """
        Age of the newest contacts [s], by stamp and arrival.

        Raises
        ------
        NoContactsError, StaleContactsError

        """
        if self._contacts is None:
            source = self._settings().contact_source
            raise NoContactsError(
                f'no contacts received yet on {SOURCES[source]} (parameter contact_source is '
                f'{source}){self.elsewhere}')
        return self._ages.checked_s(self._contacts, NEWEST)

    def left_s(self) -> float:
        """Time until the last scene or the load is too old to answer [s]; raises when it is."""
        oldest_s = max([self.age_s(), *self._felt_ages_s(self.loaded_by)])
        return min(self._settings().max_contact_age - oldest_s, self.loads.left_s())

    def check_answered(self, contacts: Received, loaded_by: dict[str, Received]) -> None:
        """Raise StaleContactsError when what an earlier scene rests on is too old by now."""
        self._ages.checked_s(contacts, ANSWERED)
        self._felt_ages_s(loaded_by)

    def _felt_ages_s(self, wrenches: dict[str, Received]) -> list[float]:
        return [self._ages.checked_s(wrench, FELT._replace(words=FELT.words.format(name)))
                for name, wrench in wrenches.items()]

    def scene(self) -> Scene:
        """
        Newest loaded contacts, checked and in the object frame.

        Raises
        ------
        NoContactsError, StaleContactsError, InvalidMessageError, TransformError

        """
        self.age_s()
        message, settings = cast(Received, self._contacts).message, self._settings()
        read = self._read
        if read is None or read[0] is not message or read[1] is not settings:
            read = self._read = (message, settings, *self.read_grasp(message))
        grasp, frame = read[2:]
        felt = self._felt = self._measured(grasp.contacts, frame)
        forces, self.loaded_by = felt.forces, {}
        if settings.min_contact_force > 0.0:
            loaded = felt.loaded(settings.min_contact_force)
            if not loaded:
                silent = [name for name, force in zip(grasp.names, forces) if force is None]
                raise NoContactsError(NOT_LOADED + (
                    f'; no fresh wrench came for {silent}' if silent else ''))
            limits = grasp.joint_limits and grasp.joint_limits.subset(loaded)
            grasp = Grasp(grasp.contacts.subset(loaded), settings.force_bound, limits)
            forces = [forces[i] for i in loaded]
            self.loaded_by = {name: self._wrenches[name] for name in grasp.names}
        return Scene(grasp, tuple(forces), frame, message.header.stamp)

    def read_grasp(self, message: Any) -> tuple[Grasp, str]:
        """Turn a PoseArray or ContactArray into (Grasp, object frame)."""
        settings = self._settings()
        frame = object_frame_of(message.header.frame_id, settings.object_frame)
        transform = self.transform(message.header, frame, message.header.stamp)
        are_poses = hasattr(message, 'poses')
        items = message.poses if are_poses else message.contacts
        if len(items) > settings.max_request_size:
            raise InvalidMessageError(
                f'contacts must number at most {settings.max_request_size} (parameter '
                f'max_request_size), got {len(items)}')
        before = self._posed(settings, len(items)) if are_poses else None
        if before is not None:
            return moved(before, contacts_from_poses(
                message, settings.contact_defaults, transform, before.contacts)), frame
        read = contacts_from_poses if are_poses else contacts_from_array
        contacts = read(message, settings.contact_defaults, transform)
        if not len(contacts):
            raise NoContactsError('the newest contact message holds no contacts')
        limits = None if are_poses else joint_limits_from(
            message, contacts, transform, settings.max_request_size)
        return Grasp(contacts, settings.force_bound, limits), frame

    def _posed(self, settings: Settings, count: int) -> Grasp | None:
        """Grasp of the last poses read, if they were as many and under the same settings."""
        if self._read is None:
            return None
        message, under, grasp, _ = self._read
        fits = under is settings and len(grasp) == count and hasattr(message, 'poses')
        return grasp if fits else None

    def transform(self, header: Framed, frame: str, stamp: Stamp) -> Transform | None:
        """Transform from a header's frame to the object frame at a time; None for the identity."""
        return transform_to(frame, header.frame_id, self.tf_buffer, stamp)

    def _measured(self, contacts: ContactSet, frame: str) -> Felt:
        """Read the fresh measured force of each contact."""
        forces: list[Array | None] = []
        refused: dict[str, str] = {}
        limit = self._settings().max_contact_age
        for i, name in enumerate(contacts.names):
            received = self._wrenches.get(name)
            force = None
            if received is not None:
                ages = self._ages.of(received)
                if -limit <= min(ages) and max(ages) <= limit:
                    try:
                        force = local_force(received.message, contacts[i], frame)
                    except InvalidMessageError as exc:
                        refused[name] = str(exc)
            forces.append(force)
        return Felt(contacts, forces, refused)

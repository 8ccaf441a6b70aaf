# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What has to be refused, told from the messages alone, by what the interfaces and documents say.

Written apart from the adapters: one function a part of a message, which yields the words of which
one has to stand in the text of the refusal. What nothing here objects to has to be answered.
"""

from collections import Counter
from collections.abc import Iterator
import math
import re
from typing import Any

from benchmarks.fuzz.cases import Case, LIVE
from benchmarks.fuzz.fields import all_within, numbers
from benchmarks.fuzz.grasps import NOW_S
from grasp_quality.node_settings import Settings

LARGEST, SMALLEST, FARTHEST = 1e12, 1e-12, 1e3
CAP_RATIO, NORM = 1e6, 1e-3
COEFFICIENTS = ('friction_coefficient', 'torsional_friction_coefficient', 'max_normal_force')
TASKS = {1: ('task_wrench',), 2: ('axis', 'lateral_x', 'lateral_y', 'half_angle'),
         3: ('task_wrenches', 'weights')}
LISTS = ('task_wrenches', 'directions', 'axes')
FRAMES, CONTACTS, STAMPS = 'frame', 'no contacts', 'stamp'  # that have codes of their own

Words = tuple[str, ...]


def refusals(case: Case, settings: Settings) -> list[Words]:
    """Return all that must be refused; empty: it has to be answered."""
    request = case.messages.get('request')
    found: list[Words] = []
    if case.kind == LIVE:
        message = case.messages['contacts']
        found += _contacts(message, settings)
        found += _age(message, settings)
        if request is not None:
            if wrong := list(_set_task(request, settings)):
                return [*found, *wrong, ('no task',)]
            found += _frame(request.header, message, settings)
        else:
            for name in ('task', 'load'):
                if name in case.messages:
                    stamped = case.messages[name]
                    found += _frame(stamped.header, message, settings)
                    found += _numbers(stamped.wrench, 'task_wrench' if name == 'task' else
                                      'external_wrench')
            found += _zero(case.messages['task'].wrench, 'task_wrench')
        return found
    if case.kind == 'set_task':
        return list(_set_task(request, settings))
    message = request.contacts
    if not message.contacts:
        if 'contacts' not in case.messages:
            return [(CONTACTS,)]
        message = case.messages['contacts']
        found += _age(message, settings)
    found += _contacts(message, settings)
    found += _frame(request.header, message, settings)
    found += _request(case.kind, request, settings)
    if case.kind in ('robust_alpha', 'ball_radius') and getattr(message, 'joint_limits', ()):
        found.append(('joint limits', 'joint_limits'))
    return found


def _numbers(message: Any, name: str, passed_over: Words = ()) -> Iterator[Words]:
    if all_within(message, LARGEST):
        return
    for path, value in numbers(message):
        if not abs(value) <= LARGEST and re.split(r'[.[]', path)[0] not in passed_over:
            # read by its own name, or as part of what holds it
            words = [word.partition('[')[0] for word in (name + '.' + path).split('.')]
            yield tuple(word for word in words if len(word) > 1)


def _zero(wrench: Any, name: str) -> Iterator[Words]:
    if all_within(wrench, SMALLEST) and all(
            abs(value) < SMALLEST for _, value in numbers(wrench)):
        yield (name,)


def _frame(header: Any, contacts: Any, settings: Settings) -> Iterator[Words]:
    if header.frame_id not in ('', settings.object_frame or contacts.header.frame_id):
        yield (FRAMES,)


def _age(message: Any, settings: Settings) -> Iterator[Words]:
    stamp = message.header.stamp
    age = NOW_S - stamp.sec - stamp.nanosec * 1e-9
    if (stamp.sec or stamp.nanosec) and abs(age) > settings.max_contact_age:
        yield (STAMPS,)


def _contacts(message: Any, settings: Settings) -> Iterator[Words]:
    frame = message.header.frame_id
    if not frame and not settings.object_frame:
        yield ('frame_id',)
    if frame and settings.object_frame and frame != settings.object_frame:
        yield (FRAMES,)
    are_poses = hasattr(message, 'poses')
    items = message.poses if are_poses else message.contacts
    if not items:
        yield (CONTACTS,)
        return
    if len(items) > settings.max_request_size:
        yield ('contacts',)
    if are_poses and settings.contact_names and len(items) != len(settings.contact_names):
        yield ('poses',)
    for item in items:
        yield from _pose(item if are_poses else item.pose)
        if not are_poses:
            yield from _contact(item)
    if not are_poses:
        names = [item.name or f'contact_{i}' for i, item in enumerate(items)]
        if len(set(names)) < len(names):
            yield ('name',)
        caps = [item.max_normal_force or settings.max_normal_force for item in items]
        if max(caps) > CAP_RATIO * min(caps):
            yield ('max_normal_force',)
        yield from _joints(message.joint_limits, names, settings)


def _pose(pose: Any) -> Iterator[Words]:
    yield from _numbers(pose.position, 'position')
    if not all_within(pose.position, FARTHEST):
        yield ('position',)
    q = pose.orientation  # hypot squares neither tiny nor huge numbers
    if not abs(math.hypot(q.x, q.y, q.z, q.w) - 1.0) <= NORM:
        yield ('orientation',)


def _contact(item: Any) -> Iterator[Words]:
    if item.model > 3:
        yield ('model',)
    for name in COEFFICIENTS:
        value = getattr(item, name)
        if not (value == 0.0 or SMALLEST <= value <= LARGEST):
            yield (name,)


def _joints(joints: Any, contacts: list[str], settings: Settings) -> Iterator[Words]:
    if len(joints) * len(contacts) > settings.max_request_size:
        yield ('joint_limits',)
    counted = Counter(joint.name for joint in joints)
    if joints and (max(counted.values()) > 1 or '' in counted):
        yield ('joint names', 'joint_limits')
    if set(counted) & set(contacts):
        yield ('share a name', 'joint_limits')
    for joint in joints:
        yield from _numbers(joint, 'joint_limits')
        if len(joint.twists) != len(contacts):
            yield ('twists',)
        if joint.max_torque < SMALLEST:
            yield ('max_torque',)


def _set_task(request: Any, settings: Settings) -> Iterator[Words]:
    if request.kind not in TASKS:
        yield ('kind',)
        return
    unread = tuple(name for kind, names in TASKS.items() if kind != request.kind
                   for name in names)
    yield from _numbers(request, 'request', unread)
    yield from _task(request, TASKS[request.kind], settings)


def _task(request: Any, names: Words, settings: Settings) -> Iterator[Words]:
    for name in names:
        value = getattr(request, name)
        if name in ('task_wrench', 'axis'):
            yield from _zero(value, name)
        elif name in LISTS:
            if len(value) > settings.max_request_size:
                yield (name,)
            for item in value:
                yield from _zero(item, name)
    if 'task_wrenches' in names:
        weights = request.weights
        if not request.task_wrenches:
            yield ('task_wrenches',)
        if len(weights) not in (0, len(request.task_wrenches)):
            yield ('weights',)
        if len(weights) and (min(weights) < 0.0 or not max(weights) > 0.0):
            yield ('weights',)
    if 'half_angle' in names:
        if not 0.0 <= request.half_angle < math.pi / 2:
            yield ('half_angle',)
        elif all_within(request, LARGEST) and _holds_zero(request):
            yield ('cone',)


def _holds_zero(request: Any) -> bool:
    """Whether one of the laterals cancels the axis."""
    axis, x, y = ([value for _, value in numbers(w)] for w in (
        request.axis, request.lateral_x, request.lateral_y))
    for lateral in (x, y):
        largest = max(map(abs, lateral))
        if largest > 0.0:
            size = max(map(abs, axis)) or 1.0
            along = sum((a / size) * (b / largest) for a, b in zip(axis, lateral))
            norms = math.hypot(*(a / size for a in axis)) * math.hypot(
                *(b / largest for b in lateral))
            if abs(along) >= norms * (1.0 - 1e-15):
                return largest * math.tan(request.half_angle) > size
    return False


def _request(kind: str, request: Any, settings: Settings) -> Iterator[Words]:
    passed_over = ['contacts']
    if kind == 'ball_radius':
        if any(value for _, value in numbers(request.external_wrench)):
            yield ('external_wrench',)
        if request.axes:
            passed_over.append('torque_length')
        elif request.torque_length != 0.0 and request.torque_length < SMALLEST:
            yield ('torque_length',)
        elif request.subspace > 2:
            yield ('subspace',)
        if not request.relative_width >= 0.0:
            yield ('relative_width',)
    yield from _numbers(request, 'request', tuple(passed_over))
    names = tuple(name for name in (*TASKS[1], *TASKS[2], *TASKS[3], *LISTS) if hasattr(
        request, name))
    yield from _task(request, tuple(dict.fromkeys(names)), settings)
    if kind == 'wrench_map' and not request.directions:
        steps = request.resolution or 36
        if 2 * steps ** 2 > settings.max_request_size:
            yield ('resolution',)
    if kind == 'robust_alpha':
        yield from _noise(request, settings)


def _noise(request: Any, settings: Settings) -> Iterator[Words]:
    for name, largest in (
            ('contact_noise', 1.0), ('normal_noise', 1.0), ('friction_noise', LARGEST)):
        if not 0.0 <= getattr(request, name) <= largest:
            yield (name,)
    if any(value < 0.0 for _, value in numbers(request.load_noise)):
        yield ('load_noise',)
    if request.samples > settings.max_request_size:
        yield ('samples',)
    level = request.quantile or settings.quantile_level
    samples = request.samples or min(1000, settings.max_request_size)
    if not 0.0 < level < 1.0:
        yield ('quantile',)
    elif 1.0 - level ** samples < 0.975:
        yield ('samples', 'quantile')

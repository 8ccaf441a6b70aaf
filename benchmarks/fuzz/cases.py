# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""One question to the node with all that it has heard, as messages: from a seed or from a file."""

from dataclasses import dataclass, field
import json
from pathlib import Path
from random import Random
from typing import Any

from benchmarks.fuzz import grasps
from benchmarks.fuzz.fields import from_plain, to_plain
from benchmarks.fuzz.spoiling import spoil
from geometry_msgs.msg import PoseArray, WrenchStamped
from grasp_quality_msgs import srv
from grasp_quality_msgs.msg import ContactArray

SERVICES = {
    'evaluate_task_wrench': srv.EvaluateTaskWrench, 'evaluate_task_cone': srv.EvaluateTaskCone,
    'evaluate_task_polytope': srv.EvaluateTaskPolytope, 'minimum_forces': srv.MinimumForces,
    'wrench_map': srv.WrenchMap, 'robust_alpha': srv.RobustAlpha, 'ball_radius': srv.BallRadius,
    'explain': srv.Explain, 'set_task': srv.SetTask}
LIVE = 'live'
SHARES = {
    'evaluate_task_wrench': 0.512, LIVE: 0.36, 'minimum_forces': 0.05, 'evaluate_task_cone': 0.03,
    'evaluate_task_polytope': 0.025, 'wrench_map': 0.01, 'robust_alpha': 0.008,
    'explain': 0.003, 'ball_radius': 0.002}
SPOILT = (0, 1, 1, 1, 1, 1, 1, 2, 2, 3, 5)  # fields of a question
ON_WIRE = 0.1  # of the questions go through serialization first, as all that arrives does
POSES, ARRAY = 'pose_array', 'contact_array'
TIMELESS = {'solver_time_limit': 60.0, 'max_contact_age': 60.0}  # answers that no clock decides


@dataclass
class Case:
    """
    A question.

    Attributes
    ----------
    kind : str
        A service, or 'live' for a sample of contacts.
    settings : dict
        Parameters of the node, where they are not its defaults.
    messages : dict of str to message
        'request' of the service; 'contacts', 'task', 'load' and 'measured/<name>' as received on
        topics; 'before': contacts that came before those.
    on_wire : bool
    rule : str
        What a kept case once broke.

    """

    kind: str
    settings: dict[str, Any]
    messages: dict[str, Any] = field(default_factory=dict)
    on_wire: bool = False
    rule: str = ''


def case_of(seed: int) -> Case:
    """Make a question from a seed, and spoil it."""
    random = Random(seed)
    kind = random.choices(list(SHARES), list(SHARES.values()))[0]
    settings = _settings(random, kind)
    sizes = grasps.Sizes(random)
    if kind == LIVE:
        case = Case(kind, settings, _live(random, sizes, settings))
    else:
        request = SERVICES[kind].Request()
        fill_request(request, random, sizes)
        case = Case(kind, settings, {'request': request})
        if random.random() < 0.1:  # the contacts are those heard before
            case.messages['contacts'] = _contacts(random, sizes, settings)
            request.contacts = ContactArray()
    for _ in range(random.choice(SPOILT)):
        spoil(case.messages[random.choice(list(case.messages))], random, _left_alone(kind))
    case.on_wire = random.random() < ON_WIRE
    return case


def _left_alone(kind: str) -> tuple[str, ...]:
    """Fields whose size is time: a million questions shall end, whatever stands in them."""
    return ('relative_width', 'samples') if kind in ('ball_radius', 'robust_alpha') else ()


def _settings(random: Random, kind: str) -> dict[str, Any]:
    settings: dict[str, Any] = dict(TIMELESS)
    settings['force_bound'] = random.choice(('linf', 'linf', 'linf', 'l1', 'l2', 'finger'))
    settings['contact_model'] = random.choice(('PCWF', 'PCWF', 'SFCE', 'FPC'))
    settings['contact_source'] = random.choice((POSES, ARRAY))
    way = random.randrange(100)
    if way == 0:
        settings['barrier_weight'] = 10.0 ** random.uniform(-3.0, 1.0)
    elif way == 1 and random.random() < 0.3:
        settings['alpha_reserve'] = random.choice((1e-6, 0.05, 0.5))
    elif way < 4:
        settings['object_frame'] = random.choice((grasps.FRAME, 'world'))
    elif way < 8:
        settings['max_request_size'] = random.choice((1, 2, 8))
    elif way < 13:
        settings.update(friction_coefficient=random.choice((0.0, 1e-9, 100.0)),
                        torsional_friction_coefficient=random.choice((0.0, 1e-12, 100.0)),
                        max_normal_force=random.choice((1e-12, 1e6, 1.0)))
    if kind == LIVE and random.random() < 0.3:
        settings['contact_names'] = ('a', 'b', 'c')[:random.randint(1, 3)]
        settings['min_contact_force'] = random.choice((0.0, 0.0, 1e-3))
        settings['force_rate_limit'] = random.choice((0.0, 0.0, 1.0))
    if kind == 'ball_radius':
        settings['solver_time_limit'] = 0.02
    return settings


def _contacts(random: Random, sizes: grasps.Sizes, settings: dict[str, Any]) -> Any:
    if settings['contact_source'] == ARRAY:
        return grasps.contact_array(random, sizes)
    names = settings.get('contact_names')
    return grasps.pose_array(random, sizes, len(names) if names else None)


def _live(random: Random, sizes: grasps.Sizes, settings: dict[str, Any]) -> dict[str, Any]:
    messages: dict[str, Any] = {'contacts': _contacts(random, sizes, settings)}
    if settings.get('force_rate_limit'):
        messages['before'] = from_plain(
            type(messages['contacts']), to_plain(messages['contacts']))
    if random.random() < 0.3:
        messages['request'] = srv.SetTask.Request(kind=random.choice((1, 1, 2, 3)))
        fill_request(messages['request'], random, sizes)
    else:
        messages['task'] = WrenchStamped(
            wrench=grasps.wrench(random, sizes.force, sizes.length))
        if random.random() < 0.5:
            messages['load'] = WrenchStamped(wrench=grasps.load(random, sizes))
    for name in settings.get('contact_names', ()):
        measured = WrenchStamped(wrench=grasps.wrench(random, 0.1 * sizes.force, sizes.length))
        measured.header.frame_id = random.choice((name, name, grasps.FRAME))
        measured.wrench.force.z = abs(measured.wrench.force.z)
        messages[f'measured/{name}'] = measured
    return messages


def fill_request(request: Any, random: Random, sizes: grasps.Sizes) -> None:
    """Give a new request valid values, as far as it has the fields."""
    def wrench(force: float = sizes.force) -> Any:
        return grasps.wrench(random, force, sizes.length)

    if hasattr(request, 'contacts'):
        request.contacts = grasps.contact_array(random, sizes)
    request.external_wrench = grasps.load(random, sizes)
    kind = getattr(request, 'kind', None)  # of a SetTask only the fields of its kind count
    for name in ('task_wrench', 'axis', 'lateral_x', 'lateral_y'):
        if hasattr(request, name) and kind in (None, 1 + (name != 'task_wrench')):
            setattr(request, name, wrench())
    for name in ('task_wrenches', 'directions', 'axes'):
        if hasattr(request, name) and kind in (None, 3):
            setattr(request, name, [wrench() for _ in range(random.randint(1, 3))])
    if hasattr(request, 'weights') and random.random() < 0.5:
        request.weights = [random.random() for _ in request.task_wrenches]
    if hasattr(request, 'half_angle'):
        request.half_angle = random.choice((0.0, 0.1, 0.5, 1.0, 1.5))
    if hasattr(request, 'resolution'):
        request.directions = request.directions if random.random() < 0.7 else []
        request.resolution = random.randint(0, 3)
    if hasattr(request, 'samples'):
        request.samples, request.quantile = random.randint(60, 80), 0.1
        request.seed = random.randrange(2 ** 64)
        request.contact_noise, request.friction_noise = 0.01 * sizes.length, 0.05
        request.normal_noise = 0.02
    if hasattr(request, 'torque_length'):
        request.external_wrench = type(request.external_wrench)()
        request.torque_length, request.relative_width = sizes.length, 0.3
        request.subspace = random.randrange(3)
        request.axes = request.axes if random.random() < 0.3 else []


def types_of(case_kind: str, source: str) -> dict[str, Any]:
    """Return the message class of each message of a case, by the beginning of its name."""
    contacts = ContactArray if source == ARRAY else PoseArray
    service = SERVICES['set_task' if case_kind == LIVE else case_kind]
    return {'request': service.Request, 'contacts': contacts, 'before': contacts,
            'task': WrenchStamped, 'load': WrenchStamped, 'measured': WrenchStamped}


def write(case: Case, path: Path) -> None:
    """Write a case to a JSON file; numbers that are none stand in it as NaN and Infinity."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({
        'rule': case.rule, 'kind': case.kind, 'settings': case.settings, 'on_wire': case.on_wire,
        'messages': {name: to_plain(message) for name, message in case.messages.items()}},
        indent=1, default=list, ensure_ascii=False) + '\n')


def read(path: Path) -> Case:
    """Read a case back."""
    plain = json.loads(path.read_text())
    settings = {name: tuple(value) if isinstance(value, list) else value
                for name, value in plain['settings'].items()}
    types = types_of(plain['kind'], settings.get('contact_source', POSES))
    return Case(plain['kind'], settings, {
        name: from_plain(types[name.partition('/')[0]], parts)
        for name, parts in plain['messages'].items()}, plain['on_wire'], plain['rule'])

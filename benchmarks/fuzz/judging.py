# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether an answer is true, in plain numpy and apart from core and adapters.

Forces are held to cones, bound and equilibrium by the rules of ``force_audit``; an alpha of a
single wrench is held to its own multiplier, which bounds it from above by weak duality; what is
not OPTIMAL has to be empty; what is refused has to be refused, by name, and nothing else.
"""

from collections.abc import Mapping
import math
import sys
from typing import Any

from benchmarks.fuzz.asking import Answer
from benchmarks.fuzz.cases import Case, LIVE
from benchmarks.fuzz.dual_bound import alpha_bound, natural_alpha
from benchmarks.fuzz.fields import all_within, numbers
from benchmarks.fuzz.refusals import CONTACTS, FRAMES, refusals, STAMPS, Words
from grasp_quality.node_settings import Settings
from grasp_quality_hand import audit_parts
from grasp_quality_hand.audit_messages import read_contacts, read_force, read_poses, six
from grasp_quality_hand.force_rules import Array, broken_balance, broken_forces, Limits
from grasp_quality_msgs.msg import ResultCode
from msg_adapters.result_codes import Code
import numpy as np

CODES = {int(code): code.name for code in Code}
ANSWERED = (ResultCode.OPTIMAL, ResultCode.INFEASIBLE)
UNSOLVED = (ResultCode.SOLVER_FAILED, ResultCode.TIMED_OUT)
GAP = 1e-6
DENORMAL = 1e-300  # below it numbers have no digits to compare
LOADED = {'contact_forces', 'holding_forces'}


def received(case: Case) -> Any:
    """Return the message that the contacts of the answer stand in."""
    request = case.messages.get('request')
    own = getattr(request, 'contacts', None)
    return own if own is not None and own.contacts else case.messages.get('contacts')


def limits_of(case: Case, settings: Settings) -> Mapping[str, Limits]:
    """Read what each contact may carry."""
    message = received(case)
    parts = read_poses(message, 0) if hasattr(message, 'poses') else read_contacts(message, 0)
    return audit_parts.limits_of(parts, audit_parts.Settings(
        settings.contact_model, settings.friction_coefficient,
        settings.torsional_friction_coefficient, settings.max_normal_force,
        settings.force_bound, settings.contact_names, settings.contact_fingers,
        settings.max_contact_age))


def result_of(case: Case, answer: Answer) -> Any:
    """Return the ResultCode that decides: of the live loop, or of the service."""
    return (answer.published['quality'][-1] if case.kind == LIVE else answer.response).result


def judge(case: Case, settings: Settings, answer: Answer) -> list[str]:
    """Return what is wrong with an answer."""
    said = []
    messages = [m for kept in answer.published.values() for m in kept]
    for message in [*messages, *([answer.response] if answer.response else [])]:
        if not all_within(message, sys.float_info.max):
            bad = [path for path, value in numbers(message) if not math.isfinite(value)]
            said.append(f'{type(message).__name__} has no number in {bad}')
    if case.kind == LIVE and [len(answer.published[t]) for t in ('quality', 'contact_forces')] != [
            1, 1]:
        return [*said, 'the live loop did not publish exactly one answer']
    said += [] if answer.passed_over else _code(case, settings, answer)
    if said or answer.passed_over:
        return said
    if result_of(case, answer).code != ResultCode.OPTIMAL:
        return _empty(case, answer)
    limits = limits_of(case, settings)
    if case.kind == LIVE:
        return _live(answer, limits, settings)
    return _service(case, answer.response, limits, settings)


def _code(case: Case, settings: Settings, answer: Answer) -> list[str]:
    result = result_of(case, answer)
    code, text = result.code, result.message
    must = refusals(case, settings)
    if code not in CODES or code in (ResultCode.UNDEFINED, ResultCode.NOT_ACTIVE):
        return [f'the code is {code}']
    if 'internal error' in text:
        return [f'it crashed: {text}']
    if code in ANSWERED and must:
        return [f'{CODES[code]}, but {must} must be refused']
    if code in (*ANSWERED, *UNSOLVED):
        return []
    if code == ResultCode.NO_CONTACTS and settings.min_contact_force > 0.0:
        return []  # none is loaded
    if not must:
        return [f'{CODES[code]} without a reason: {text}']
    return _named(code, text, must)


def _named(code: int, text: str, must: list[Words]) -> list[str]:
    own = {ResultCode.NO_CONTACTS: CONTACTS, ResultCode.STALE_CONTACTS: STAMPS,
           ResultCode.TRANSFORM_FAILED: FRAMES}.get(code)
    if own is not None:
        return [] if (own,) in must else [f'{CODES[code]} without a reason: {text}']
    if any(word in text for words in must for word in words):
        return []
    return [f'the refusal names none of {must}: {text}']


def _empty(case: Case, answer: Answer) -> list[str]:
    if case.kind != LIVE:
        response = answer.response
        blank = type(response)(result=response.result, solve_time=response.solve_time)
        if case.kind == 'minimum_forces' and response.result.code == ResultCode.INFEASIBLE:
            blank.peak = response.peak
        if hasattr(blank, 'forces') and hasattr(blank.forces, 'header'):
            blank.forces.header = response.forces.header  # a header alone is no force
        return [] if response == blank else [f'not OPTIMAL, and yet {response}']
    quality = answer.published['quality'][-1]
    said = [] if not any((quality.alpha, quality.alpha_upper, quality.alpha_lower,
                          quality.friction_margin, quality.holdable)) else [
        'quality is not OPTIMAL, and yet holds numbers']
    for topic, messages in answer.published.items():
        for message in messages:
            wrenches = topic.startswith('optimal_wrenches/') and six(message.wrench).any()
            if (topic in LOADED and message.forces) or wrenches or (
                    topic == 'alpha' and message.data):
                said.append(f'quality is not OPTIMAL, and yet {topic} is not empty')
    return said


def _forces(name: str, message: Any, limits: Mapping[str, Limits], settings: Settings,
            wanted: Array, some: bool = False) -> list[str]:
    forces = [read_force(item) for item in message.forces]
    said = broken_forces(forces, limits, settings.force_bound)
    if not some and {force.name for force in forces} != set(limits):
        said.append(f'forces of {sorted(force.name for force in forces)} only')
    said = said or broken_balance(forces, limits, wanted)
    return [f'{name}: {text}' for text in said]


def _live(answer: Answer, limits: Mapping[str, Limits], settings: Settings) -> list[str]:
    published = answer.published
    quality, = published['quality']
    alpha, task, load = quality.alpha, six(quality.task_wrench), six(quality.external_wrench)
    some = settings.min_contact_force > 0.0
    said = _forces('contact_forces', published['contact_forces'][0], limits, settings,
                   alpha * task - load, some)
    for message in published.get('holding_forces', ()):
        if message.forces:
            said += _forces('holding_forces', message, limits, settings, -load, some)
    if [message.data for message in published['alpha']] != [alpha]:
        said.append('~/alpha is not that of the quality')
    if not 0.0 <= quality.alpha_lower <= alpha * (1.0 + GAP) or alpha > quality.alpha_upper:
        said.append(f'alpha {alpha} is not between {quality.alpha_lower} and '
                    f'{quality.alpha_upper}')
    return said


def _service(case: Case, response: Any, limits: Mapping[str, Limits], settings: Settings
             ) -> list[str]:
    request = case.messages['request']
    load = six(request.external_wrench)
    kind = case.kind
    if kind == 'evaluate_task_wrench':
        task = six(request.task_wrench)
        return [*_forces('forces', response.forces, limits, settings,
                         response.alpha * task - load),
                *_bounded(case, response, limits, settings, task, load)]
    if kind == 'minimum_forces':
        return _forces('forces', response.forces, limits, settings, -load)
    if kind == 'evaluate_task_cone':
        return [*_forces('forces', response.forces, limits, settings,
                         six(response.optimal_wrench) - load), *_inside(request, response)]
    if kind == 'evaluate_task_polytope':
        return _polytope(request, response, limits, settings, load)
    if kind == 'wrench_map':
        wanted = len(request.directions) or 2 * (request.resolution or 36) ** 2
        if len(response.alphas) != wanted or min(response.alphas) < 0.0:
            return [f'{len(response.alphas)} alphas, the least {min(response.alphas)}']
    if kind == 'robust_alpha' and not (
            0.0 <= response.alpha_quantile_lower <= response.alpha_quantile
            <= response.alpha_quantile_upper and 0.0 <= response.probability_lower
            <= response.probability <= response.probability_upper <= 1.0):
        return ['intervals in disorder']
    if kind == 'ball_radius' and not 0.0 <= response.lower <= response.upper:
        return [f'the interval is {response.lower} to {response.upper}']
    return []


def _bounded(case: Case, response: Any, limits: Mapping[str, Limits], settings: Settings,
             task: Array, load: Array) -> list[str]:
    """Hold alpha to the multiplier of equilibrium that came with it."""
    alpha, upper = response.alpha, response.alpha_upper
    if not 0.0 <= response.alpha_lower <= alpha * (1.0 + GAP) or alpha > upper:
        return [f'alpha {alpha} is not between {response.alpha_lower} and {upper}']
    message = received(case)
    if getattr(message, 'joint_limits', ()):
        return []  # their multipliers do not come with the answer
    size = max(alpha, 1e-3 * natural_alpha(limits, settings.force_bound, task))
    if settings.barrier_weight == settings.alpha_reserve == 0.0 and upper - alpha > GAP * size * (
            1.0 + 1e-9):
        return [f'alpha {alpha} is OPTIMAL, but only {upper} bounds it']
    found, rounding = alpha_bound(
        limits, settings.force_bound, task, load, six(response.dalpha_dexternal_wrench))
    if not found <= upper + GAP * size + rounding:
        return [f'alpha_upper is {upper}, but its multiplier proves {found} only']
    return []


def _inside(request: Any, response: Any) -> list[str]:
    wrench, axis = six(response.optimal_wrench), six(request.axis)
    sides = np.stack([six(request.lateral_x), six(request.lateral_y)], axis=1)
    rest = wrench - response.alpha * axis
    lengths = np.linalg.norm(sides, axis=0)
    lengths[lengths == 0.0] = 1.0
    # laterals of one length: rounding would drop the shorter; as they are: parallel ones share
    witnesses = [np.linalg.lstsq(sides / lengths, rest, rcond=None)[0] / lengths,
                 np.linalg.lstsq(sides, rest, rcond=None)[0]]
    size = max(np.abs(wrench).max(), response.alpha * np.abs(axis).max())
    made = [along for along in witnesses
            if np.abs(sides @ along - rest).max() <= GAP * size + DENORMAL]
    if not made:
        return ['optimal_wrench is not made of axis and laterals']
    if min(np.hypot(*along) for along in made) > math.tan(
            request.half_angle) * response.alpha * (1.0 + GAP) + (
            GAP * size / max(np.abs(sides).max(), 1e-300)):
        return ['optimal_wrench is outside the task cone']
    return []


def _polytope(request: Any, response: Any, limits: Mapping[str, Limits], settings: Settings,
              load: Array) -> list[str]:
    tasks = [six(wrench) for wrench in request.task_wrenches]
    if not len(tasks) == len(response.alphas) == len(response.forces):
        return [f'{len(response.alphas)} alphas of {len(tasks)} wrenches']
    said = []
    for i, task in enumerate(tasks):
        said += _forces(f'forces[{i}]', response.forces[i], limits, settings,
                        response.alphas[i] * task - load)
    weights = request.weights or [1.0 / len(tasks)] * len(tasks)
    quality = sum(w * a for w, a in zip(weights, response.alphas))
    if abs(quality - response.quality) > GAP * quality or response.alpha_min != min(
            response.alphas):
        said.append('quality or alpha_min is not that of the alphas')
    return said

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What the page says, in words and as a table: HTML of nothing but what is passed in."""

from html import escape
import math

from grasp_quality import Grasp
from grasp_quality_hand.viewer_picture import Array, Picture
from grasp_quality_msgs.msg import GraspQuality, ResultCode
from msg_adapters.colours import alpha_colours, MEASURED, OPTIMAL, TASK, usage_colours
from msg_adapters.results import code_name
import numpy as np

MEANINGS = {
    ResultCode.INFEASIBLE: 'The contacts cannot hold the load at all, however hard they press.',
    ResultCode.NO_CONTACTS: 'Nothing touches the object.',
    ResultCode.STALE_CONTACTS: 'The contacts that the node has are too old.',
    ResultCode.INVALID_REQUEST: 'The node cannot use what it was given.',
    ResultCode.TRANSFORM_FAILED: 'A frame could not be brought into the object frame.',
    ResultCode.SOLVER_FAILED: 'The solver gave no answer that can be proved.',
    ResultCode.TIMED_OUT: 'The solver ran out of time.',
    ResultCode.NOT_ACTIVE: 'The node is not active.',
    ResultCode.UNDEFINED: 'The node has computed nothing yet.'}
DIGITS = 9  # of alpha, beyond which is the solver's noise about zero
GOOD, WARN, BAD = '#0072b2', '#b35900', '#7a1f1f'  # Okabe-Ito hues, dark enough for white text


def status(picture: Picture, target: str, count: int = 0) -> str:
    """Return the banner: alpha and its verdict, or why there is none; count is of updates."""
    if picture.stale or picture.quality is None:
        silent = 'nothing was heard yet' if picture.age is None else (
            f'nothing heard for {picture.age:.1f} s')
        return _banner('stale', BAD, 'STALE',
                       f'{silent} from {target}: is the node running?', count)
    quality = picture.quality
    name = code_name(quality.result.code)
    if quality.result.code != ResultCode.OPTIMAL:
        meaning = MEANINGS.get(quality.result.code, '')
        return _banner('failure', WARN, name, f'{meaning} {quality.result.message}', count)
    more = f' {picture.problem}' if picture.problem else ''
    return _banner('answer', GOOD, f'alpha {quality.alpha:.3f}', verdict(quality) + more, count)


def verdict(quality: GraspQuality) -> str:
    """Say what an OPTIMAL answer means."""
    can = 'The grasp can apply' if quality.alpha >= 1.0 else 'The grasp can only apply'
    text = f'OPTIMAL. {can} {round(quality.alpha, DIGITS):.3g} times the task'
    if quality.limiting_contact:
        text += f', limited by {quality.limiting_contact}'
    if not quality.holdable:
        text += '; without the task it would not hold the load'
    return f'{text}. {quality.result.message}'.rstrip()


def _banner(kind: str, colour: str, head: str, text: str, count: int) -> str:
    return (f'<div id="gq-status" data-kind="{kind}" data-count="{count}" '
            f'style="background:{colour};color:white;'
            'padding:8px 12px;border-radius:6px;margin:4px 8px">'
            f'<div style="font-size:22px;font-weight:700">{escape(head)}</div>'
            f'<div style="font-size:13px;line-height:1.35">{escape(text)}</div></div>')


def table(picture: Picture) -> str:
    """Return the contacts as a table."""
    grasp, quality = picture.grasp, picture.quality
    if grasp is None or quality is None:
        return '<div id="gq-table" style="margin:4px 12px;font-size:13px">no contacts</div>'
    head = ''.join(f'<th style="text-align:right;padding:2px 6px">{text}</th>' for text in (
        'optimal<br>normal [N]', 'cone used<br>[%]', 'measured<br>normal [N]',
        'slip margin<br>[%]'))
    rows = ''.join(_row(picture, grasp, quality, i) for i in range(len(grasp)))
    return ('<table id="gq-table" style="margin:4px 8px;font-size:13px;border-collapse:collapse">'
            f'<tr><th style="text-align:left;padding:2px 6px">contact</th>{head}</tr>'
            f'{rows}</table>')


def _row(picture: Picture, grasp: Grasp, quality: GraspQuality, i: int) -> str:
    normal, name = grasp.rotations[i][:, 2], grasp.names[i]
    usage = picture.usage[i]
    swatch = 'transparent' if math.isnan(usage) else css(usage_colours([usage])[0])
    mark = f'<span style="color:{swatch}">&#9632;</span> {escape(name)}'
    if name == quality.limiting_contact:
        mark = f'<b>{mark}<br>(limits)</b>'
    cells = ''.join(
        f'<td style="text-align:right;padding:2px 6px">{number(value, digits)}</td>'
        for value, digits in ((picture.optimal[i] @ normal, 2), (100.0 * usage, 0),
                              (picture.measured[i] @ normal, 2), (100.0 * picture.margins[i], 0)))
    return f'<tr><td style="padding:2px 6px;white-space:nowrap">{mark}</td>{cells}</tr>'


def number(value: float, digits: int) -> str:
    """Write a number, or a dash where there is none."""
    return '&ndash;' if math.isnan(value) else f'{value:.{digits}f}'


def legend(picture: Picture) -> str:
    """Say what the colours are, and the scale of the arrows."""
    if not picture.metres_per_newton:
        return '<div id="gq-legend"></div>'
    parts = [('optimal forces', css(OPTIMAL)), ('measured forces', css(MEASURED)),
             ('alpha x task', css(TASK))]
    keys = ' &nbsp; '.join(f'<span style="color:{colour}">&#9632;</span> {text}'
                           for text, colour in parts)
    usage = _bar(usage_colours(np.linspace(0.0, 1.0, 5)))
    surface = ''
    if picture.force_map is not None and picture.force_map.alphas:
        largest = max(picture.force_map.alphas)
        surface = (f'<br>force map: 0 {_bar(alpha_colours(np.linspace(0.0, 1.0, 11)))} '
                   f'{largest:.3g} N in its best direction')
    return (f'<div id="gq-legend" style="margin:4px 12px;font-size:12px;line-height:1.5">{keys}'
            f'<br>scale of arrows and map: {1e3 * picture.metres_per_newton:.3g} mm/N'
            f'<br>friction cones: 0 % {usage} 100 % used{surface}</div>')


def _bar(stops: Array) -> str:
    colours = ', '.join(css(colour) for colour in stops)
    return ('<span style="display:inline-block;width:60px;height:9px;'
            f'background:linear-gradient(90deg,{colours})"></span>')


def css(colour: tuple[float, float, float] | np.ndarray) -> str:
    """Write a colour of [0, 1] for a style."""
    red, green, blue = (round(255 * float(c)) for c in colour)
    return f'rgb({red},{green},{blue})'

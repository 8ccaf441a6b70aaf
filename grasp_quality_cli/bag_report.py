# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The HTML report of a replayed bag: one file that needs nothing beside it."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, UTC
from html import escape
from pathlib import Path

from grasp_quality_cli.bag_pictures import pictures
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_summary import Summary

STYLE = """
body { font: 16px/1.5 sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem;
       color: #1b1b1b; background: #fff; }
img { max-width: 100%; } table { border-collapse: collapse; margin: .6rem 0; }
th, td { text-align: left; vertical-align: top; padding: .25rem .9rem .25rem 0;
         border-bottom: 1px solid #d5d5d5; }
td.number { text-align: right; } .bad { color: #9c1c00; font-weight: bold; }
"""


def moment(time_ns: int | None) -> str:
    """Write a time of the bag for people, to the millisecond (UTC)."""
    if time_ns is None:
        return ''
    seconds, rest = divmod(time_ns, 1_000_000_000)
    return f'{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d %H:%M:%S}.{rest // 1_000_000:03d}'


def write_report(path: Path, title: str, asked: Mapping[str, str], summary: Summary,
                 problems: Problems, topics: Mapping[tuple[str, str], tuple[int, bool]]) -> None:
    """
    Write the report.

    Parameters
    ----------
    path : Path
        Of the HTML file.
    title : str
        Name of the bag.
    asked : mapping of str to str
        What was asked, in words.
    summary : Summary
        Counts and curves.
    problems : Problems
        What was wrong.
    topics : mapping
        (topic, type): number of messages, and whether they were read.

    """
    damage = [known.text for (kind, _), known in problems.kinds.items() if kind == 'damage']
    parts = [
        f'<h1>Grasp quality of {escape(title)}</h1>',
        *(f'<p class="bad">{escape(text)}</p>' for text in damage),
        _table(('asked', ''), [(name, text) for name, text in asked.items()]),
        _table(('result', 'samples', 'share', 'first reason'), [
            (code, f'{count:,}', f'{count / summary.samples:.2%}', summary.reasons.get(code, ''))
            for code, count in summary.codes.most_common()]),
        *(f'<h2>{escape(heading)}</h2><p>{escape(text)}</p><img alt="{escape(heading)}" '
          f'src="data:image/png;base64,{b64encode(png).decode()}">'
          for heading, text, png in pictures(summary)),
        f'<h2>Problems: {problems.count:,}</h2>',
        '<p>Every one stands in problems.csv. Times are UTC, as recorded.</p>',
        _table(('kind', 'topic', 'count', 'first', 'last', 'what (of the first)'), [
            (kind, topic, f'{known.count:,}', moment(known.first_ns), moment(known.last_ns),
             known.text) for (kind, topic), known in problems.kinds.items()]),
        '<h2>Topics of the bag</h2>',
        _table(('topic', 'type', 'messages', 'read'), [
            (topic, kind, f'{count:,}', 'yes' if read else 'no: not an input of the node')
            for (topic, kind), (count, read) in sorted(topics.items())])]
    path.write_text(
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}'
        f'</title><style>{STYLE}</style></head><body>\n' + '\n'.join(parts) + '</body></html>\n',
        encoding='utf-8')


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Write a table; numbers stand to the right."""
    lines = [''.join(
        f'<td{" class=number" if cell[:1].isdigit() and name not in ("first", "last") else ""}>'
        f'{escape(cell)}</td>' for name, cell in zip(head, row)) for row in rows]
    if not lines:
        return '<p>None.</p>'
    top = ''.join(f'<th>{escape(name)}</th>' for name in head)
    return f'<table><tr>{top}</tr>' + ''.join(f'<tr>{line}</tr>' for line in lines) + '</table>'

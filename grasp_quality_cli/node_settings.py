# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The node's parameters without a node: from a ROS parameter file and from name=value."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from grasp_quality.node_parameters import TABLE, Type
from grasp_quality.node_settings import Settings
from grasp_quality_cli.source_item import SourceItem
from grasp_quality_cli.task_text import ArgumentError
from grasp_quality_cli.yaml_source import load_yaml, YamlItem
import yaml

PARAMETERS = 'ros__parameters'
BOOLEANS = {'true': True, 'false': False}


def read_settings(path: Path | None, assignments: Sequence[str], node: str, source: str = ''
                  ) -> Settings:
    """
    Read parameters as the node would have them.

    Parameters
    ----------
    path : Path or None
        ROS parameter file; its sections /** and that of the node count.
    assignments : sequence of str
        name=value, which win; lists with commas.
    node : str
        Full name of the node.
    source : str
        contact_source where neither of them names it.

    Raises
    ------
    FileError, ArgumentError

    """
    values: dict[str, Any] = {'contact_source': source} if source else {}
    if path is not None:
        values.update(_from_file(load_yaml(path), node))
    for assignment in assignments:
        name, sign, text = assignment.partition('=')
        if not sign or name not in TABLE:
            raise ArgumentError(
                f'--set must be name=value with a parameter of the node ({", ".join(TABLE)}), '
                f'got {assignment!r}')
        values[name] = _value(_argument(name, text))
    try:
        return Settings(**values)
    except ValueError as exc:
        raise ArgumentError(f'the parameters do not fit each other: {exc}') from exc


def _from_file(source: SourceItem, node: str) -> dict[str, Any]:
    sections = source.named_items()
    found: dict[str, Any] = {}
    used = [key for key in ('/**', node.lstrip('/').rpartition('/')[2], node) if key in sections]
    if not used:
        source.fail(f'must have a section /** or {node}, got {", ".join(sections) or "none"}')
    for key in used:
        parameters = sections[key].fields((PARAMETERS,), required=(PARAMETERS,))[PARAMETERS]
        found.update({item.name.rpartition('.')[2]: _value(item)
                      for item in parameters.fields(tuple(TABLE)).values()})
    return found


def _argument(name: str, text: str) -> YamlItem:
    """Make what stands on the command line an item like that of a file."""
    if TABLE[name][0] in (Type.DOUBLE_ARRAY, Type.STRING_ARRAY):
        words = text.strip('[]').replace(',', ' ').split()
        node = yaml.SequenceNode('', [_scalar(word) for word in words])
    else:
        node = _scalar(text)
    node.start_mark = yaml.Mark('', 0, 0, 0, None, 0)
    return YamlItem('--set', name, node)


def _scalar(text: str) -> yaml.ScalarNode:
    return yaml.ScalarNode('', text, yaml.Mark('', 0, 0, 0, None, 0))


def _value(item: SourceItem) -> Any:
    """Read a value by the type of its parameter, inside its range."""
    kind, _, limits, _ = TABLE[item.name.rpartition('.')[2]]
    if kind is Type.BOOL:
        return BOOLEANS[item.choice(tuple(BOOLEANS))]
    if kind is Type.STRING:
        return item.text()
    if kind is Type.STRING_ARRAY:
        return tuple(word.text() for word in item.items())
    if kind is Type.DOUBLE_ARRAY:
        return tuple(number.number() for number in item.items())
    number = item.number()
    if kind is Type.INTEGER and not number.is_integer():
        item.fail(f'must be a whole number, got {number:g}')
    if limits is not None and not limits[0] <= number <= limits[1]:
        item.fail(f'must be from {limits[0]:g} to {limits[1]:g}, got {number:g}')
    return int(number) if kind is Type.INTEGER else number

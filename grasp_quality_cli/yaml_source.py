# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
YAML with its line numbers: every value knows its file, line and name, and complains with them.

Loaded as plain nodes (no tags are obeyed, no objects are built), so that a file from elsewhere can
do no more than be wrong.
"""

from __future__ import annotations

from dataclasses import dataclass
import math
from pathlib import Path

from grasp_quality_cli.source_item import FileError, SourceItem, WHOLE
import yaml

LARGEST_FILE = 1 << 20  # bytes, some ten thousand contacts; a file without end ends there


@dataclass(frozen=True)
class YamlItem(SourceItem):
    """
    One value of a YAML file.

    Attributes
    ----------
    file : str
        As the user named it.
    name : str
        Where it stands, such as contacts[1].friction.
    node : yaml.Node

    """

    file: str
    name: str
    node: yaml.Node

    @property
    def line(self) -> int:
        """Line in the file, from 1."""
        return int(self.node.start_mark.line) + 1

    def named_items(self) -> dict[str, SourceItem]:
        """Read a mapping with keys of the user's choice."""
        if not isinstance(self.node, yaml.MappingNode):
            self.fail(f'must be a mapping (name: value), got {self._got()}')
        found: dict[str, SourceItem] = {}
        for key, value in self.node.value:
            item = YamlItem(self.file, self.below(str(key.value)), value)
            if str(key.value) in found:
                item.fail('is given twice')
            found[str(key.value)] = item
        return found

    def items(self) -> list[SourceItem]:
        """Read a list."""
        if not isinstance(self.node, yaml.SequenceNode):
            self.fail(f'must be a list, got {self._got()}')
        return [YamlItem(self.file, f'{self.name}[{i}]', node)
                for i, node in enumerate(self.node.value)]

    def text(self) -> str:
        """Read a string."""
        if not isinstance(self.node, yaml.ScalarNode):
            self.fail(f'must be a single value, got {self._got()}')
        return self.checked_text(str(self.node.value))

    def number(self) -> float:
        """Read a finite number; 1e-3 is one, unlike in YAML 1.1."""
        text = self.text()
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            self.fail(f'must be a finite number, got {text!r}')
        return value

    def _got(self) -> str:
        if isinstance(self.node, yaml.ScalarNode):
            return repr(self.node.value) if self.node.value else 'nothing'
        return 'a list' if isinstance(self.node, yaml.SequenceNode) else 'a mapping'


def load_yaml(path: Path | str) -> YamlItem:
    """Load the one document of a YAML file: read_text and parse_yaml."""
    return parse_yaml(read_text(path), path)


def read_text(path: Path | str) -> str:
    """
    Read a file of UTF-8 text, of one that has no end no more than ``LARGEST_FILE``.

    Raises
    ------
    FileError
        When it cannot be read, is larger, or is no such text.

    """
    try:
        with open(path, 'rb') as file:
            content = file.read(LARGEST_FILE + 1)
        if len(content) > LARGEST_FILE:
            raise FileError(
                f'{path}: must be at most {LARGEST_FILE:,} bytes large, and is larger, or has no '
                'end: give one grasp a file, or many to grasp-quality study, one a row')
        return content.decode()
    except OSError as exc:
        raise FileError(f'{path}: cannot be read: {exc.strerror}') from exc
    except UnicodeDecodeError as exc:
        raise FileError(f'{path}: is not a text file in UTF-8: {exc}') from exc


def parse_yaml(text: str, path: Path | str) -> YamlItem:
    """
    Read the one document of a text that is YAML; ``path`` is for complaints.

    Raises
    ------
    FileError
        When it is not YAML, or is empty.

    """
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
    except RecursionError as exc:
        raise FileError(f'{path}: is not YAML: it is nested too deeply') from exc
    except yaml.MarkedYAMLError as exc:
        mark = exc.problem_mark or exc.context_mark
        where = f'{path}:{mark.line + 1}' if mark else str(path)
        raise FileError(f'{where}: is not YAML: {exc.problem or exc.context}') from exc
    except (yaml.YAMLError, ValueError, OverflowError) as exc:  # as of \\UFFFFFFFF
        raise FileError(f'{path}: is not YAML: {exc}') from exc
    if node is None:
        raise FileError(f'{path}:1: is empty')
    return YamlItem(str(path), WHOLE, node)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Rows of a dataset, lines of JSON or of a table: every value knows its file, line and name.

A value of null counts as not there, because tables have a place for every field in every row.
"""

from __future__ import annotations

from dataclasses import dataclass
import json
import math
from typing import Any

from grasp_quality_cli.source_item import FileError, ROW, SourceItem

SHOWN = 60  # characters of a wrong value


@dataclass(frozen=True)
class JsonItem(SourceItem):
    """
    One value of a row.

    Attributes
    ----------
    file : str
        As the user named it.
    name : str
        Where it stands, such as contacts[1].friction.
    row : int
        Line in the file, or row of the table, from 1.
    value : object
        dict, list, str, int, float, bool or None.

    """

    file: str
    name: str
    row: int
    value: Any

    @property
    def line(self) -> int:
        """Line in the file, or row of the table, from 1."""
        return self.row

    def named_items(self) -> dict[str, SourceItem]:
        """Read a mapping with keys of the user's choice."""
        if not isinstance(self.value, dict):
            self.fail(f'must be a mapping, got {self._got()}')
        return {key: JsonItem(self.file, self.below(key), self.row, value)
                for key, value in self.value.items() if value is not None}

    def items(self) -> list[SourceItem]:
        """Read a list."""
        if not isinstance(self.value, list):
            self.fail(f'must be a list, got {self._got()}')
        return [JsonItem(self.file, f'{self.name}[{i}]', self.row, value)
                for i, value in enumerate(self.value)]

    def text(self) -> str:
        """Read a string."""
        if not isinstance(self.value, str):
            self.fail(f'must be a text, got {self._got()}')
        return self.checked_text(self.value)

    def number(self) -> float:
        """Read a finite number."""
        value = math.nan
        if isinstance(self.value, (int, float)) and not isinstance(self.value, bool):
            try:
                value = float(self.value)
            except OverflowError:
                value = math.inf
        if not math.isfinite(value):
            self.fail(f'must be a finite number, got {self._got()}')
        return value

    def _got(self) -> str:
        shown = repr(self.value)
        return shown if len(shown) <= SHOWN else shown[:SHOWN] + ' ...'


def parse_line(file: str, row: int, line: bytes) -> JsonItem:
    """
    Read one line of JSON.

    Raises
    ------
    FileError

    """
    try:
        value = json.loads(line, object_pairs_hook=_without_doubles)
    except RecursionError as exc:
        raise FileError(f'{file}:{row}: is not JSON: it is nested too deeply') from exc
    except ValueError as exc:  # JSONDecodeError and UnicodeDecodeError too
        raise FileError(f'{file}:{row}: is not JSON: {exc}') from exc
    return JsonItem(file, ROW, row, value)


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(pairs)
    if len(fields) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(
            f'field {next(n for n in names if names.count(n) > 1)!r} is given twice')
    return fields

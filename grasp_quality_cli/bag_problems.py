# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What was wrong in a bag, with time stamps: all of it in problems.csv, a summary in memory.

Written as it is found, so that a bag full of bad messages takes no more memory than a good one.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

COLUMNS = ('time_ns', 'kind', 'topic', 'text')


@dataclass
class Kind:
    """
    Problems of one kind on one topic.

    Attributes
    ----------
    count : int
    first_ns, last_ns : int or None
        When, since the epoch; None where it belongs to no message.
    text : str
        Of the first.

    """

    count: int
    first_ns: int | None
    last_ns: int | None
    text: str


class Problems:
    """Collects problems; a context manager around its file."""

    def __init__(self, path: Path) -> None:
        self.kinds: dict[tuple[str, str], Kind] = {}
        self._file = path.open('w', newline='', encoding='utf-8')
        self._writer = csv.writer(self._file)
        self._writer.writerow(COLUMNS)

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, exc: BaseException | None,
                 trace: TracebackType | None) -> None:
        """Close the file."""
        self._file.close()

    def add(self, kind: str, topic: str, text: str, time_ns: int | None = None) -> None:
        """Note one problem."""
        self._writer.writerow(('' if time_ns is None else time_ns, kind, topic, text))
        known = self.kinds.get((kind, topic))
        if known is None:
            self.kinds[kind, topic] = Kind(1, time_ns, time_ns, text)
        else:
            known.count += 1
            known.last_ns = time_ns

    @property
    def count(self) -> int:
        """How many there are."""
        return sum(kind.count for kind in self.kinds.values())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
One value of a file that a user wrote: it knows where it stands, and complains with that.

What grasps and tasks are made of is read through this, whatever the file's format: ``yaml_source``
and ``json_source`` say what a mapping, a list and a single value are there.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NoReturn

from grasp_quality.exceptions import GraspQualityError
import numpy as np
from numpy.typing import NDArray

WHOLE, ROW = 'file', 'row'  # name of the outermost value


class FileError(GraspQualityError, ValueError):
    """A file breaks a rule; the text names file, line, field, rule and value."""


class SourceItem(ABC):
    """
    One value of a file.

    Attributes
    ----------
    file : str
        As the user named it.
    name : str
        Where it stands, such as contacts[1].friction.

    """

    file: str
    name: str

    @property
    @abstractmethod
    def line(self) -> int:
        """Line in the file, from 1."""

    @abstractmethod
    def named_items(self) -> dict[str, SourceItem]:
        """Read a mapping with keys of the user's choice."""

    @abstractmethod
    def items(self) -> list[SourceItem]:
        """Read a list."""

    @abstractmethod
    def text(self) -> str:
        """Read a string."""

    @abstractmethod
    def number(self) -> float:
        """Read a finite number."""

    def fail(self, rule: str) -> NoReturn:
        """Raise the FileError of this value: it must be so, but is not."""
        raise FileError(f'{self.file}:{self.line}: {self.name} {rule}')

    def checked_text(self, text: str) -> str:
        """Return a text that can be printed and stored: half a character cannot."""
        try:
            text.encode()
        except UnicodeEncodeError:
            self.fail(f'must be text of whole Unicode characters, got {text!a}')
        return text

    def below(self, key: str) -> str:
        """Name of a field of this value."""
        return key if self.name in (WHOLE, ROW) else f'{self.name}.{key}'

    def fields(self, allowed: Sequence[str], required: Sequence[str] = ()
               ) -> dict[str, SourceItem]:
        """Read a mapping whose keys are among ``allowed``."""
        found = self.named_items()
        for key, item in found.items():
            if key not in allowed:
                item.fail(f'is not known here; known are {", ".join(allowed)}')
        for key in required:
            if key not in found:
                self.fail(f'must have the field {key}; known are {", ".join(allowed)}')
        return found

    def numbers(self, count: int, meaning: str) -> NDArray[np.float64]:
        """Read a list of so many numbers; ``meaning`` says which, such as fx fy fz."""
        items = self.items()
        if len(items) != count:
            self.fail(f'must hold {count} numbers ({meaning}), got {len(items)}')
        return np.array([item.number() for item in items])

    def choice(self, choices: Sequence[str]) -> str:
        """Read one of several words."""
        text = self.text()
        if text not in choices:
            self.fail(f'must be one of {", ".join(choices)}, got {text!r}')
        return text

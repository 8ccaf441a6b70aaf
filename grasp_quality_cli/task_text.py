# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What stands behind ``--task``, ``--external-wrench`` and ``--output``: numbers, names, files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasp_quality import GraspQualityError, TaskWrench
from grasp_quality_cli.grasp_file import read_task, Task
from grasp_quality_cli.yaml_source import load_yaml
import numpy as np
from numpy.typing import NDArray

_TASK_HELP = (
    'What the grasp shall do: six numbers "fx fy fz tx ty tz" [N, N m] about the origin of the '
    'object frame{}, or a YAML file with one task (wrench, cone, polytope or ellipsoid).')
TASK_HELP = _TASK_HELP.format(', the name of a task in the grasp file')
NAMELESS_TASK_HELP = _TASK_HELP.format('')
LOAD_HELP = (
    'What the world does on the object besides the fingers, such as gravity: six numbers '
    '"fx fy fz tx ty tz" [N, N m] about the origin of the object frame.')


class ArgumentError(GraspQualityError, ValueError):
    """An argument of the command line breaks a rule; the text names argument, rule and value."""


def chosen_task(text: str | None, named: Mapping[str, Task] | None) -> Task:
    """
    Read ``--task``; without it, take the only task of the grasp file.

    Parameters
    ----------
    text : str or None
        As given on the command line.
    named : mapping of str to task or None
        Tasks of the grasp file; None where there is no such file.

    Raises
    ------
    ArgumentError, FileError, InvalidTaskError

    """
    there = f'the grasp file has {", ".join(named)}' if named else 'the grasp file has none'
    by_name = '' if named is None else f', the name of a task ({there})'
    named = named or {}
    if text is None:
        if len(named) == 1:
            return next(iter(named.values()))
        raise ArgumentError(
            f'--task must say which task: give "fx fy fz tx ty tz" or a name ({there})')
    if text in named:
        return named[text]
    if text.endswith(('.yaml', '.yml')):
        return read_task(load_yaml(Path(text)))
    return TaskWrench(six_numbers(
        text, '--task', f'{by_name}, or a .yaml file with a task'))


def chosen_load(text: str | None, otherwise: NDArray[np.float64] | None
                ) -> NDArray[np.float64] | None:
    """Read ``--external-wrench`` (6,) [N, N m]; without it, what the grasp file says."""
    return otherwise if text is None else six_numbers(text, '--external-wrench')


def six_numbers(text: str, name: str, alternatives: str = '') -> NDArray[np.float64]:
    """Read fx fy fz tx ty tz, with spaces or commas between."""
    try:
        numbers = np.array([float(word) for word in text.replace(',', ' ').split()])
    except ValueError:
        numbers = np.zeros(0)
    if numbers.shape != (6,) or not np.isfinite(numbers).all():
        raise ArgumentError(
            f'{name} must be six finite numbers "fx fy fz tx ty tz" [N, N m]{alternatives}, '
            f'got {text!r}')
    return numbers


def require_folder(output: Path) -> None:
    """Raise ArgumentError where the folder of a file for ``--output`` is missing."""
    if not output.absolute().parent.is_dir():
        raise ArgumentError(f'--output {output}: there is no folder {output.parent}')


def make_folder(output: Path) -> None:
    """Make the folder ``--output``; ArgumentError where something else has its name."""
    try:
        output.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError) as exc:
        raise ArgumentError(f'--output {output}: must be a folder, but {exc.filename} is a file'
                            ) from exc

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The bag that the demo records, and the parameters that belong to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from grasp_quality_hand.demo_processes import ChildProcess, DemoFailure, executable


@contextmanager
def recording(output: Path, parameters: Mapping[str, object]) -> Iterator[None]:
    """
    Record what the node hears to output/bag, its parameters to output/parameters.yaml.

    Parameters
    ----------
    output : Path
        Folder of the demo.
    parameters : mapping of str to object
        Of the node, written as on its command line.

    Raises
    ------
    DemoFailure
        When the recorder did not end well.

    """
    lines = ''.join(f'    {name}: {value}\n' for name, value in parameters.items())
    (output / 'parameters.yaml').write_text(f'grasp_quality:\n  ros__parameters:\n{lines}')
    bag, log = output / 'bag', output / 'recorder.log'
    recorder = ChildProcess('the recorder', [
        executable('grasp_quality_hand', 'bag_recorder'), bag, '--overwrite'], log)
    try:
        yield
    finally:
        code = recorder.end()
    if code:
        raise DemoFailure(f'the recorder ended with exit code {code}; see {log}')
    print(f'\nRecorded: {bag}; to evaluate it, with or without ROS:\n'
          f'  grasp-quality bag {bag} --params {output / "parameters.yaml"} '
          '--task "0 0 1 0 0 0"', flush=True)

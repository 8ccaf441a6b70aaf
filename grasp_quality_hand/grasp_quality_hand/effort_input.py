# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
The effort commands that a hand's driver gets, and its watchdog.

A command counts for `timeout` seconds. Between the driver's own controller and the commands the
torques go over in HANDOVER_TIME, so that neither end of a stream jerks. All times are simulated.

"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

HANDOVER_TIME = 0.1          # from the one source of torques to the other [s]
COMMAND_TIMEOUT = 0.1        # [s]

Vector = NDArray[np.float64]


class BadCommand(ValueError):
    """An effort command that cannot be used; the message says why."""


class EffortInput:
    """The newest effort command of a hand, and how much of it counts."""

    def __init__(self, joint_names: Sequence[str], timeout: float = COMMAND_TIMEOUT) -> None:
        self._joint_names = tuple(joint_names)
        self._timeout = timeout
        self._command: Vector | None = None
        self._arrived = -np.inf
        self._share = 0.0

    @property
    def share(self) -> float:
        """Return the share of the commands in the torques, in [0, 1]."""
        return self._share

    def is_fresh(self, now: float) -> bool:
        """Return whether the newest command still counts at the time now, in seconds."""
        return now - self._arrived <= self._timeout

    def put(self, efforts: Sequence[float], now: float) -> None:
        """
        Take a command.

        Parameters
        ----------
        efforts : sequence of float
            One a joint, in the order of the joint names [N m].
        now : float
            When it came [s].

        Raises
        ------
        BadCommand
            The length is wrong or a number is not finite; the command before it stays.

        """
        command = np.array(efforts, dtype=np.float64)
        if command.shape != (len(self._joint_names),):
            raise BadCommand(f'{command.size} efforts came for {len(self._joint_names)} joints: '
                             f'send one each for {", ".join(self._joint_names)}')
        if not np.isfinite(command).all():
            joint = self._joint_names[int(np.flatnonzero(~np.isfinite(command))[0])]
            raise BadCommand(f'the effort of {joint} is not finite: send newton metres')
        self._command, self._arrived = command, now

    def forget(self) -> None:
        """Forget every command at once: a hand that is told to open must not be pressed shut."""
        self._command, self._arrived, self._share = None, -np.inf, 0.0

    def mix(self, own: Vector, now: float, timestep: float) -> Vector:
        """
        Return the torques of one time step, shape (n,) [N m].

        Parameters
        ----------
        own : ndarray, shape (n,)
            What the driver's own controller wants [N m].
        now : float
            [s]
        timestep : float
            That has passed since the last call [s].

        """
        change = timestep / HANDOVER_TIME * (1.0 if self.is_fresh(now) else -1.0)
        self._share = float(np.clip(self._share + change, 0.0, 1.0))
        if self._command is None or self._share == 0.0:
            return own
        return own + self._share * (self._command - own)

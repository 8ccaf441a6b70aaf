# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Limits of the hand's joints: which contact forces its motors can produce.

A finger that pushes the object with the local forces x needs the motor torques
tau = J^T f + tau_g = T x + tau_g (docs/derivations.md), and every motor obeys
|tau_j| <= tau_max,j: the extension that the paper's conclusion names. T comes from the hand's
Jacobians and tau_g from gravity on its links; both hold for one posture of the hand.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from grasp_quality.arrays import checked, frozen, SMALLEST
from grasp_quality.exceptions import InvalidGraspError
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
SLIGHT = 1e-6   # excess over a limit that counts as a solver's inaccuracy
TINY = 1e-300
SMALL_SHARE = 1e-3  # of a joint's largest load by the caps: a limit below it is a small number


@dataclass(frozen=True, eq=False)
class JointLimits:
    """
    Torque limits of the joints that press the contacts of one grasp.

    Parameters
    ----------
    names : sequence of str
        Of the joints, unique and not empty.
    max_torques : (j,) array_like [N m] (or [N] for a sliding joint)
        Largest torque of each motor in either direction, greater than 0.
    torque_matrix : (j, k, 4) array_like [N m per N; for the last coordinate N m per N m]
        T = J^T: motor torque of each joint for a unit of [t1, t2, n, m_n] of each contact, in its
        contact frame, of the finger on the object. In the order of the grasp's contacts.
    gravity_torques : (j,) array_like [N m], optional
        tau_g: motor torque that carries the hand's own links; zero when left out.

    Raises
    ------
    InvalidGraspError

    """

    names: tuple[str, ...]
    max_torques: Array
    torque_matrix: Array
    gravity_torques: Array = None  # type: ignore[assignment]  # never None once made

    def __post_init__(self) -> None:
        """Validate and copy."""
        if not isinstance(self.names, Iterable):
            raise InvalidGraspError(f'joint names must be a list, got {self.names!r}')
        names = tuple(self.names)
        count = len(names)
        if not count or not all(isinstance(n, str) and n for n in names):
            raise InvalidGraspError(f'joint names must be words, at least one, got {names!r}')
        if len(set(names)) < count:
            raise InvalidGraspError(f'joint names must be unique, got {list(names)}')
        limits = checked(self.max_torques, (count,), 'max_torques', InvalidGraspError)
        if limits.min() < SMALLEST:
            raise InvalidGraspError(
                f'max_torques must be greater than 0, got {limits.tolist()}: leave out a joint '
                'whose torque is not limited')
        matrix = checked(
            self.torque_matrix, (count, None, 4), 'torque_matrix', InvalidGraspError)
        gravity = np.zeros(count) if self.gravity_torques is None else self.gravity_torques
        gravity = checked(gravity, (count,), 'gravity_torques', InvalidGraspError)
        for field, value in (('names', names), ('max_torques', limits),
                             ('torque_matrix', matrix), ('gravity_torques', gravity)):
            object.__setattr__(self, field, value)

    @staticmethod
    def of_jacobians(names: Sequence[str], max_torques: ArrayLike, jacobians: ArrayLike,
                     rotations: ArrayLike,
                     gravity_torques: ArrayLike | None = None) -> 'JointLimits':
        """
        Make limits from Jacobians, in whatever axes they stand.

        Parameters
        ----------
        names, max_torques, gravity_torques
            As above.
        jacobians : (j, k, 6) array_like [m/rad, rad/rad]
            Twist [v, omega] of each contact point for a unit of each joint's velocity.
        rotations : (k, 3, 3) array_like
            Contact frames, in the axes of the twists.

        """
        twists = checked(jacobians, (None, None, 6), 'jacobians', InvalidGraspError)
        frames = checked(rotations, (twists.shape[1], 3, 3), 'rotations', InvalidGraspError)
        matrix = np.empty((*twists.shape[:2], 4))
        matrix[..., :3] = np.einsum('jkx,kxt->jkt', twists[..., :3], frames)
        matrix[..., 3] = np.einsum('jkx,kx->jk', twists[..., 3:], frames[..., 2])
        return JointLimits(
            tuple(names), max_torques, matrix, gravity_torques)  # type: ignore[arg-type]

    def __len__(self) -> int:
        """Count the joints."""
        return len(self.names)

    @property
    def holds_itself(self) -> bool:
        """Whether the motors can carry the hand's own links, with no contact force at all."""
        return bool((np.abs(self.gravity_torques) <= self.max_torques).all())

    def torques(self, forces: Array) -> Array:
        """Motor torques T x + tau_g (j,) [N m] of local contact forces (k, 4)."""
        return np.asarray(
            np.einsum('jki,ki->j', self.torque_matrix, forces) + self.gravity_torques)

    def usage(self, forces: Array) -> Array:
        """Share |tau_j| / tau_max,j of each limit (j,) that local contact forces (k, 4) take."""
        return np.asarray(np.abs(self.torques(forces)) / self.max_torques)

    def subset(self, contacts: Sequence[int]) -> 'JointLimits':
        """Return the limits of the same joints for some of the contacts, by their indices."""
        return JointLimits(self.names, self.max_torques,
                           self.torque_matrix[:, list(contacts)], self.gravity_torques)

    def scaled(self, factor: float) -> 'JointLimits':
        """Return the limits of a grasp all of whose forces are multiplied by a factor."""
        return JointLimits(
            self.names, self.max_torques * factor, self.torque_matrix,
            self.gravity_torques * factor)


def check_limits(limits: JointLimits | None, contact_names: Sequence[str]) -> None:
    """Refuse joint limits that are not for these contacts, or that share a name with one."""
    if limits is None:
        return
    if not isinstance(limits, JointLimits):
        raise InvalidGraspError(f'joint_limits must be a JointLimits, got {limits!r}')
    count = limits.torque_matrix.shape[1]
    if count != len(contact_names):
        raise InvalidGraspError(
            f'joint_limits.torque_matrix must be for the {len(contact_names)} contacts of the '
            f'grasp, got {count}')
    both = sorted(set(limits.names) & set(contact_names))
    if both:
        raise InvalidGraspError(f'a joint and a contact must not share a name, got {both}: '
                                'limiting_contact would not tell them apart')


def refuse_limits(limits: JointLimits | None, who: str) -> None:
    """Refuse joint limits where they would be passed over in silence."""
    if limits is not None:
        raise InvalidGraspError(
            f'{who} knows caps and friction cones only, but the grasp has joint_limits: ask '
            'evaluate() for single wrenches, or leave them out')


@dataclass(frozen=True, eq=False)
class JointRows:
    """
    Joint limits in the scaled units of a grasp: |A y + g| <= b, y the shares of the caps.

    Each joint is divided by its limit: its equation then holds to a share of that, as the proof
    demands, and however large the limit is, no number is.

    Parameters
    ----------
    limits : JointLimits
    force_units : (k, 4) array [N, N, N, N m]
        Local forces that a share of one stands for.

    """

    limits: JointLimits
    force_units: Array

    @cached_property
    def units(self) -> Array:
        """Torque (j,) [N m] that one scaled unit of each joint stands for."""
        loads = np.abs(self._loads).sum(axis=(1, 2))
        sizes = [SMALL_SHARE * loads, self.limits.max_torques, np.abs(self.limits.gravity_torques)]
        return frozen(np.max(sizes, axis=0))

    @property
    def _loads(self) -> Array:
        return np.asarray(self.limits.torque_matrix * self.force_units)  # (j, k, 4)

    @cached_property
    def A(self) -> Array:
        """Scaled torque (j, 4 k) of each share [t1/mu, t2/mu, n, m_n/gamma] / f_max."""
        return frozen((self._loads / self.units[:, None, None]).reshape(len(self.limits), -1))

    @cached_property
    def g(self) -> Array:
        """Scaled gravity torque (j,)."""
        return frozen(self.limits.gravity_torques / self.units)

    @cached_property
    def b(self) -> Array:
        """Scaled limit (j,)."""
        return frozen(self.limits.max_torques / self.units)

    @cached_property
    def pressing(self) -> Array:
        """Scaled torque (j,) of a common share of all caps, pressed along the normals."""
        return frozen(self.A.reshape(len(self.limits), -1, 4)[:, :, 2].sum(axis=1))

    def usage(self, shares: Array, press: float = 0.0) -> Array:
        """Use (j,) of each limit by shares (k, 4) and a common press on top of them."""
        torques = self.A @ shares.ravel() + self.g + self.pressing * press
        return np.asarray(np.abs(torques) / self.b + press)

    def shrinkage(self, shares: Array, press: float = 0.0) -> float:
        """
        Divisor >= 1 that brings forces back which exceed limits by a solver's inaccuracy.

        On the way from y to no force at all the torque goes straight to that of gravity, which
        has to be inside itself.

        """
        if not self.limits.holds_itself:
            return 1.0
        pushed = self.A @ shares.ravel() + self.pressing * press
        divisor = 1.0
        for sign in (1.0, -1.0):
            ahead, room = sign * pushed + self.b * press, self.b - sign * self.g
            over = ahead > room
            if over.any():
                divisor = max(divisor, float((ahead[over] / np.maximum(room[over], TINY)).max()))
        return divisor if divisor <= 1.0 + SLIGHT else 1.0

    def cost(self, worths: Array, spreads: Array) -> float:
        """Dual value b . spread - g . mu of signed multipliers mu (j,), spread >= |mu|."""
        return float(self.b @ spreads - self.g @ worths)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The grasp as it was measured, and when it counts as settled."""

from dataclasses import dataclass

from grasp_quality_hand.demo_processes import DemoFailure
import numpy as np

GRAVITY = 9.81               # [m/s^2]
SETTLE_DEADLINE = 20.0       # [s]
SAMPLES = 30                 # that must agree, at 100 Hz
LOADED = 0.1                 # normal force of a finger that takes part [N]
STEADY = 0.01                # largest change of a force among the samples, of the largest one
BALANCED = 0.02              # largest mismatch between the forces' sum and the weight


@dataclass(frozen=True)
class MeasuredGrasp:
    """
    One sample of all fingers, in the object frame.

    Attributes
    ----------
    fingers : tuple of str
    positions : ndarray, shape (k, 3)
        [m]
    rotations : ndarray, shape (k, 3, 3)
        Object frame <- contact frame, +z inward.
    forces : ndarray, shape (k, 4)
        [t1, t2, n, m_n] of finger on object, contact frames [N, N, N, N m].
    weight : ndarray, shape (3,)
        The object's weight times the up direction, that is what the fingers must give [N].

    """

    fingers: tuple
    positions: np.ndarray
    rotations: np.ndarray
    forces: np.ndarray
    weight: np.ndarray

    @property
    def forces_in_object_frame(self):
        """Return the force of each finger along the object's axes, shape (k, 3) [N]."""
        return np.einsum('kij,kj->ki', self.rotations, self.forces[:, :3])

    @property
    def imbalance(self):
        """Return how far the sum of the forces is from the weight, relative to the weight."""
        missing = self.forces_in_object_frame.sum(axis=0) - self.weight
        return float(np.linalg.norm(missing) / np.linalg.norm(self.weight))


def grasp_anew(client):
    """Let the hand take the object once more, and return the MeasuredGrasp at rest."""
    client.trigger('load_object')
    client.forget()
    client.trigger('close')
    return wait_until_settled(client)


def wait_until_settled(client):
    """
    Listen until the fingers hold the object at rest.

    Returns
    -------
    MeasuredGrasp
        The newest sample.

    """
    settled = []

    def look():
        samples = _samples(client)
        if samples and all(_carries(sample) for sample in samples) and _steady(samples):
            settled.append(samples[-1])
        return settled

    client.listen_until(look, SETTLE_DEADLINE,
                        'the grasp did not come to rest with all fingers loaded and their forces '
                        'in balance with the weight')
    return settled[0]


def rotation(quaternion):
    """Return the rotation matrix of a unit quaternion (x, y, z, w)."""
    x, y, z, w = quaternion
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * w * K + 2.0 * K @ K


def newest_sample(client):
    """Return the MeasuredGrasp of the newest stamp that all fingers are heard of, or None."""
    heard = client.heard
    for stamp in sorted(heard.poses, reverse=True):
        if len(heard.wrenches.get(stamp, ())) == len(client.fingers):
            return _sample(client, stamp)
    return None


def _samples(client):
    """Return the newest SAMPLES complete samples; none when there are fewer."""
    heard = client.heard
    complete = sorted(stamp for stamp in heard.poses
                      if len(heard.wrenches.get(stamp, ())) == len(client.fingers))[-SAMPLES:]
    if len(complete) < SAMPLES or heard.up is None or heard.mass is None:
        return []
    return [_sample(client, stamp) for stamp in complete]


def _sample(client, stamp):
    """Return what was heard under one stamp."""
    heard = client.heard
    poses = heard.poses[stamp]
    if len(poses) != len(client.fingers):
        raise DemoFailure(f'{len(poses)} contact poses came for {len(client.fingers)} fingers')
    return MeasuredGrasp(
        fingers=client.fingers, positions=poses[:, :3],
        rotations=np.array([rotation(quaternion) for quaternion in poses[:, 3:]]),
        forces=np.array([heard.wrenches[stamp][finger] for finger in client.fingers]),
        weight=heard.mass * GRAVITY * heard.up)


def _carries(sample):
    """Return whether every finger is loaded and all together carry the weight."""
    return sample.forces[:, 2].min() > LOADED and sample.imbalance < BALANCED


def _steady(samples):
    """Return whether the forces keep still."""
    forces = np.array([sample.forces_in_object_frame for sample in samples])
    return np.ptp(forces, axis=0).max() < STEADY * np.abs(forces).max()

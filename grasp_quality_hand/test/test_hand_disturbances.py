# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of lost and late messages and of noise on contacts."""

from grasp_quality_hand.channel import Channel
from grasp_quality_hand.contact_noise import ContactNoise
from grasp_quality_hand.contact_reading import MeasuredContact, rotation_with_z
import numpy as np

COUNT = 4000


def test_a_channel_loses_its_share_and_keeps_the_order():
    channel, arrived = Channel(0.05, 0.0, seed=3), []
    for index in range(COUNT):
        channel.send(lambda index=index: arrived.append(index), now=0.0)
    assert 0.04 < 1.0 - len(arrived) / COUNT < 0.06
    assert arrived == sorted(arrived)


def test_a_channel_is_late_by_its_delay():
    channel, arrived = Channel(0.0, 0.01, seed=3), []
    for index in range(10):
        channel.send(lambda index=index: arrived.append(index), now=0.001 * index)
    for now, expected in ((0.0099, []), (0.0101, [0]), (0.0135, [0, 1, 2, 3])):
        channel.deliver(now)
        assert arrived == expected


def contact(force):
    """Return a measured contact with a force along its normal."""
    normal = np.array([0.6, 0.0, 0.8])
    return MeasuredContact(1, np.array([0.01, 0.02, 0.03]), rotation_with_z(normal),
                           np.array([0.0, 0.0, force, 0.0]))


def test_no_noise_changes_nothing():
    contacts = [contact(1.0)]
    assert ContactNoise().measure(contacts, np.random.default_rng(0))[0] is contacts[0]


def test_noise_has_its_standard_deviation_and_leaves_frames_whole():
    noise, rng = ContactNoise(1e-3, 0.02, 0.1), np.random.default_rng(5)
    true = contact(2.0)
    measured = [noise.measure([true], rng)[0] for _ in range(COUNT)]
    positions = np.array([one.position for one in measured]) - true.position
    forces = np.array([one.force_in_object_frame for one in measured]) - (
        true.force_in_object_frame)
    tilts = np.array([np.arccos(min(one.normal @ true.normal, 1.0)) for one in measured])
    assert np.allclose(positions.std(axis=0), 1e-3, rtol=0.1)
    assert np.allclose(forces.std(axis=0), 0.1, rtol=0.1)
    assert np.isclose(np.sqrt((tilts**2).mean() / 2), 0.02, rtol=0.1)
    for one in measured[:50]:
        assert np.allclose(one.R_object_contact.T @ one.R_object_contact, np.eye(3))


def test_an_unloaded_contact_stays_unloaded():
    measured = ContactNoise(force=0.1).measure([contact(0.0)], np.random.default_rng(0))
    assert not measured[0].force.any()

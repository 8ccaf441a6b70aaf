# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Draws from a noise: the deviations asked for, frames that stay frames, refusals."""

from grasp_quality import Contact, Grasp, InvalidTaskError
from grasp_quality.uncertainty import AT_ONCE, draw, tilted, Uncertainty
from known_grasps import antipodal, FZ, three_finger
import numpy as np
import pytest
from tolerances import EXACT

QUIET = {'position': 0.0, 'normal': 0.0, 'friction': 0.0, 'load': 0.0}


def variants(grasp, samples, seed=0, mean_load=0.0 * FZ, **noise):
    parts = list(draw(
        grasp, mean_load, Uncertainty(**{**QUIET, **noise}, contacts=len(grasp)), samples,
        seed))
    drawn = {name: np.concatenate([getattr(part, name) for part, _ in parts]) for name in (
        'positions', 'rotations', 'friction', 'torsional_friction')}
    by_grasp = {name: rows.reshape(samples, len(grasp), *rows.shape[1:])
                for name, rows in drawn.items()}
    return {**by_grasp, 'loads': np.concatenate([loads for _, loads in parts])}


def test_no_noise_changes_nothing_at_all():
    grasp = three_finger(0.4)
    drawn = variants(grasp, 7, mean_load=FZ)
    assert (drawn['positions'] == grasp.positions).all()
    assert (drawn['rotations'] == grasp.rotations).all()
    assert (drawn['friction'] == 0.4).all() and (drawn['loads'] == FZ).all()


def test_deviations_are_those_asked_for_contact_by_contact():
    """Within five standard errors of 20,000 draws."""
    grasp, count = three_finger(0.5), 20_000
    drawn = variants(grasp, count, position=[0.0, 0.1, 0.2], normal=[0.3, 0.0, 0.1],
                     friction=[0.01, 0.02, 0.0], load=[1, 2, 3, 0, 0.5, 0])
    close = 5.0 / np.sqrt(2 * count)
    assert drawn['positions'].std(axis=0) == pytest.approx(
        np.outer([0.0, 0.1, 0.2], np.ones(3)), rel=close)
    assert drawn['friction'].std(axis=0) == pytest.approx([0.01, 0.02, 0.0], rel=close)
    assert drawn['loads'].std(axis=0) == pytest.approx([1, 2, 3, 0, 0.5, 0], rel=close)
    # tilt angles about two tangents: their squares sum to 2 sigma^2 on average
    cosine = np.einsum('nij,ij->ni', drawn['rotations'][..., 2], grasp.rotations[..., 2])
    squares = np.arccos(np.clip(cosine, -1.0, 1.0)) ** 2
    assert squares.mean(axis=0) == pytest.approx([0.18, 0.0, 0.02], rel=5.0 / np.sqrt(count))


def test_frames_stay_rotations():
    R = tilted(np.random.default_rng(1).normal(size=(200, 2)))
    assert np.abs(R.transpose(0, 2, 1) @ R - np.eye(3)).max() <= EXACT
    assert np.linalg.det(R) == pytest.approx(np.ones(200), rel=EXACT)
    turned = np.cross([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]) * np.sin(0.3) + np.eye(3)[2] * np.cos(0.3)
    assert tilted(np.array([0.3, 0.0]))[:, 2] == pytest.approx(turned, abs=EXACT)


def test_friction_is_cut_off_at_zero_and_takes_the_torsional_one_along():
    grasp = antipodal(0.2, torsional_friction=0.01)
    drawn = variants(grasp, 2000, friction=0.2)
    assert drawn['friction'].min() == 0.0 and (drawn['friction'] == 0.0).mean() > 0.1
    assert drawn['torsional_friction'] == pytest.approx(0.05 * drawn['friction'], rel=EXACT)
    smooth = variants(antipodal(0.0, torsional_friction=0.01), 5, friction=0.2)
    assert (smooth['torsional_friction'] == 0.01).all()


def test_more_samples_begin_with_the_fewer_and_sizes_share_their_draws():
    grasp = three_finger()
    few = variants(grasp, 10, seed=3, position=0.1)['positions']
    many = variants(grasp, 2 * AT_ONCE + 5, seed=3, position=0.1)['positions']
    assert (many[:10] == few).all() and len(many) == 2 * AT_ONCE + 5
    double = variants(grasp, 10, seed=3, position=0.2, friction=0.1)['positions']
    assert double - grasp.positions == pytest.approx(2.0 * (few - grasp.positions), abs=EXACT)
    assert (variants(grasp, 10, seed=4, position=0.1)['positions'] != few).all()


def test_no_contact_is_drawn_beyond_where_contacts_may_be():
    grasp = Grasp([Contact((1e3, 0.0, 0.0), normal=(-1.0, 0.0, 0.0))])
    drawn = variants(grasp, 200, position=0.1)['positions'][:, 0]
    assert drawn[:, 0].max() == 1e3 and drawn[:, 0].min() < 1e3 and drawn[:, 1].std() > 0.05


def test_caps_and_bound_stay():
    grasp = antipodal(0.5, caps=(1.0, 2.0), bound='l1')
    (drawn, loads), = draw(grasp, FZ, Uncertainty(0.1, 0.1, 0.1, 0.1, 2), 3, 0)
    assert len(drawn) == len(loads) == 3
    assert drawn.max_normal_forces.reshape(3, 2).tolist() == [[1.0, 2.0]] * 3
    assert drawn.groups.tolist() == [0] * 6


@pytest.mark.parametrize('field, value, words', [
    ('position', -0.1, r'contact_noise \[m\] must be finite, at least 0'),
    ('position', 2.0, r'at most 1: it is a standard deviation, got 2.0'),
    ('position', [0.1, 0.1, 0.1], r'must be a number or 2 numbers, got shape \(3,\)'),
    ('normal', 5.0, r'normal_noise \[rad\] must be finite, at least 0 and at most 1'),
    ('friction', np.nan, 'friction_noise must be finite'),
    ('friction', 'much', "friction_noise must be a number or 2 numbers, got 'much'"),
    ('load', [1.0, 2.0], r'load_noise \[N, N m\] must be a number or 6 numbers')])
def test_refusals(field, value, words):
    with pytest.raises(InvalidTaskError, match=words):
        Uncertainty(**{**QUIET, field: value}, contacts=2)

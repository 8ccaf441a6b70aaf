# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A contact's frame, models and checks."""

import dataclasses

from grasp_quality import Contact, ContactModel, GraspQualityError, InvalidContactError
from grasp_quality.contact import frame_from_normal
import numpy as np
import pytest
from tolerances import EXACT

ORIGIN, UP = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)


@pytest.mark.parametrize('normal', [
    (1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 1, 1), (1e-8, 1, 1e-8), (3e-200, -4e-200, 0),
    (1e200, 2e200, -5e200), (0, 0, 5e-324)])
def test_frame_is_a_rotation_with_the_normal_as_third_column(normal):
    R = frame_from_normal(np.array(normal, dtype=float))
    assert R.T @ R == pytest.approx(np.eye(3), abs=EXACT)
    assert np.linalg.det(R) == pytest.approx(1.0, abs=EXACT)
    direction = np.array(normal) / np.abs(normal).max()
    assert R[:, 2] == pytest.approx(direction / np.linalg.norm(direction), abs=EXACT)


def test_frame_does_not_depend_on_the_length_of_the_normal():
    normal = np.array([0.3, -0.5, 0.2])
    assert frame_from_normal(normal) == pytest.approx(frame_from_normal(7.0 * normal), abs=EXACT)


def test_rotation_instead_of_normal():
    R = frame_from_normal(np.array([1.0, 2.0, 3.0]))
    contact = Contact(position=ORIGIN, rotation=R)
    assert (contact.rotation == R).all() and (contact.normal == R[:, 2]).all()


def test_fields_are_frozen_and_arrays_read_only():
    position = np.zeros(3)
    contact = Contact(position=position, normal=UP)
    position[0] = 1.0
    assert contact.position[0] == 0.0
    for array in (contact.position, contact.normal, contact.rotation):
        assert not array.flags.writeable and array.dtype == np.float64
    with pytest.raises(dataclasses.FrozenInstanceError):
        contact.friction = 1.0


@pytest.mark.parametrize('model, mu, gamma', [
    (ContactModel.FPC, 0.0, 0.0), (ContactModel.PCWF, 0.4, 0.0), (ContactModel.SFCE, 0.4, 0.01)])
def test_model_lets_its_coefficients_act(model, mu, gamma):
    contact = Contact(
        position=ORIGIN, normal=UP, model=model, friction=0.4, torsional_friction=0.01)
    assert contact.effective_friction == mu
    assert contact.effective_torsional_friction == gamma


@pytest.mark.parametrize('model', ContactModel)
def test_a_model_may_be_given_by_its_name(model):
    assert Contact(position=ORIGIN, normal=UP, model=model.value).model is model


@pytest.mark.parametrize('fields, message', [
    ({'normal': None}, 'exactly one of normal and rotation, got neither'),
    ({'rotation': np.eye(3)}, 'exactly one of normal and rotation, got both'),
    ({'normal': (0, 0, 0)}, 'normal must not be zero'),
    ({'normal': (0, 0, np.nan)}, 'normal must be finite'),
    ({'position': (0, 0)}, r'position must have shape \(3\)'),
    ({'position': (0, 0, np.inf)}, 'position must be finite'),
    ({'normal': None, 'rotation': 2 * np.eye(3)}, 'rotation must be a right-handed orthonormal'),
    ({'normal': None, 'rotation': np.diag([1.0, 1.0, -1.0])}, 'rotation must be a right-handed'),
    ({'normal': None, 'rotation': np.eye(2)}, r'rotation must have shape \(3, 3\)'),
    ({'model': 'RUBBER'}, r"model must be one of \['FPC', 'PCWF', 'SFCE'\].* got 'RUBBER'"),
    ({'model': [1]}, r'model must be one of .*, got \[1\]'),
    ({'friction': -0.1}, 'friction must be at least 0, got -0.1'),
    ({'friction': np.nan}, 'friction must be finite'),
    ({'torsional_friction': -0.1}, 'torsional_friction must be at least 0'),
    ({'max_normal_force': 0.0}, 'max_normal_force must be greater than 0, got 0'),
    ({'max_normal_force': np.inf}, 'max_normal_force must be finite'),
])
def test_error_names_contact_value_and_rule(fields, message):
    with pytest.raises(InvalidContactError, match="contact 'thumb': .*" + message) as caught:
        Contact(**{'position': ORIGIN, 'normal': UP, 'name': 'thumb', **fields})
    assert isinstance(caught.value, GraspQualityError)
    assert isinstance(caught.value, ValueError)

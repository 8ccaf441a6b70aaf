# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Grasp files: what they say arrives, and what breaks a rule is named with file and line."""

from grasp_quality import (
    ContactModel, evaluate, TaskCone, TaskEllipsoid, TaskPolytope, TaskWrench)
from grasp_quality_cli.grasp_file import read_grasp_file
from grasp_quality_cli.yaml_source import FileError
import numpy as np
import pytest
from tolerances import EXACT, SOLVER

CONTACT = '- {position: [0, 0, 0], normal: [0, 0, 1]}'


def written(tmp_path, text):
    """Write a grasp file."""
    path = tmp_path / 'grasp.yaml'
    path.write_text(text)
    return path


def test_every_field_arrives(examples):
    source = read_grasp_file(examples / 'three_finger.yaml')
    contacts = source.grasp.contacts
    assert source.grasp.bound == 'finger'
    assert contacts.names == contacts.fingers == ('thumb', 'index', 'middle')
    assert set(contacts.models) == {ContactModel.SFCE}
    assert contacts.friction.tolist() == [0.6, 0.6, 0.4]
    assert contacts.torsional_friction.tolist() == [0.004] * 3
    assert contacts.max_normal_forces.tolist() == [8.0] * 3
    assert contacts.positions[0].tolist() == [-0.03, 0.0, 0.0]
    assert contacts.rotations[0][:, 2].tolist() == [1.0, 0.0, 0.0]
    assert source.external_wrench.tolist() == [0.0, 0.0, -1.5, 0.0, 0.0, 0.0]
    kinds = [TaskWrench, TaskWrench, TaskCone, TaskPolytope, TaskEllipsoid]
    assert [type(task) for task in source.tasks.values()] == kinds
    assert source.tasks['push'].half_angle == 0.5236
    assert source.tasks['shake'].weights.tolist() == [0.25] * 4


def test_defaults_are_those_of_the_python_interface(tmp_path):
    grasp = read_grasp_file(written(tmp_path, f'contacts:\n{CONTACT}\n')).grasp
    contact = grasp.contacts[0]
    assert (contact.model, contact.friction, contact.max_normal_force) == (
        ContactModel.PCWF, 0.5, 1.0)
    assert grasp.bound == 'linf' and grasp.names == ('contact_0',)


def test_three_ways_to_turn_a_contact(tmp_path):
    """A quarter turn about y takes +z to +x."""
    half = np.sqrt(0.5)
    grasp = read_grasp_file(written(tmp_path, f"""contacts:
- {{position: [0, 0, 0], normal: [2e0, 0, 0]}}
- {{position: [0, 0, 0], rotation: [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]}}
- {{position: [0, 0, 0], quaternion: [0, {half}, 0, {half}]}}
""")).grasp
    assert grasp.rotations[:, :, 2] == pytest.approx(
        np.tile([1.0, 0.0, 0.0], (3, 1)), abs=EXACT)
    assert grasp.rotations[1] == pytest.approx(grasp.rotations[2], abs=EXACT)


def test_an_ellipsoid_of_the_file_is_that_of_the_core(examples):
    source = read_grasp_file(examples / 'three_finger.yaml')
    grasp, load = source.grasp, source.external_wrench
    answer = evaluate(grasp, source.tasks['swing'], load)
    alone = evaluate(grasp, TaskWrench([0.0, 0.5, 0.0, 0.0, 0.0, 0.0]), load)
    assert min(abs(answer.alphas - alone.alpha)) <= SOLVER * alone.alpha


@pytest.mark.parametrize('text, line, words', [
    ('', 1, 'is empty'),
    ('contacts: [', 1, 'is not YAML'),
    ('- 1', 1, 'file must be a mapping'),
    ('bound: linf', 1, 'must have the field contacts'),
    ('contacts: []', 1, 'at least one contact'),
    (f'contacts:\n{CONTACT}\nspeed: 3', 3, 'speed is not known here'),
    (f'bound: l3\ncontacts:\n{CONTACT}', 1, 'bound must be one of l1, l2, linf, finger, got'),
    (f'contacts:\n{CONTACT}\n- {{normal: [0, 0, 1]}}', 3, 'must have the field position'),
    ('contacts:\n- {position: [0, 0, 0]}', 2, 'exactly one of normal, rotation, quaternion'),
    ('contacts:\n- {position: [0, 0], normal: [0, 0, 1]}', 2, 'must hold 3 numbers (x y z [m])'),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 0]', 3, 'normal must not be zero'),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 1]\n  friction: high', 4,
     "contacts[0].friction must be a finite number, got 'high'"),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 1]\n  friction: -1', 4,
     'friction must be at least 0'),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 1]\n  friction: .nan', 4, 'finite'),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 1]\n  normal: [0, 1, 0]', 4, 'twice'),
    ('contacts:\n- position: [0, 0, 0]\n  quaternion: [0, 0, 0, 2]', 3, 'norm 1'),
    (f'contacts:\n{CONTACT}\ntasks:\n  lift: {{}}', 4, 'exactly one of wrench, cone'),
    (f'contacts:\n{CONTACT}\ntasks:\n  lift:\n    wrench: [0, 0, 0, 0, 0, 0]', 5,
     'tasks.lift.wrench cannot be used: task_wrench must not be zero'),
    (f'contacts:\n{CONTACT}\ntasks:\n  lift:\n    cone: {{axis: [0, 0, 1, 0, 0, 0]}}', 5,
     'must have the field lateral_x'),
    ('contacts:\n- position: [0, 0, 0]\n  normal: [0, 0, 1]\n  max_normal_force: 0\n', 4,
     'max_normal_force must be greater than 0'),
    ('defaults:\n  position: [0, 0, 0]\ncontacts:\n' + CONTACT, 2, 'is not known here'),
])
def test_errors_name_file_line_and_rule(tmp_path, text, line, words):
    path = written(tmp_path, text)
    with pytest.raises(FileError) as caught:
        read_grasp_file(path)
    assert str(caught.value).startswith(f'{path}:{line}: ') and words in str(caught.value)


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileError, match='cannot be read: No such file'):
        read_grasp_file(tmp_path / 'none.yaml')
    binary = tmp_path / 'grasp.yaml'
    binary.write_bytes(b'\xff\xfe\x00')
    with pytest.raises(FileError, match='UTF-8'):
        read_grasp_file(binary)


def test_tags_build_nothing(tmp_path):
    path = written(tmp_path, f'contacts:\n{CONTACT}\nbound: !!python/object/apply:os.getcwd []')
    with pytest.raises(FileError, match='bound must be a single value'):
        read_grasp_file(path)

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of the node from its file, and our types from theirs."""

from pathlib import Path

from grasp_quality.node_parameters import Settings
from grasp_quality_cli.bag_types import OURS
from grasp_quality_cli.node_settings import read_settings
from grasp_quality_cli.yaml_source import FileError
import pytest

ROOT = Path(__file__).parents[2]


def test_the_file_of_the_repository_holds_the_defaults():
    assert read_settings(ROOT / 'config' / 'grasp_quality.yaml', [], '/grasp_quality') \
        == Settings()


def test_sections_and_assignments_win_in_this_order(tmp_path):
    path = tmp_path / 'params.yaml'
    path.write_text("""
/**: {ros__parameters: {friction_coefficient: 0.1, max_normal_force: 1, contact_names: [a, b]}}
hand: {ros__parameters: {friction_coefficient: 0.2, autostart: false}}
other: {ros__parameters: {friction_coefficient: 0.3}}
""")
    settings = read_settings(
        path, ['max_normal_force=3', 'contact_fingers=x,y', 'max_request_size=7'], '/hand')
    assert (settings.friction_coefficient, settings.max_normal_force) == (0.2, 3.0)
    assert settings.contact_names == ('a', 'b') and settings.contact_fingers == ('x', 'y')
    assert settings.max_request_size == 7 and settings.autostart is False


@pytest.mark.parametrize('text, words', [
    ('a: 1', ':1: file must have a section /\\*\\*'),
    ('/**: {}', 'must have the field ros__parameters'),
    ('/**:\n  ros__parameters:\n    friction: 1', ':3: .*friction is not known here'),
    ('/**:\n  ros__parameters:\n    friction_coefficient: x', ':3: .*finite number'),
    ('/**:\n  ros__parameters:\n    autostart: maybe', ':3: .*true, false'),
    ('/**:\n  ros__parameters:\n    max_request_size: 1.5', ':3: .*whole number')])
def test_wrong_files(tmp_path, text, words):
    path = tmp_path / 'params.yaml'
    path.write_text(text)
    with pytest.raises(FileError, match=words):
        read_settings(path, [], '/grasp_quality')


@pytest.mark.parametrize('name', OURS)
def test_our_types_are_those_of_the_interface_files(name):
    package, _, message = name.split('/')
    text = (ROOT / package / 'msg' / f'{message}.msg').read_text()
    lines = [line.split('#')[0].strip() for line in text.splitlines()]
    ours = OURS[name].replace('grasp_quality_msgs/', '')
    assert [line.split() for line in lines if line] == [
        line.split() for line in ours.splitlines()]

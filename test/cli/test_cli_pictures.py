# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``map`` and ``figures``: the numbers behind the pictures are right, and pictures come out."""

import json
from pathlib import Path
import re

from grasp_quality_cli.paper_numbers import numbers
from matplotlib.image import imread
import numpy as np
import pytest
from tolerances import SOLVER

DOCUMENT = Path(__file__).parents[2] / 'docs' / 'paper.md'
THREE_DIGITS = 5e-4


def is_picture(path):
    """Tell whether a file is a picture with something in it."""
    picture = imread(path)
    return picture.shape[0] > 400 and picture.shape[1] > 800 and np.ptp(picture[..., :3]) > 0.9


@pytest.mark.parametrize('number', numbers(), ids=lambda n: f'{n.figure}: {n.what}')
def test_numbers_of_the_paper(number):
    """Closed forms to the solver's tolerance; what is known to three digits, to three digits."""
    three_digits = number.figure == '5' and 'single' in number.what
    assert number.here == pytest.approx(
        number.expected, abs=THREE_DIGITS if three_digits else SOLVER * max(1.0, number.expected))


def test_the_document_has_the_numbers():
    """Every number of Fig. 5 to 7 stands in docs/paper.md, as the command prints it."""
    there = set(re.findall(r'[\d.]+', DOCUMENT.read_text()))
    for number in numbers():
        if number.figure != '3' and abs(number.here) > SOLVER:
            assert f'{number.here:.6g}' in there


def test_figures_are_drawn(run, tmp_path):
    code, printed, _ = run('figures', '-o', tmp_path, '--json')
    row = json.loads(printed)
    assert code == 0 and len(row['pictures']) == 4 and len(row['numbers']) == len(numbers())
    assert all(is_picture(path) for path in row['pictures'])


def test_map_of_forces_and_of_torques(run, examples, tmp_path):
    """The pinch pushes 10 N along its axis and holds 10 N across; about its axis nothing."""
    for arguments, top, bottom in (((), 10.0, None), (('--torque',), None, 0.0)):
        code, printed, _ = run('map', examples / 'pinch.yaml', '-o', tmp_path / 'map.png',
                               '--json', '--resolution', 6, *arguments)
        row = json.loads(printed)
        assert code == 0 and len(row['alpha']) == 72 and is_picture(tmp_path / 'map.png')
        wrenches = np.array(row['alpha'])[:, None] * row['directions']
        assert not wrenches[:, :3].any() if arguments else not wrenches[:, 3:].any()
        assert top is None or row['alpha_max'] <= top * (1.0 + SOLVER)
        assert bottom is None or row['alpha_min'] <= 0.01


def test_directions_that_the_contacts_cannot_serve_are_told_as_zero(run, examples, tmp_path):
    """Two point contacts turn nothing about their line, nor any torque with a part along it."""
    code, printed, _ = run('map', examples / 'pinch.yaml', '-o', tmp_path / 'map.png', '--torque',
                           '--resolution', 6)
    assert code == 0 and printed.startswith('72 directions: from 0 to 0.2 N m; 0 infeasible; 60 ')
    code, printed, _ = run('map', examples / 'pinch.yaml', '-o', tmp_path / 'map.png',
                           '--resolution', 6)
    assert code == 0 and 'accuracy' not in printed


def test_a_map_of_what_cannot_be_held_is_no(run, examples, tmp_path):
    code, printed, _ = run('map', examples / 'pinch.yaml', '-o', tmp_path / 'map.png',
                           '--external-wrench', '0 0 -50 0 0 0', '--resolution', 4, '--json')
    assert code == 1 and not any(json.loads(printed)['feasible'])


def test_a_missing_folder_is_named(run, examples, tmp_path):
    missing = tmp_path / 'no'
    code, printed, complaint = run('map', examples / 'pinch.yaml', '-o', missing / 'map.png')
    assert code == 2 and not printed
    assert complaint == f'error: --output {missing / "map.png"}: there is no folder {missing}\n'


def test_pictures_need_a_folder(run, tmp_path):
    (tmp_path / 'file').write_text('')
    for output in ('file', 'file/pictures'):
        code, _, complaint = run('figures', '-o', tmp_path / output)
        assert code == 2 and 'must be a folder' in complaint


def test_other_pictures_are_refused(run, examples, tmp_path):
    code, _, complaint = run('map', examples / 'pinch.yaml', '-o', tmp_path / 'map.txt')
    assert code == 2 and '.png, .pdf, .svg' in complaint

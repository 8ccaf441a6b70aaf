# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``env.sh`` in a shell: what it puts on PATH, and what it says where it cannot help."""

from pathlib import Path
import shutil
import subprocess

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def clone(tmp_path):
    """Return a folder with env.sh, and a set-up that changes nothing but PATH."""
    shutil.copy(ROOT / 'env.sh', tmp_path)
    for file in ('.venv/bin/activate', 'install/setup.bash'):
        (tmp_path / file).parent.mkdir(parents=True)
        (tmp_path / file).write_text('')
    (tmp_path / '.venv' / 'compiled').touch()
    for package, program in (('grasp_quality', 'grasp-quality'), ('grasp_quality_hand', 'demo'),
                             ('grasp_quality_hand', 'force_to_effort')):
        path = tmp_path / 'install' / package / 'lib' / package / program
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text('#!/bin/sh\n')
        path.chmod(0o755)
    return tmp_path


def shell(name, words, folder):
    """Run words in a shell: (exit code, standard output, standard error)."""
    done = subprocess.run([name, '-c', words], cwd=folder, capture_output=True, text=True,
                          check=False)
    return done.returncode, done.stdout, done.stderr


def test_programs_of_both_packages_are_found(clone):
    code, found, _ = shell(
        'bash', '. ./env.sh && command -v grasp-quality force_to_effort', clone)
    assert code == 0
    assert [Path(line).name for line in found.splitlines()] == ['grasp-quality', 'force_to_effort']


def test_a_program_that_was_there_keeps_its_name(clone):
    (clone / 'bin').mkdir()
    other = shutil.copy(clone / 'install/grasp_quality_hand/lib/grasp_quality_hand/demo',
                        clone / 'bin')
    _, found, _ = shell(
        'bash', f'PATH={clone / "bin"}:$PATH; . ./env.sh && command -v demo', clone)
    assert found.strip() == str(other)


def test_without_a_build_it_says_what_to_do(clone):
    shutil.rmtree(clone / 'install')
    code, _, complaint = shell('bash', '. ./env.sh', clone)
    assert code == 1 and 'run make setup first' in complaint


def test_a_set_up_that_is_not_complete_is_not_entered(clone):
    """The node would be there, and mute while it compiles."""
    (clone / '.venv' / 'compiled').unlink()
    code, _, complaint = shell('bash', '. ./env.sh', clone)
    assert code == 1 and 'is not complete' in complaint and 'make setup' in complaint


def test_another_shell_is_named_as_the_reason(clone):
    """Of sh that is bash there is nothing to complain of."""
    code, _, complaint = shell('sh', '. ./env.sh', clone)
    bash = shell('sh', 'printf %s "${BASH_VERSION:-}"', clone)[1]
    assert complaint == ('' if bash else 'error: env.sh needs bash or zsh\n')
    assert bool(code) is not bool(bash)

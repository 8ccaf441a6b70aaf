# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold of the program that brings D'Claw."""

from grasp_quality_hand import fetch_dclaw
import pytest


def test_a_complete_folder_is_left_alone(tmp_path, capsys):
    for name in fetch_dclaw.NEEDED:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text('as it was')
    assert fetch_dclaw.main([str(tmp_path)]) == 0
    assert all((tmp_path / name).read_text() == 'as it was' for name in fetch_dclaw.NEEDED)
    assert 'fetching' not in capsys.readouterr().out


def test_a_download_that_fails_is_explained(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv('PIP_CONFIG_FILE', '/dev/null')
    monkeypatch.setenv('PIP_NO_INDEX', '1')
    monkeypatch.setenv('PIP_FIND_LINKS', str(tmp_path))
    target = tmp_path / 'dclaw'
    assert fetch_dclaw.main([str(target)]) == 1
    assert 'GRASP_QUALITY_DCLAW_DIR' in capsys.readouterr().err
    assert not target.exists()
    with pytest.raises(fetch_dclaw.DClawUnavailable):
        fetch_dclaw.fetch_dclaw(target)


def test_the_folder_comes_from_the_environment(tmp_path, monkeypatch):
    monkeypatch.setenv('GRASP_QUALITY_DCLAW_DIR', str(tmp_path))
    assert fetch_dclaw.dclaw_directory() == tmp_path

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Files without end, or too large: each is refused by name, in bounded memory and at once."""

import os
import subprocess
import sys
import threading

from grasp_quality_cli.grasp_file import read_grasp_file
from grasp_quality_cli.source_item import FileError
from grasp_quality_cli.yaml_source import LARGEST_FILE
import pytest
from study_data import DEADLINE_S, pinch, write_lines

LARGE = 'must be at most 1,048,576 bytes'
REFUSED = {
    'evaluate zero.yaml': f'zero.yaml: {LARGE}', 'evaluate urandom.yaml': f'urandom.yaml: {LARGE}',
    'evaluate /dev/stdin': f'/dev/stdin: {LARGE}', 'map zero.yaml -o map.png': LARGE,
    'evaluate pinch.yaml --task zero.yaml': f'zero.yaml: {LARGE}',
    'study rows.jsonl -o out --task zero.yaml': f'zero.yaml: {LARGE}',
    'study zero.jsonl -o out': 'must be a regular file, as a study',
    'study zero.parquet -o out': 'must be a regular file, as a study',
    'bag zero.mcap': 'must be a regular file', 'bag urandom.mcap': 'must be a regular file',
    'bag zero.db3': 'must be a regular file', 'bag bag': 'holds neither .mcap nor .db3'}
# all in one process, whose memory ends before the machine's does
PROGRAM = """
import json, resource, sys
from grasp_quality_cli.main import main
resource.setrlimit(resource.RLIMIT_AS, (1 << 32, 1 << 32))
for line in sys.argv[1:]:
    print('code', main(line.split()), file=sys.stderr)
"""


@pytest.fixture
def named(tmp_path, examples):
    """Return files by name: devices without end, and what is to be asked about them."""
    for device in ('zero', 'urandom'):
        for suffix in ('yaml', 'jsonl', 'parquet', 'mcap', 'db3'):
            (tmp_path / f'{device}.{suffix}').symlink_to(f'/dev/{device}')
    (tmp_path / 'bag').mkdir()
    for name in ('metadata.yaml', 'bag_0.mcap', 'bag_1.db3'):
        (tmp_path / 'bag' / name).symlink_to('/dev/zero')
    (tmp_path / 'pinch.yaml').symlink_to(examples / 'pinch.yaml')
    write_lines(tmp_path / 'rows.jsonl', [pinch(0.5)])
    return tmp_path


def test_no_end_is_no_reason_to_read_on(named):
    with open('/dev/zero', 'rb') as zero:
        done = subprocess.run(
            [sys.executable, '-c', PROGRAM, *REFUSED], cwd=named, stdin=zero,
            capture_output=True, text=True, timeout=DEADLINE_S, check=False)
    told = done.stderr.splitlines()
    assert not done.stdout and len(told) == 2 * len(REFUSED), done.stderr
    for (asked, words), error, code in zip(REFUSED.items(), told[::2], told[1::2]):
        assert error.startswith('error: ') and words in error, asked
        assert code == 'code 2', asked


def test_the_largest_file_is_the_largest(tmp_path, examples):
    text = (examples / 'pinch.yaml').read_bytes() + b'#'
    path = tmp_path / 'grasp.yaml'
    path.write_bytes(text.ljust(LARGEST_FILE, b'x'))
    assert len(read_grasp_file(path).grasp) == 2
    path.write_bytes(text.ljust(LARGEST_FILE + 1, b'x'))
    with pytest.raises(FileError, match='at most 1,048,576 bytes .* or many to grasp-quality stu'):
        read_grasp_file(path)


def test_a_pipe_is_read_once(tmp_path, run):
    """As <(...) of a shell gives it; a study asks for the text of its task twice."""
    rows, pipe = write_lines(tmp_path / 'rows.jsonl', [pinch(0.5)]), tmp_path / 'task.yaml'
    os.mkfifo(pipe)
    writer = threading.Thread(
        target=pipe.write_text, args=('wrench: [0, 0, 2, 0, 0, 0]',), daemon=True)
    writer.start()
    code, _, complaint = run('study', rows, '-o', tmp_path / 'out', '--task', pipe,
                             '--workers', '1', '--json')
    writer.join(DEADLINE_S)
    assert code == 0, complaint

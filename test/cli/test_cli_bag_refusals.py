# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality bag``: what it does not take, and what it says then."""

from benchmarks.recorded_bag import BagWriter, START_NS, write_hand
import pytest

NODE = '/grasp_quality'
CONTACTS, TASK = f'{NODE}/contact_poses', f'{NODE}/task_wrench'
LIFT = '0 0 2 0 0 0'


@pytest.mark.parametrize('arguments, words', [
    ((), 'there is no task'), (('--task', 'lift'), '--task must be six'),
    (('--task', LIFT, '--node', '/hand'), 'holds no contacts of a node /hand'),
    (('--task', LIFT, '--format', 'xls'), 'parquet, csv'),
    (('--task', LIFT, '--set', 'colour=3'), '--set must be name=value'),
    (('--task', LIFT, '--set', 'friction_coefficient=-1'), 'from 0 to 100'),
    (('--task', LIFT, '--set', 'min_contact_force=1'), 'needs contact_names')])
def test_wrong_arguments(tmp_path, run, arguments, words):
    write_hand(tmp_path / 'bag', 2, 3)
    code, printed, complaint = run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', *arguments)
    assert code == 2 and not printed and words in complaint


def test_a_bag_without_contacts_says_so(tmp_path, run):
    """As a recorder leaves it when no driver was running: all topics, no message."""
    with BagWriter(tmp_path / 'bag') as bag:
        for topic, kind in ((CONTACTS, 'PoseArray'), (TASK, 'WrenchStamped')):
            bag.add(topic, f'geometry_msgs/msg/{kind}')
    code, printed, complaint = run(
        'bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--task', LIFT)
    assert code == 2 and not printed and not (tmp_path / 'out').exists()
    assert f'no messages on {CONTACTS} or {NODE}/contacts: was the driver running?' in complaint
    assert 'no messages at all' in complaint


def test_contacts_of_the_other_kind_are_told(tmp_path, run):
    write_hand(tmp_path / 'bag', 2, 3)
    code, printed, complaint = run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--task', LIFT,
                                   '--set', 'contact_source=contact_array')
    assert code == 2 and not printed
    assert 'no messages on /grasp_quality/contacts:' in complaint
    assert 'the bag holds messages on /grasp_quality/contact_poses' in complaint


def test_contacts_that_cannot_be_used_leave_no_empty_table(tmp_path, run):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.write_raw(CONTACTS, START_NS, 'geometry_msgs/msg/PoseArray', b'\x00\x01\x00\x00\x07')
    code, printed, _ = run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--task', LIFT)
    assert code == 1 and 'no contacts that could be used' in printed and 'bad message' in printed


def test_a_bag_has_no_grasp_file(tmp_path, run):
    write_hand(tmp_path / 'bag', 2, 3)
    _, _, complaint = run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--task', 'lift')
    _, told, _ = run('bag', '--help')
    assert 'grasp file' not in complaint and 'grasp file' not in ' '.join(told.split())


def test_an_output_that_is_a_file_is_told(tmp_path, run):
    write_hand(tmp_path / 'bag', 2, 3)
    (tmp_path / 'out').write_text('')
    code, _, complaint = run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--task', LIFT)
    assert code == 2 and f'--output {tmp_path / "out"}: must be a folder' in complaint


def test_no_bag(tmp_path, run):
    assert 'no such file' in run('bag', tmp_path / 'none', '--task', LIFT)[2]
    assert 'neither .mcap nor .db3' in run('bag', tmp_path, '--task', LIFT)[2]
    (tmp_path / 'notes.txt').write_text('')
    assert 'must be a .mcap or .db3' in run('bag', tmp_path / 'notes.txt', '--task', LIFT)[2]

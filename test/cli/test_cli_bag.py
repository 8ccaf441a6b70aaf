# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""``grasp-quality bag``: recorded answers are those of the core, and nothing is lost silently."""

import csv
import json
import subprocess
import sys

from benchmarks.recorded_bag import (
    BagWriter, header, PERIOD_NS, pinch, pose_array, START_NS, TYPES, wrench_stamped, write_hand)
from grasp_quality import Contact, evaluate, Grasp, TaskWrench
from grasp_quality_msgs.msg import Contact as ContactMsg
import numpy as np
import pyarrow.parquet
import pytest
from tolerances import SOLVER

NODE = '/grasp_quality'
CONTACTS, TASK, LOAD = (f'{NODE}/{name}' for name in (
    'contact_poses', 'task_wrench', 'external_wrench'))
LIFT = '0 0 2 0 0 0'


def pinches(bag, count, start=0):
    """Write pinches, one a period."""
    for i in range(start, start + count):
        time_ns = START_NS + i * PERIOD_NS
        bag.write(CONTACTS, time_ns, pose_array(time_ns, *pinch()))


@pytest.fixture
def replay(run, tmp_path):
    """Return a function that replays a bag: (exit code, JSON, rows of answers, rows of forces)."""
    def program(bag, *arguments):
        code, printed, complaint = run('bag', bag, '-o', tmp_path / 'out', '--json', *arguments)
        assert not complaint, complaint
        tables = [pyarrow.parquet.read_table(tmp_path / 'out' / f'{name}.parquet').to_pylist()
                  for name in ('answers', 'forces')]
        return code, json.loads(printed), *tables

    return program


def problems(tmp_path):
    """Rows of problems.csv."""
    with (tmp_path / 'out' / 'problems.csv').open() as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize('storage', ['mcap', 'db3'])
def test_answers_are_those_of_the_core(tmp_path, replay, storage):
    write_hand(tmp_path / 'bag', 5, 4, storage)
    code, row, answers, forces = replay(tmp_path / 'bag', '--task', LIFT)
    assert code == 0 and row['codes'] == {'OPTIMAL': 5} and row['problems'] == []
    from benchmarks.recorded_bag import random_grasps
    for answer, (positions, normals) in zip(answers, random_grasps(1, 4)):
        grasp = Grasp([Contact(p, n, max_normal_force=10.0) for p, n in zip(positions, normals)])
        expected = evaluate(grasp, TaskWrench([0.0, 0.0, 2.0, 0.0, 0.0, 0.0]))
        assert answer['alpha'] == pytest.approx(expected.alpha, rel=SOLVER)
        assert answer['friction_margin'] == pytest.approx(expected.friction_margin, abs=1e-6)
    assert len(forces) == 5 * 4
    assert {f['contact'] for f in forces} == {f'contact_{i}' for i in range(4)}


def test_csv_holds_what_parquet_holds(tmp_path, run, replay):
    write_hand(tmp_path / 'bag', 3, 3, measured=True)
    _, _, answers, forces = replay(tmp_path / 'bag', '--task', LIFT)
    run('bag', tmp_path / 'bag', '-o', tmp_path / 'out', '--format', 'csv', '--task', LIFT)
    for name, rows in (('answers', answers), ('forces', forces)):
        with (tmp_path / 'out' / f'{name}.csv').open() as file:
            for text, row in zip(csv.DictReader(file), rows, strict=True):
                assert {key: '' if value is None else str(value) for key, value in row.items()
                        if isinstance(value, (int, str))}.items() <= text.items()
                numbers = [key for key, value in row.items() if isinstance(value, float)]
                assert [float(text[key]) for key in numbers] == [row[key] for key in numbers]


def test_task_and_load_come_from_the_bag(tmp_path, replay):
    """2 mu 10 N = 10 N: five times 2 N, a load of 1 N takes half of one, and so on."""
    with BagWriter(tmp_path / 'bag') as bag:
        bag.write(TASK, START_NS - 3, wrench_stamped(0, [0, 0, 2, 0, 0, 0], ''))
        pinches(bag, 1)
        bag.write(LOAD, START_NS + 3, wrench_stamped(0, [0, 0, -1, 0, 0, 0], 'object'))
        pinches(bag, 1, start=1)
        bag.write(TASK, START_NS + PERIOD_NS + 3, wrench_stamped(0, [0, 0, 1, 0, 0, 0], ''))
        pinches(bag, 1, start=2)
    _, _, answers, _ = replay(tmp_path / 'bag')
    assert [row['alpha'] for row in answers] == pytest.approx([5.0, 4.5, 9.0], rel=SOLVER)
    _, _, answers, _ = replay(
        tmp_path / 'bag', '--task', '0 2 0 0 0 0', '--external-wrench', '0 -4 0 0 0 0')
    assert [row['alpha'] for row in answers] == pytest.approx([3.0] * 3, rel=SOLVER)


@pytest.mark.parametrize('kind', [
    'cone: {axis: [0, 0, 1, 0, 0, 0], lateral_x: [1, 0, 0, 0, 0, 0], '
    'lateral_y: [0, 1, 0, 0, 0, 0], half_angle: 0.0}',
    'polytope: {wrenches: [[0, 0, 1, 0, 0, 0], [1, 0, 0, 0, 0, 0], [0, 0, 0.5, 0, 0, 0]]}'])
def test_other_tasks_are_answered_too(tmp_path, replay, kind):
    """The pinch lifts 10 N and pushes 10 N; the polytope's weakest counts."""
    with BagWriter(tmp_path / 'bag') as bag:
        pinches(bag, 2)
    (tmp_path / 'task.yaml').write_text(kind)
    _, _, answers, _ = replay(tmp_path / 'bag', '--task', tmp_path / 'task.yaml')
    assert [row['alpha'] for row in answers] == pytest.approx([10.0] * 2, rel=SOLVER)


def test_measured_forces_give_their_margin(tmp_path, replay):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.write(f'{NODE}/contact_wrenches/contact_1', START_NS - 1, wrench_stamped(
            START_NS, [1, 0, 4, 0, 0, 0], 'contact_1'))
        pinches(bag, 1)
    _, _, answers, forces = replay(tmp_path / 'bag', '--task', LIFT)
    assert answers[0]['measured_slip_margin'] == pytest.approx(1.0 - 1.0 / (0.5 * 4.0))
    assert [row['measured_n'] for row in forces] == [None, 4.0]


def test_the_rich_contacts_are_read(tmp_path, replay):
    """From a bag that does not hold the definitions of its types, as before ROS 2 Iron."""
    assert 'MODEL_PCWF' in dir(ContactMsg)
    from grasp_quality_cli.bag_types import OURS
    from rosbags.typesys import get_types_from_msg
    from benchmarks.recorded_bag import STORE
    for name, text in OURS.items():
        if name not in STORE.types:
            STORE.register(get_types_from_msg(text, name))
    TYPES.update(STORE.types)
    poses = pose_array(START_NS, *pinch()).poses
    with BagWriter(tmp_path / 'bag') as bag:
        bag.write(f'{NODE}/contacts', START_NS, TYPES['grasp_quality_msgs/msg/ContactArray'](
            header(START_NS), [TYPES['grasp_quality_msgs/msg/Contact'](
                name, name, pose, 2, 0.25, 0.0, 4.0)
             for name, pose in zip(('a', 'b'), poses)], []))
    _, _, answers, forces = replay(tmp_path / 'bag', '--task', '0 0 1 0 0 0')
    assert answers[0]['alpha'] == pytest.approx(2 * 0.25 * 4.0, rel=SOLVER)
    assert [row['contact'] for row in forces] == ['a', 'b']


def test_what_is_wrong_is_listed_with_its_time_and_nothing_is_lost(tmp_path, replay):
    at = [START_NS + i * PERIOD_NS for i in range(60)]
    with BagWriter(tmp_path / 'bag') as bag:
        pinches(bag, 2)
        bag.write_raw(CONTACTS, at[2], 'geometry_msgs/msg/PoseArray', b'\x00\x01\x00\x00\x07')
        bag.write(CONTACTS, at[3], pose_array(at[1] - 1, *pinch()))          # late
        bag.write(CONTACTS, at[4], pose_array(at[4], *pinch(np.nan)))        # not finite
        bag.write(CONTACTS, at[5], pose_array(at[5], *pinch(), frame=''))    # no frame
        bag.write(f'{NODE}/contact_wrenches/x', at[6], header(at[6]))        # of another type
        bag.write(CONTACTS, at[40], pose_array(at[7], *pinch()))             # stale, after a gap
        pinches(bag, 1, start=41)
    code, row, answers, _ = replay(tmp_path / 'bag', '--task', LIFT)
    assert code == 0
    assert [a['code'] for a in answers] == [
        'OPTIMAL', 'OPTIMAL', 'INVALID_REQUEST', 'INVALID_REQUEST', 'STALE_CONTACTS', 'OPTIMAL']
    assert all(a['alpha'] == 0.0 and a['message'] for a in answers if a['code'] != 'OPTIMAL')
    found = {(p['kind'], int(p['time_ns'])) for p in problems(tmp_path)}
    assert found == {
        ('bad message', at[2]), ('late contacts', at[3]), ('INVALID_REQUEST', at[4]),
        ('INVALID_REQUEST', at[5]), ('unknown type', at[6]), ('gap', at[40]),
        ('STALE_CONTACTS', at[40])}
    assert sum(p['count'] for p in row['problems']) == len(problems(tmp_path))
    report = (tmp_path / 'out' / 'report.html').read_text()
    assert all(p['kind'] in report for p in row['problems']) and 'src="data:image/png' in report
    assert 'http' not in report


def test_recorded_loads_age_as_in_the_node(tmp_path, replay):
    at = [START_NS + i * PERIOD_NS for i in range(4)]
    age_s = 1.5e-9 * PERIOD_NS
    with BagWriter(tmp_path / 'bag') as bag:
        pinches(bag, 1)
        bag.write(LOAD, at[1], wrench_stamped(at[1], (0, 0, -1, 0, 0, 0), ''))
        pinches(bag, 3, start=1)
    _, _, answers, _ = replay(
        tmp_path / 'bag', '--task', LIFT, '--set', f'max_load_age={age_s}')
    assert [a['code'] for a in answers] == [
        'STALE_CONTACTS', 'OPTIMAL', 'OPTIMAL', 'STALE_CONTACTS']
    assert 'no load received yet' in answers[0]['message']
    assert 'max_load_age' in answers[3]['message']
    _, row, _, _ = replay(tmp_path / 'bag', '--task', LIFT, '--set', f'max_load_age={age_s}',
                          '--external-wrench', '0 0 -1 0 0 0')
    assert row['codes'] == {'OPTIMAL': 4}
    _, row, _, _ = replay(tmp_path / 'bag', '--task', LIFT)
    assert row['codes'] == {'OPTIMAL': 4}


# bytes before the first message: schemas of the types in MCAP, a page for each table in SQLite
OVERHEAD = {'mcap': 8_192, 'db3': 12 * 4_096}


@pytest.mark.parametrize('share', [0.2, 0.5, 0.9, 0.999])
@pytest.mark.parametrize('storage', ['mcap', 'db3'])
def test_a_bag_that_breaks_off_is_read_as_far_as_it_goes(tmp_path, replay, storage, share):
    write_hand(tmp_path / 'bag', 400, 8, storage)
    _, _, whole, _ = replay(tmp_path / 'bag', '--task', LIFT)
    file = tmp_path / 'bag' / f'bag.{storage}'
    data = file.read_bytes()
    file.write_bytes(data[:int(share * len(data))])
    code, row, answers, _ = replay(tmp_path / 'bag', '--task', LIFT)
    assert code == 1 and 'is damaged' in row['damage'][0]
    assert answers == whole[:len(answers)]
    kept = int(share * len(data)) - OVERHEAD[storage]
    assert len(answers) >= int(kept / len(data) * len(whole))


@pytest.mark.parametrize('storage', ['mcap', 'db3'])
def test_a_bag_without_its_metadata_is_read(tmp_path, replay, storage):
    write_hand(tmp_path / 'bag', 20, 3, storage)
    (tmp_path / 'bag' / 'metadata.yaml').unlink()
    code, row, answers, _ = replay(tmp_path / 'bag', '--task', LIFT)
    assert code == 1 and len(answers) == 20 and 'metadata.yaml' in row['damage'][0]
    code, row, answers, _ = replay(tmp_path / 'bag' / f'bag.{storage}', '--task', LIFT)
    assert code == 0 and len(answers) == 20


def test_what_waits_in_a_write_ahead_log_is_told(tmp_path, replay):
    write_hand(tmp_path / 'bag', 5, 3, 'db3')
    (tmp_path / 'bag' / 'bag.db3-wal').write_bytes(b'more')
    code, row, answers, _ = replay(tmp_path / 'bag', '--task', LIFT)
    assert code == 1 and len(answers) == 5 and 'wal_checkpoint' in row['damage'][0]


NO_ROS = """
import sys
from importlib.abc import MetaPathFinder

class Block(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.split('.')[0] in ('rclpy', 'ament_index_python') or (
                name.endswith(('_msgs', '_interfaces')) and '.' not in name):
            raise ModuleNotFoundError('blocked: ' + name)

sys.meta_path.insert(0, Block())
from grasp_quality_cli.main import main
sys.exit(main(sys.argv[1:]))
"""


def test_no_ros_is_needed(tmp_path):
    write_hand(tmp_path / 'bag', 3, 3, measured=True)
    done = subprocess.run(
        [sys.executable, '-c', NO_ROS, 'bag', tmp_path / 'bag', '--task', LIFT, '--json'],
        capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)['codes'] == {'OPTIMAL': 3}

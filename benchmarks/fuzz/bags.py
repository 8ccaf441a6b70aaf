# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Recorded bags are spoilt, and read by the command line: what is wrong is listed, nothing crashes.

``python -m benchmarks.fuzz.bags`` does so for many; a bag that breaks a rule is kept in
``build/fuzz``. Bytes are flipped, cut off, filled with huge lengths; in SQLite files cells get
values of other types; messages in whole bags get bytes that mean something else.
"""

import argparse
from contextlib import redirect_stderr, redirect_stdout
import io
from pathlib import Path
from random import Random
import resource
import shutil
import sqlite3
import struct
import sys
import tempfile
import traceback
from typing import Any

from benchmarks.recorded_bag import (
    BagWriter, PERIOD_NS, pinch, pose_array, START_NS, wrench_stamped)
from grasp_quality import GraspQualityError
from grasp_quality_cli.bag_problems import Problems
from grasp_quality_cli.bag_replay import contact_source, Question, replay
from grasp_quality_cli.bag_source import BagSource
from grasp_quality_cli.bag_tables import Tables
from grasp_quality_cli.main import main as program
from grasp_quality_cli.node_settings import read_settings
from grasp_quality_cli.task_text import chosen_task

BAGS = 2_000
WHOLE = 8  # one bag in so many goes through the whole program, with report and pictures
STORAGES = ('mcap', 'db3')
POSES, TASK = '/grasp_quality/contact_poses', '/grasp_quality/task_wrench'
TYPES = {POSES: 'geometry_msgs/msg/PoseArray', TASK: 'geometry_msgs/msg/WrenchStamped'}
ENDS = (0, 1, 2)  # read, read in part, no bag
MEMORY = 400 << 20  # bytes that the reading of small bags may add
CELLS: tuple[Any, ...] = (
    None, 0, -1, 2 ** 63 - 1, -2 ** 63, 1.5, 1e308, '', 'a', '\U0001f590', b'', b'\xff' * 9,
    POSES, 'geometry_msgs/msg/PoseArray')


def write_bag(folder: Path, storage: str, random: Random) -> Path:
    """Write a small bag, now and then with messages that are spoilt; return its file."""
    with BagWriter(folder, storage) as bag:
        bag.write(TASK, START_NS, wrench_stamped(START_NS, [0, 0, 2, 0, 0, 0], ''))
        for i in range(6):
            time_ns = START_NS + i * PERIOD_NS
            bag.write(POSES, time_ns, pose_array(time_ns, *pinch()))
        if random.random() < 0.4:
            for topic, kind in TYPES.items():
                data = bytes.fromhex('00010000') + random.randbytes(random.randrange(120))
                if random.random() < 0.5:  # a length that nothing can have
                    data = data[:16] + struct.pack('<I', random.choice(
                        (2 ** 31 - 1, 2 ** 32 - 1, 10 ** 6))) + data[16:]
                bag.write_raw(topic, START_NS + 20 * PERIOD_NS, kind, data)
    return next(folder.glob(f'*.{storage}'))


def spoil_bytes(data: bytes, random: Random) -> bytes:
    """Flip, cut, fill or move bytes."""
    found = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 8, 60))):
        at = random.randrange(max(1, len(found)))
        way = random.randrange(7)
        if way == 0:
            del found[at:]
        elif way == 1:
            del found[at:at + random.randrange(1, 64)]
        elif way == 2:
            found[at:at + 8] = struct.pack('<Q', random.choice(
                (2 ** 31 - 1, 2 ** 40, 2 ** 62, 2 ** 63, 2 ** 64 - 1, len(found))))
        elif way == 3:
            found[at:at] = random.randbytes(random.randrange(1, 64))
        elif way == 4:
            found[at:at + 64] = bytes(min(64, len(found) - at))
        elif found:
            found[at] ^= 1 << random.randrange(8)
    return bytes(found)


def spoil_cells(path: Path, random: Random) -> None:
    """Give cells of an SQLite bag values of other types, or take a table or column away."""
    base = sqlite3.connect(path)
    try:
        tables = {'topics': ('id', 'name', 'type', 'serialization_format', 'offered_qos_profiles'),
                  'messages': ('topic_id', 'timestamp', 'data'), 'schema': ('schema_version',),
                  'message_definitions': ('topic_type', 'encoding', 'encoded_message_definition')}
        for _ in range(random.choice((1, 1, 2, 5))):
            table = random.choice(list(tables))
            column, value = random.choice(tables[table]), random.choice(CELLS)
            statement = random.choice((
                f'UPDATE {table} SET {column} = ?',
                f'UPDATE {table} SET {column} = ? WHERE rowid = 2',
                f'ALTER TABLE {table} RENAME COLUMN {column} TO strange',
                f'DROP TABLE {table}', f'DELETE FROM {table}',
                f'CREATE VIEW v{random.randrange(9)} AS SELECT * FROM {table}'))
            try:
                base.execute(statement, (value,) if '?' in statement else ())
            except sqlite3.Error:
                continue
        base.commit()
    finally:
        base.close()


def spoil_bag(folder: Path, seed: int) -> Path:
    """Write a bag and spoil it; return what is to be read, its file or its folder."""
    random = Random(seed)
    storage = random.choice(STORAGES)
    file = write_bag(folder, storage, random)
    way = random.random()
    if storage == 'db3' and way < 0.5:
        spoil_cells(file, random)
    elif way < 0.9:
        file.write_bytes(spoil_bytes(file.read_bytes(), random))
    else:
        facts = folder / 'metadata.yaml'
        facts.write_bytes(spoil_bytes(facts.read_bytes(), random))
    return file if random.random() < 0.3 else folder


def replay_bag(path: Path, output: Path) -> str:
    """Read a bag as the command line does, without its pictures; return what is wrong."""
    output.mkdir()
    node = '/grasp_quality'
    try:
        source = BagSource(path)
        question = Question(read_settings(None, [], node, contact_source(source, node)), node,
                            chosen_task('0 0 2 0 0 0', {}), None)
        with Problems(output / 'problems.csv') as problems, Tables(output, 'parquet') as tables:
            replay(source, question, tables, problems, lambda count: None)
    except (GraspQualityError, OSError):
        return ''
    except BaseException:
        return traceback.format_exc()
    return ''


def read_bag(path: Path, output: Path) -> str:
    """Read a bag with the command line; return what is wrong, '' for nothing."""
    heard, complaint = io.StringIO(), io.StringIO()
    try:
        with redirect_stdout(heard), redirect_stderr(complaint):
            code = program(['bag', str(path), '-o', str(output), '--json', '--task',
                            '0 0 2 0 0 0'])
    except BaseException:
        return traceback.format_exc()
    words = complaint.getvalue()
    if code not in ENDS:
        return f'ended with {code}: {words}'
    if code == 2 and not words.startswith('error: '):
        return f'refused with the words {words!r}'
    return '' if 'Traceback' not in words else words


def run(seeds: range, folder: Path, kept: Path | None = None) -> dict[int, str]:
    """Spoil and read a bag for each seed; return what was wrong, by seed."""
    wrong, used = {}, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for seed in seeds:
        here = folder / str(seed)
        here.mkdir()
        read = read_bag if seed % WHOLE == 0 else replay_bag
        said = read(spoil_bag(here / 'bag', seed), here / 'out')
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        if (most - used) * 1024 > MEMORY:
            said = said or f'took {(most - used) >> 10} MB more'
            used = most
        if said:
            wrong[seed] = said
            if kept is not None:
                shutil.copytree(here / 'bag', kept / f'bag_{seed}', dirs_exist_ok=True)
        shutil.rmtree(here)
    return wrong


def main() -> int:
    """Spoil and read many bags; return 1 when one broke a rule."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--bags', type=int, default=BAGS)
    parser.add_argument('--seed', type=int, default=0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        wrong = run(range(arguments.seed, arguments.seed + arguments.bags), Path(folder),
                    Path('build/fuzz'))
    for seed, text in wrong.items():
        print(f'seed {seed}: {text.strip()[-600:]}')
    print(f'{arguments.bags:,} spoilt bags, {len(wrong)} that broke a rule')
    return int(bool(wrong))


if __name__ == '__main__':
    sys.exit(main())

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A recorded bag: a folder with metadata.yaml or without, one file, whole or damaged.

Whole files are read through ``rosbags``, which follows the index; a file that it refuses is
scanned from its beginning as far as it goes. Nothing is kept in memory but the chunk that is read.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
import re
from typing import cast

from grasp_quality import GraspQualityError
from grasp_quality_cli.bag_record import BagError, Part, Record, Wanted
from grasp_quality_cli.mcap_scan import McapScan
from grasp_quality_cli.sqlite_scan import missing_bytes, SqliteScan
from grasp_quality_cli.yaml_source import read_text
from rosbags.rosbag2 import Reader
from ruamel.yaml import YAML

SCANS: dict[str, type[McapScan | SqliteScan]] = {'.mcap': McapScan, '.db3': SqliteScan}


class NoBagError(GraspQualityError, ValueError):
    """There is no bag at this path."""


class WholePart:
    """A Part that rosbags can open: a file, or the folder of a compressed bag."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._reader = Reader(path)
        self._reader.open()
        self.counts: Counter[tuple[str, str]] = Counter()
        for connection in self._reader.connections:
            self.counts[connection.topic, connection.msgtype] += connection.msgcount
        total = self._reader.message_count
        # MCAP need not say how many there are of each topic
        self.total: int | None = total if total == sum(self.counts.values()) else None

    def records(self, wanted: Wanted) -> Iterator[Record]:
        """Read in the order of time; BagError where the content does not hold."""
        chosen = [c for c in self._reader.connections if wanted(c.topic)]
        read = 0
        try:
            for connection, time_ns, data in self._reader.messages(chosen) if chosen else ():
                read += 1
                yield Record(time_ns, connection.topic, connection.msgtype, connection.msgdef,
                             data)
        except GeneratorExit:
            raise
        except Exception as exc:  # rosbags, apsw, lz4 and zstd have no common base
            raise BagError(f'{self.path}: breaks off after {read:,} messages that matter: '
                           f'{exc}') from exc
        finally:
            self._reader.close()


class BagSource:
    """
    A bag, opened for one reading.

    Attributes
    ----------
    path : Path
    parts : list of Part
    damage : list of str
        What is missing or broken, in words; grows while the bag is read.

    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damage: list[str] = []
        if not path.exists():
            raise NoBagError(f'{path}: there is no such file or folder')
        self.parts = [self._part(file) for file in self._files()]

    def _files(self) -> list[Path]:
        if not self.path.is_dir():
            if self.path.suffix not in SCANS:
                raise NoBagError(
                    f'{self.path}: must be a .mcap or .db3 file, or the folder of a rosbag2')
            if not self.path.is_file():
                raise NoBagError(f'{self.path}: must be a regular file, not a pipe or a device: '
                                 'write what comes out of it to one first')
            return [self.path]
        files, compressed = self._files_of_metadata()
        if compressed:
            return [self.path]
        files = files or sorted(
            (file for file in self.path.iterdir() if file.suffix in SCANS and file.is_file()),
            key=_by_number)
        if not files:
            raise NoBagError(f'{self.path}: holds neither .mcap nor .db3 files')
        return files

    def _files_of_metadata(self) -> tuple[list[Path], bool]:
        """Files in their order as metadata.yaml says, and whether they are compressed by it."""
        file = self.path / 'metadata.yaml'
        try:
            facts = cast('dict[str, dict[str, object]]', YAML(typ='safe').load(
                read_text(file)))['rosbag2_bagfile_information']
            names = [Path(str(name)).name for name in cast('list[str]',
                                                           facts['relative_file_paths'])]
        except Exception as exc:  # missing, half written, not YAML: the files are there
            self.damage.append(f'{file}: cannot be used ({exc}), as after a recorder was killed; '
                               'the storage files are read all the same')
            return [], False
        if str(facts.get('compression_mode') or 'none').lower() in ('file', 'message'):
            return [], True
        there = [self.path / name for name in names if (self.path / name).is_file()]
        self.damage += [f'{self.path / name}: is missing' for name in names
                        if not (self.path / name).is_file()]
        return there, False

    def _part(self, path: Path) -> Part:
        pending = path.with_name(path.name + '-wal')
        if pending.exists() and pending.stat().st_size:
            self.damage.append(
                f'{pending}: holds what was recorded last and is not read; to have it in the bag: '
                f'sqlite3 {path} "PRAGMA wal_checkpoint"')
        try:
            if path.suffix == '.db3' and missing_bytes(path):
                raise BagError(f'{missing_bytes(path):,} bytes are missing at its end')
            return WholePart(path)
        except Exception as exc:  # rosbags, apsw and what they let through have no common base
            if path.suffix not in SCANS:
                raise NoBagError(f'{path}: cannot be read: {exc}') from exc
            self.damage.append(f'{path}: is damaged ({exc}); read from its beginning as far as '
                               'it goes')
            return SCANS[path.suffix](path)

    @property
    def counts(self) -> Counter[tuple[str, str]]:
        """(topic, type): number of messages, of damaged files of those seen so far."""
        return sum((Counter(part.counts) for part in self.parts), Counter())

    def total(self, wanted: Wanted) -> int | None:
        """Count the messages of the wanted topics; None where a damaged file does not tell."""
        if any(part.total is None for part in self.parts):
            return None
        return sum(count for (topic, _), count in self.counts.items() if wanted(topic))

    def records(self, wanted: Wanted) -> Iterator[Record]:
        """Read all parts, one after the other; what breaks off is told in ``damage``."""
        for part in self.parts:
            strange = 0  # SQLite keeps values of any type in any column
            try:
                for record in part.records(wanted):
                    if isinstance(record.time_ns, int) and isinstance(record.data, bytes):
                        yield record
                    else:
                        strange += 1
            except BagError as exc:
                self.damage.append(str(exc))
            if strange:
                self.damage.append(f'{self.path}: {strange:,} messages have a time that is no '
                                   'whole number, or content that is no bytes')


def _by_number(path: Path) -> list[tuple[int, str]]:
    """Sort bag_2 before bag_10."""
    return [(int(word), '') if word.isdigit() else (-1, word)
            for word in re.split(r'(\d+)', path.name)]

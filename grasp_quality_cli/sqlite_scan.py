# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A damaged SQLite bag (.db3), read row by row in the order of recording as far as it goes.

Neither the index nor the number of messages is asked for: of a file that is cut off, pages are
missing, and the first row on a missing page ends the reading. A page that is there in part counts
as missing, because SQLite would fill it up with zeros.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

import apsw
from grasp_quality_cli.bag_record import BagError, Record, Wanted
from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat

NO_DEFINITION = MessageDefinition(MessageDefinitionFormat.NONE, '')
FORMATS = {'ros2msg': MessageDefinitionFormat.MSG, 'ros2idl': MessageDefinitionFormat.IDL}
MESSAGES = 'SELECT topic_id, timestamp, data FROM messages ORDER BY id'
DEFINITIONS = 'SELECT topic_type, encoding, encoded_message_definition FROM message_definitions'


class WholePages(apsw.VFS):
    """A view of files that ends with the last page that is there as a whole."""

    def __init__(self, page: int) -> None:
        self.name = f'whole-pages-{page}'
        super().__init__(self.name, '')
        self._page = page

    def xOpen(self, name: str | apsw.URIFilename | None, flags: list[int]  # noqa: N802
              ) -> apsw.VFSFile:
        """Open a file."""
        page = self._page

        class File(apsw.VFSFile):

            def xFileSize(self) -> int:  # noqa: N802
                return super().xFileSize() // page * page

        return File('', name, flags)


class SqliteScan:
    """A Part for files that the indexed reader refuses."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.counts: Counter[tuple[str, str]] = Counter()
        self.total: int | None = None

    def records(self, wanted: Wanted) -> Iterator[Record]:
        """Read row after row; BagError where the file breaks off."""
        read = 0
        page, missing = _page_and_missing_bytes(self.path)
        view = WholePages(page)
        try:
            with closing(apsw.Connection(
                    f'file:{quote(str(self.path))}?immutable=1', vfs=view.name,
                    flags=apsw.SQLITE_OPEN_READONLY | apsw.SQLITE_OPEN_URI)) as base:
                # without it SQLite refuses a file that is shorter than its header says
                base.execute('PRAGMA writable_schema=ON')
                topics = {row[0]: row[1:] for row in base.execute(
                    'SELECT id, name, type FROM topics')}
                definitions = _definitions(base)
                for topic, time_ns, data in base.execute(MESSAGES):
                    name, msgtype = topics[topic]
                    read += 1
                    self.counts[name, msgtype] += 1
                    if wanted(name):
                        yield Record(time_ns, name, msgtype,
                                     definitions.get(msgtype, NO_DEFINITION), data)
        except (apsw.Error, KeyError) as exc:
            raise BagError(f'{self.path}: breaks off after {read:,} messages: {exc}') from exc
        finally:
            view.unregister()
        if missing:
            raise BagError(f'{self.path}: breaks off, {missing:,} bytes are missing at its end')


def missing_bytes(path: Path) -> int:
    """How much shorter a file is than its header says."""
    return _page_and_missing_bytes(path)[1]


def _page_and_missing_bytes(path: Path) -> tuple[int, int]:
    """Read page size and page count of the header, big-endian."""
    with path.open('rb') as file:
        head = file.read(32)
    if len(head) < 32:
        return 512, 32 - len(head)
    page = int.from_bytes(head[16:18], 'big')
    page = 65536 if page == 1 else max(page, 512)
    return page, max(0, page * int.from_bytes(head[28:32], 'big') - path.stat().st_size)


def _definitions(base: apsw.Connection) -> dict[str, MessageDefinition]:
    """Read what the bag says of its types; bags before ROS 2 Iron say nothing."""
    try:
        return {str(row[0]): MessageDefinition(
            FORMATS.get(str(row[1]), MessageDefinitionFormat.NONE), str(row[2]))
            for row in base.execute(DEFINITIONS)}
    except apsw.SQLError:
        return {}

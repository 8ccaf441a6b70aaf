# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
A damaged MCAP file, read from its beginning as far as it goes.

An MCAP file whose recorder was killed has no index at its end. Its records still stand one after
the other: a byte that tells the kind, eight for the length, the content; messages stand in chunks.
Of a chunk that breaks off, the messages that are whole count, unless it is compressed.
"""

from __future__ import annotations

from binascii import crc32
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
import struct
from typing import BinaryIO, NamedTuple

from grasp_quality_cli.bag_record import BagError, Record, Wanted
from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat
from rosbags.rosbag2.storage_mcap import DECOMPRESSORS

MAGIC = b'\x89MCAP0\r\n'
SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 0x03, 0x04, 0x05, 0x06, 0x0F
HEAD = struct.Struct('<BQ')           # kind, length
STAMPS = struct.Struct('<HIQQ')       # channel, sequence, log time, publish time
CHUNK_HEAD = struct.Struct('<QQQI')   # first and last time, size, checksum
FORMATS = {'ros2msg': MessageDefinitionFormat.MSG, 'ros2idl': MessageDefinitionFormat.IDL,
           'omgidl': MessageDefinitionFormat.IDL}
LARGEST_RECORD = 1 << 31  # a length beyond it is damage, not data


class Channel(NamedTuple):
    """Where a message belongs."""

    topic: str
    msgtype: str
    definition: MessageDefinition


class McapScan:
    """A Part for files that the indexed reader refuses."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.counts: Counter[tuple[str, str]] = Counter()
        self.total: int | None = None
        self._schemas: dict[int, tuple[str, MessageDefinition]] = {}
        self._channels: dict[int, Channel] = {}

    def records(self, wanted: Wanted) -> Iterator[Record]:
        """Read message after message; BagError where the file breaks off."""
        with self.path.open('rb') as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise BagError(f'{self.path}: is no MCAP file')
            while True:
                start = file.tell()
                head = file.read(HEAD.size)
                if len(head) < HEAD.size:
                    raise BagError(f'{self.path}: breaks off after {start:,} bytes, without the '
                                   'end that a recorder writes when it is stopped')
                kind, length = HEAD.unpack(head)
                if kind == DATA_END:
                    return
                yield from self._content(file, kind, length, start, wanted)

    def _content(self, file: BinaryIO, kind: int, length: int, start: int, wanted: Wanted
                 ) -> Iterator[Record]:
        if length > LARGEST_RECORD:
            raise BagError(f'{self.path}: is damaged after {start:,} bytes: a record of '
                           f'{length:,} bytes')
        content = file.read(length)
        try:
            if kind == CHUNK:
                yield from self._chunk(content, wanted)
            elif len(content) == length:
                yield from self._record(kind, content, wanted)
        except (struct.error, ValueError, KeyError, RuntimeError, EOFError) as exc:
            if len(content) == length:
                raise BagError(f'{self.path}: is damaged after {start:,} bytes: {exc}') from exc
        if len(content) < length:
            raise BagError(
                f'{self.path}: breaks off within the record at {start:,} bytes, of which '
                f'{length - len(content):,} of {length:,} bytes are missing')

    def _chunk(self, content: bytes, wanted: Wanted) -> Iterator[Record]:
        _, _, size, checksum = CHUNK_HEAD.unpack_from(content)
        compression, at = _string(content, CHUNK_HEAD.size)
        stored, = struct.unpack_from('<Q', content, at)
        packed = content[at + 8:at + 8 + stored]
        # a compressed chunk that breaks off fails here; of others the whole records are taken
        data = DECOMPRESSORS[compression](packed, size)
        if checksum and len(packed) == stored and crc32(data) != checksum:
            raise ValueError('a chunk does not match its checksum')
        at = 0
        while at + HEAD.size <= len(data):
            kind, length = HEAD.unpack_from(data, at)
            at += HEAD.size
            if at + length > len(data):
                break
            yield from self._record(kind, data[at:at + length], wanted)
            at += length

    def _record(self, kind: int, content: bytes, wanted: Wanted) -> Iterator[Record]:
        if kind == SCHEMA:
            key, = struct.unpack_from('<H', content)
            name, at = _string(content, 2)
            encoding, at = _string(content, at)
            text, _ = _string(content, at)
            self._schemas[key] = name, MessageDefinition(
                FORMATS.get(encoding, MessageDefinitionFormat.NONE), text)
        elif kind == CHANNEL:
            key, schema = struct.unpack_from('<HH', content)
            topic, _ = _string(content, 4)
            self._channels[key] = Channel(topic, *self._schemas[schema])
        elif kind == MESSAGE:
            key, _, time_ns, _ = STAMPS.unpack_from(content)
            channel = self._channels[key]
            self.counts[channel.topic, channel.msgtype] += 1
            if wanted(channel.topic):
                yield Record(time_ns, *channel, content[STAMPS.size:])


def _string(content: bytes, at: int) -> tuple[str, int]:
    """Read a string with its length before it; return it, and where it ends."""
    length, = struct.unpack_from('<I', content, at)
    end = at + 4 + length
    if end > len(content):
        raise ValueError('a text breaks off')
    return content[at + 4:end].decode(), end

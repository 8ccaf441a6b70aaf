# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What comes out of a recorded bag, whichever storage it has: records, and what was wrong."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol, TypeAlias

from rosbags.interfaces import MessageDefinition

Wanted: TypeAlias = Callable[[str], bool]  # whether a topic is to be read


class Record(NamedTuple):
    """
    One recorded message, still serialized.

    Attributes
    ----------
    time_ns : int
        When it was received by the recorder, since the epoch.
    topic, msgtype : str
    definition : MessageDefinition
        Of its type, where the bag holds it.
    data : bytes
        CDR.

    """

    time_ns: int
    topic: str
    msgtype: str
    definition: MessageDefinition
    data: bytes


class BagError(Exception):
    """A part of a bag cannot be read; the text says what was read before and why it ended."""


class Part(Protocol):
    """
    One storage file of a bag.

    Attributes
    ----------
    counts : Counter
        (topic, type): number of messages; of a damaged file, of those seen so far.
    total : int or None
        Number of the messages that are wanted, where it is known before reading.

    """

    counts: Counter[tuple[str, str]]
    total: int | None

    def records(self, wanted: Wanted) -> Iterator[Record]:
        """Read the wanted topics in the order of recording; BagError where it breaks off."""

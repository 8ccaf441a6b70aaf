# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Message types of a bag: its own definitions first, then those of ROS 2 Jazzy and of this package.

Bags before ROS 2 Iron hold no definitions; ours stand here for them, held to the .msg files by a
test.
"""

from __future__ import annotations

from typing import Any

from grasp_quality_cli.bag_record import Record
from rosbags.interfaces import MessageDefinitionFormat
from rosbags.typesys import get_types_from_idl, get_types_from_msg, get_typestore, Stores
from rosbags.typesys.store import Typestore

OURS = {
    'grasp_quality_msgs/msg/Contact': (
        'uint8 MODEL_DEFAULT=0\nuint8 MODEL_FPC=1\nuint8 MODEL_PCWF=2\nuint8 MODEL_SFCE=3\n'
        'string name\nstring finger\ngeometry_msgs/Pose pose\nuint8 model\n'
        'float64 friction_coefficient\nfloat64 torsional_friction_coefficient\n'
        'float64 max_normal_force\n'),
    'grasp_quality_msgs/msg/JointLimit': (
        'string name\nfloat64 max_torque\nfloat64 gravity_torque\n'
        'geometry_msgs/Twist[] twists\n'),
    'grasp_quality_msgs/msg/ContactArray': (
        'std_msgs/Header header\ngrasp_quality_msgs/Contact[] contacts\n'
        'grasp_quality_msgs/JointLimit[] joint_limits\n')}
IDL_RULE = '=' * 80 + '\n'


class UnknownTypeError(Exception):
    """The type of a message is defined neither in the bag nor here."""


class BagTypes:
    """Decodes records to objects with the fields of the ROS messages."""

    def __init__(self) -> None:
        self._stores: dict[str, Typestore] = {}

    def decode(self, record: Record) -> object:
        """
        Decode a record.

        Raises
        ------
        UnknownTypeError
            When nothing says what the bytes mean.
        Exception
            When they are not what the definition says; rosbags lets through many kinds.

        """
        store = self._stores.get(record.msgtype)
        if store is None:
            store = self._stores[record.msgtype] = _store_for(record)
        return store.deserialize_cdr(record.data, record.msgtype)


def _store_for(record: Record) -> Typestore:
    """Make a store of its own for each type: two files may define their parts differently."""
    kind, text = record.definition
    given = kind is not MessageDefinitionFormat.NONE
    store = get_typestore(Stores.EMPTY if given else Stores.ROS2_JAZZY)
    try:
        if kind is MessageDefinitionFormat.MSG:
            store.register(get_types_from_msg(text, record.msgtype))
        elif kind is MessageDefinitionFormat.IDL:
            store.register(_idl_types(text))
        else:
            for name, definition in OURS.items():
                store.register(get_types_from_msg(definition, name))
    except Exception as exc:  # rosbags lets through many kinds
        raise UnknownTypeError(
            f'the definition of {record.msgtype} in the bag cannot be used: {exc}') from exc
    if record.msgtype not in store.types:
        raise UnknownTypeError(
            f'type {record.msgtype} is not known: the bag does not hold its definition')
    return store


def _idl_types(text: str) -> dict[str, Any]:
    """Read IDL definitions; where there are several, a rule and a name stand before each."""
    if not text.startswith(IDL_RULE + 'IDL: '):
        return dict(get_types_from_idl(text))
    found: dict[str, Any] = {}
    for part in text.split(IDL_RULE)[1:]:
        found.update(get_types_from_idl(part.split('\n', 1)[1]))
    return found

# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Types of a bag: the same bytes are the same message whatever language defines it."""

from grasp_quality_cli.bag_record import Record
from grasp_quality_cli.bag_types import BagTypes, IDL_RULE, UnknownTypeError
import pytest
from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat
from rosbags.typesys import get_types_from_msg, get_typestore, Stores

PRESSED, AXIS = 'our_msgs/msg/Pressed', 'our_msgs/msg/Axis'
AXIS_MSG, PRESSED_MSG = 'float64 z\n', 'string name\nfloat64 force\nour_msgs/Axis along\n'
AXIS_IDL = 'module our_msgs { module msg { struct Axis { double z; }; }; };\n'
PRESSED_IDL = ('module our_msgs { module msg { struct Pressed {\n'
               '  string name; double force; our_msgs::msg::Axis along; }; }; };\n')
DEFINITIONS = {
    'msg': (MessageDefinitionFormat.MSG, f'{PRESSED_MSG}{IDL_RULE}MSG: our_msgs/Axis\n{AXIS_MSG}'),
    'idl': (MessageDefinitionFormat.IDL, AXIS_IDL + PRESSED_IDL),
    'several idl': (MessageDefinitionFormat.IDL,
                    f'{IDL_RULE}IDL: {PRESSED}\n{PRESSED_IDL}{IDL_RULE}IDL: {AXIS}\n{AXIS_IDL}')}


def record(definition, msgtype=PRESSED):
    """Return a record of one finger that presses with 2 N along z."""
    store = get_typestore(Stores.EMPTY)
    store.register({**get_types_from_msg(AXIS_MSG, AXIS),
                    **get_types_from_msg(PRESSED_MSG, PRESSED)})
    message = store.types[PRESSED]('thumb', 2.0, store.types[AXIS](1.0))
    return Record(0, 'pressed', msgtype, MessageDefinition(*definition),
                  bytes(store.serialize_cdr(message, PRESSED)))


@pytest.mark.parametrize('language', DEFINITIONS)
def test_every_language_says_the_same(language):
    types = BagTypes()
    for _ in range(2):  # the second time with what the first has learned
        message = types.decode(record(DEFINITIONS[language]))
        assert (message.name, message.force, message.along.z) == ('thumb', 2.0, 1.0)


@pytest.mark.parametrize('definition, words', [
    ((MessageDefinitionFormat.NONE, ''), 'does not hold its definition'),
    ((MessageDefinitionFormat.MSG, 'float64\n'), 'cannot be used'),
    ((MessageDefinitionFormat.IDL, 'struct {'), 'cannot be used'),
    ((MessageDefinitionFormat.IDL, AXIS_IDL), PRESSED)], ids=str)
def test_what_nothing_defines_is_named(definition, words):
    with pytest.raises(UnknownTypeError, match=words) as caught:
        BagTypes().decode(record(definition))
    assert PRESSED in str(caught.value)

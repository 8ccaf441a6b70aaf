# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Fields are spoilt: any field of a message, with numbers and words that nobody should send.

Where a message has lists they are cut, doubled and filled up too. What must come of it is told by
``refusals`` from the message alone.
"""

import math
from random import Random
import struct
from typing import Any

from benchmarks.fuzz.fields import Field, fields_of, FLOATS

HARD = (math.nan, math.inf, -math.inf, 1e300, -1e300, 1.7976931348623157e308, 1.1e12, -1.1e12)
ODD = (0.0, -0.0, 5e-324, -5e-324, 2.2250738585072014e-308, 1e-300, -1e-300, 1e-200, 1e-160,
       1e-150, 1e-80, 1e-30, 1e-16, 1e-13, 9.999e-13, 1e-12, 1.001e-12, 1e-9, 1e-6, 1e-3, 1.0,
       -1.0, math.pi / 2, 1.5707963267948963, 1e3, 1000.0000001, -1e3, 1e6, 1e9, -1e9, 1e12, -1e12)
WORDS = ('', 'a', 'contact_0', 'contact_1', 'tip_0', 'joint_0', 'object', 'ü', '接触', 'a b',
         'a\nb', '\t', 'x' * 300, '/', '"', "'", '{0}', '%s', '\u202e', '\U0001f590', 'nan')
INTEGERS = {
    'uint8': (0, 1, 2, 3, 4, 9, 255), 'int32': (0, -1, 1, -2 ** 31, 2 ** 31 - 1),
    'uint32': (0, 1, 2, 3, 999_999_999, 10 ** 9, 2 ** 32 - 1),
    'uint64': (0, 1, 2 ** 63, 2 ** 64 - 1), 'boolean': (False, True)}
HEADERS = ('header', 'stamp')
LONG = 12  # elements that a list is filled up with at most


def spoil(message: Any, random: Random, passed_over: tuple[str, ...] = ()) -> None:
    """Change one field, chosen by going down from the outermost message."""
    while True:
        fields = [f for f in fields_of(type(message)) if f.name not in passed_over]
        field = random.choices(fields, [_weight(f) for f in fields])[0]
        value = getattr(message, field.name)
        if field.is_list:
            if not len(value) or random.random() < 0.12:
                setattr(message, field.name, _relisted(value, field, random))
                return
            index = random.randrange(len(value))
            if field.cls is None:
                value[index] = changed(value[index], field.kind, random)
                return
            message = value[index]
        elif field.cls is not None:
            message = value
        else:
            setattr(message, field.name, changed(value, field.kind, random))
            return


def _weight(field: Field) -> float:
    if field.name in HEADERS:
        return 0.15
    return 3.0 if field.name in ('contacts', 'poses', 'pose') else 1.0


def changed(value: Any, kind: str, random: Random) -> Any:
    """Return another value of the same kind."""
    if kind in FLOATS:
        return _number(value, random)
    if kind == 'string':
        return random.choice(WORDS)
    return random.choice(INTEGERS[kind])


def _number(value: float, random: Random) -> float:
    way = random.random()
    if way < 0.08:
        return random.choice(HARD)
    if way < 0.5:
        return random.choice(ODD)
    if way < 0.56:  # any number that there is
        return float(struct.unpack('<d', random.randbytes(8))[0])
    if way < 0.68:
        return -value
    if way < 0.8:
        return value * (1.0 + random.choice((1e-16, 1e-12, 1e-9, 1e-6, 1e-4)))
    return value * 10.0 ** random.uniform(-9.0, 9.0)


def _relisted(value: Any, field: Field, random: Random) -> list[Any]:
    items = list(value)
    way = random.randrange(5)
    if way == 0:
        return []
    if way == 1 and items:
        del items[random.randrange(len(items))]
        return items
    if way == 2 and items:  # the same element once more
        return [*items, random.choice(items)]
    if way == 3:
        random.shuffle(items)
        return items
    new = field.cls() if field.cls else changed(1.0, field.kind, random)
    return [*items, *[new] * random.randint(1, LONG)]

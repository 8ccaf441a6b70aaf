# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Fields of ROS messages by name: to walk over them, to write them down and to read them back."""

from collections.abc import Iterator
from functools import cache
import importlib
from operator import attrgetter
from typing import Any, NamedTuple

FLOATS = ('double', 'float')


class Field(NamedTuple):
    """
    One field of a message type.

    ``kind`` is that of an element where ``is_list``; ``cls`` is its class where it is a message.

    """

    name: str
    kind: str
    is_list: bool
    cls: Any


@cache
def fields_of(cls: Any) -> tuple[Field, ...]:
    """Return the fields of a message class, in their order."""
    found = []
    for name, kind in cls.get_fields_and_field_types().items():
        is_list = kind.startswith('sequence<')
        element = kind.removeprefix('sequence<').removesuffix('>')
        package, slash, short = element.partition('/')
        found.append(Field(name, element, is_list, getattr(
            importlib.import_module(f'{package}.msg'), short) if slash else None))
    return tuple(found)


def numbers(message: Any, path: str = '') -> Iterator[tuple[str, float]]:
    """Yield every floating-point number of a message with its path."""
    for name, kind, is_list, cls in fields_of(type(message)):
        value = getattr(message, name)
        here = f'{path}.{name}' if path else name
        if cls is not None:
            if is_list:
                for i, item in enumerate(value):
                    yield from numbers(item, f'{here}[{i}]')
            else:
                yield from numbers(value, here)
        elif kind in FLOATS:
            if is_list:
                for i, item in enumerate(value):
                    yield f'{here}[{i}]', item
            else:
                yield here, value


@cache
def _flat(cls: Any) -> tuple[Any, tuple[str, ...], tuple[tuple[str, Field], ...]]:
    """Getter of all numbers that stand in no list, their paths, and the lists by theirs."""
    paths, lists = [], []
    for field in fields_of(cls):
        if field.is_list:
            if field.cls is not None or field.kind in FLOATS:
                lists.append((field.name, field))
        elif field.cls is not None:
            _, inner, inner_lists = _flat(field.cls)
            paths += [f'{field.name}.{path}' for path in inner]
            lists += [(f'{field.name}.{path}', part) for path, part in inner_lists]
        elif field.kind in FLOATS:
            paths.append(field.name)
    getter = attrgetter(*paths) if len(paths) > 1 else None
    return getter, tuple(paths), tuple(lists)


def all_within(message: Any, largest: float) -> bool:
    """Tell whether all numbers of a message are numbers, and of at most that size; fast."""
    getter, paths, lists = _flat(type(message))
    values = getter(message) if getter else [getattr(message, path) for path in paths]
    for value in values:
        if not -largest <= value <= largest:
            return False
    for path, field in lists:
        for item in attrgetter(path)(message):
            if not (all_within(item, largest) if field.cls else -largest <= item <= largest):
                return False
    return True


def to_plain(message: Any) -> dict[str, Any]:
    """Write a message as plain values; what is as in a new message is left out."""
    plain: dict[str, Any] = {}
    for name, _, is_list, cls in fields_of(type(message)):
        value = getattr(message, name)
        if is_list:
            items = [to_plain(item) if cls else item for item in value]
            if items:
                plain[name] = items
        elif cls is not None:
            if parts := to_plain(value):
                plain[name] = parts
        elif repr(value) != repr(getattr(type(message)(), name)):  # tells -0.0 from 0.0
            plain[name] = value
    return plain


def from_plain(cls: Any, plain: dict[str, Any]) -> Any:
    """Read a message back."""
    message = cls()
    for name, _, is_list, part in fields_of(cls):
        if name in plain:
            value = plain[name]
            if part is not None:
                value = [from_plain(part, item) for item in value] if is_list else from_plain(
                    part, value)
            setattr(message, name, value)
    missing = set(plain) - {field.name for field in fields_of(cls)}
    if missing:
        raise ValueError(f'{cls.__name__} has no field {sorted(missing)}')
    return message

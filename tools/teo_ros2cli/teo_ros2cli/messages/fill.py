# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Filling a message from a tree of values, strictly.

The generated setters do not check what they are given unless asked to, and the C code below them trusts it;
so every value is checked here against the type of its field, with the field named in the error.
"""

from __future__ import annotations

import array
import contextlib
import math
import struct
from collections.abc import Callable
from typing import Any

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import interface_class, interface_name_of
from teo_ros2cli.messages.tree import Scalar, parse, plain

# Takes a builtin_interfaces/msg/Time.
StampSetter = Callable[[Any], None]

_INTEGER_RANGES = {
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
    "char": (0, 255),
    "wchar": (0, 2**16 - 1),
}
_TYPE_CODES = {
    "float": "f",
    "double": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
}


def fill_from_text(message: Any, text: str, *, automatic_stamps: bool = False) -> list[StampSetter]:
    """Set the fields of a message that a mapping in YAML names; the others keep their values.

    Args:
        message: The message to change.
        text: The mapping.
        automatic_stamps: Let `header: auto` and `stamp: now` stand for the time of publishing.

    Returns:
        One setter for each place that is to get the time of publishing, each time the message is published.

    Raises:
        Ros2CliError: `invalid_yaml`; `invalid_field`, naming the field, what it takes and what came.
    """
    values = parse(text)
    if not isinstance(values, dict):
        raise Ros2CliError("invalid_yaml", "The passed value needs to be a dictionary in YAML format")
    setters: list[StampSetter] = []
    try:
        _Filler(automatic_stamps, setters).fill(message, values, "")
    except Ros2CliError as error:
        raise Ros2CliError(error.code, f"Failed to populate field: {error}") from error
    return setters


class _Filler:
    def __init__(self, automatic_stamps: bool, setters: list[StampSetter]) -> None:
        self._automatic = automatic_stamps
        self._setters = setters

    def fill(self, message: Any, values: Any, path: str) -> None:
        if isinstance(values, Scalar) and values.value is None:
            values = {}
        if not isinstance(values, dict):
            raise _fault(path, f"a mapping of the fields of {interface_name_of(message)}", values)
        names = list(message.get_fields_and_field_types())
        types = dict(zip(names, message.SLOT_TYPES, strict=False))
        for key, value in values.items():
            name = key.text if isinstance(key, Scalar) else key
            where = f"{path}.{name}" if path else str(name)
            if name not in types:
                raise Ros2CliError(
                    "invalid_field",
                    f"'{interface_name_of(message)}' has no field '{name}' (at '{where}'); "
                    f"it has {', '.join(names) or 'none'}",
                )
            if not self._take_automatic(message, name, types[name], value):
                setattr(message, name, self._convert(value, types[name], where))

    def _take_automatic(self, message: Any, name: str, kind: Any, value: Any) -> bool:
        """Note a place for the time of publishing; False if the value is none of the two words."""
        word = value.text if isinstance(value, Scalar) else value
        if not self._automatic or not isinstance(kind, NamespacedType) or not isinstance(word, str):
            return False
        full_name = "/".join(kind.namespaced_name())
        if word == "auto" and full_name == "std_msgs/msg/Header":
            header = getattr(message, name)
            self._setters.append(lambda stamp: setattr(header, "stamp", stamp))
            return True
        if word == "now" and full_name == "builtin_interfaces/msg/Time":
            self._setters.append(lambda stamp: setattr(message, name, stamp))
            return True
        return False

    def _convert(self, value: Any, kind: Any, path: str) -> Any:
        if isinstance(kind, NamespacedType):
            message = interface_class("/".join(kind.namespaced_name()), kind.namespaces[1])()
            self.fill(message, value, path)
            return message
        if isinstance(kind, AbstractNestedType):
            return self._convert_sequence(value, kind, path)
        if isinstance(kind, AbstractString | AbstractWString):
            return _string(value, kind, path)
        return _basic(value, kind, path)

    def _convert_sequence(self, value: Any, kind: AbstractNestedType, path: str) -> Any:
        octets = isinstance(kind.value_type, BasicType) and kind.value_type.typename in ("uint8", "octet")
        if isinstance(value, Scalar) and isinstance(value.value, bytes) and octets:
            value = list(value.value)  # !!binary
        if not isinstance(value, list):
            raise _fault(path, f"a sequence of {_word(kind.value_type)}", value)
        if isinstance(kind, Array) and len(value) != kind.size:
            raise _fault(path, f"exactly {kind.size} values", value)
        if isinstance(kind, BoundedSequence) and len(value) > kind.maximum_size:
            raise _fault(path, f"at most {kind.maximum_size} values", value)
        items = [self._convert(item, kind.value_type, f"{path}[{i}]") for i, item in enumerate(value)]
        code = _TYPE_CODES.get(getattr(kind.value_type, "typename", ""))
        if code is None:
            return items
        if isinstance(kind, Array):
            import numpy as np  # the generated classes hold fixed arrays of numbers in numpy

            return np.array(items, dtype=np.dtype(code))
        return array.array(code, items)


def _string(value: Any, kind: AbstractString | AbstractWString, path: str) -> str:
    text = value.text if isinstance(value, Scalar) else value
    if not isinstance(text, str):
        raise _fault(path, "a string", value)
    limit = getattr(kind, "maximum_size", None)
    if limit is not None and len(text.encode()) > limit:
        raise _fault(path, f"a string of at most {limit} bytes", value)
    if "\0" in text:
        raise _fault(path, "a string without NUL characters, which the wire format ends strings with", value)
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise _fault(path, "a string that can be written as UTF-8", value) from error
    return text


def _basic(value: Any, kind: BasicType, path: str) -> Any:
    name = kind.typename
    meant = value.value if isinstance(value, Scalar) else value
    if name == "boolean":
        return _boolean(meant, value, path)
    if name == "octet":
        return _octet(meant, value, path)
    if name in _INTEGER_RANGES:
        return _integer(meant, value, name, path)
    return _real(meant, value, name, path)


def _boolean(meant: Any, value: Any, path: str) -> bool:
    if isinstance(meant, bool):
        return meant
    if isinstance(meant, int) and meant in (0, 1):
        return bool(meant)
    if isinstance(meant, str) and meant.lower() in ("true", "false"):
        return meant.lower() == "true"
    raise _fault(path, "true or false", value)


def _octet(meant: Any, value: Any, path: str) -> bytes:
    if isinstance(meant, bytes) and len(meant) == 1:
        return meant
    if isinstance(meant, int) and not isinstance(meant, bool) and 0 <= meant <= 255:
        return bytes([meant])
    if isinstance(meant, str) and len(meant) == 1 and ord(meant) < 256:
        return bytes([ord(meant)])  # as a message is printed
    raise _fault(path, "one byte, a number from 0 to 255", value)


def _integer(meant: Any, value: Any, name: str, path: str) -> int:
    low, high = _INTEGER_RANGES[name]
    number: int | None = None
    if isinstance(meant, int) and not isinstance(meant, bool):
        number = meant
    elif isinstance(meant, float) and meant.is_integer():
        number = int(meant)
    elif isinstance(meant, str):
        with contextlib.suppress(ValueError):
            number = int(meant, 0)
    if number is None or not low <= number <= high:
        raise _fault(path, f"an integer from {low} to {high}", value)
    return number


def _real(meant: Any, value: Any, name: str, path: str) -> float:
    # YAML 1.1 reads 1e-3, which has no point, as a string.
    if isinstance(meant, bool) or not isinstance(meant, int | float | str):
        raise _fault(path, "a number", value)
    try:
        number = float(meant)
    except (OverflowError, ValueError) as error:
        raise _fault(path, "a number", value) from error
    if name == "float" and math.isfinite(number):
        try:
            struct.pack("<f", number)
        except OverflowError as error:
            raise _fault(path, "a number that fits a 32-bit float", value) from error
    return number


def _word(kind: Any) -> str:
    if isinstance(kind, NamespacedType):
        return "/".join(kind.namespaced_name())
    if isinstance(kind, BasicType):
        return str(kind.typename)
    return "string"


def _fault(path: str, expected: str, value: Any) -> Ros2CliError:
    text = repr(value.text if isinstance(value, Scalar) else plain(value))
    text = text if len(text) <= 60 else f"{text[:57]}..."
    size = f" of {len(value)} values" if isinstance(value, list) else ""
    return Ros2CliError("invalid_field", f"field '{path}' takes {expected}, got {text}{size}")

"""Messages as bytes, and back: CDR as ROS 2 has it (XCDR version 1, plain).

Four bytes say how it is encoded; numbers follow, each at a multiple of its own size from there on.
A text is its length with the closing NUL, a sequence its length; a fixed array is its elements.
Source: OMG DDS-XTYPES 1.3, 7.4.1-7.4.3.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, cast

from executive.frontends.ros2.interfaces import PRIMITIVES, Field, fields
from robot.errors import RobotError

LITTLE, BIG = b"\x00\x01\x00\x00", b"\x00\x00\x00\x00"
"""Encapsulation headers: CDR_LE and CDR_BE, no options."""
HEADER_BYTES = 4
MOST_PADDING = 3
"""Bytes that may follow a message: DDS fills up to a multiple of four."""

Write = Callable[[bytearray, Any], None]


class CdrError(RobotError):
    """Bytes are not the message that they should be, or a value fits into none."""


def encode(interface: str, message: Mapping[str, Any]) -> bytes:
    """A message as CDR, little endian.

    Args:
        interface: "std_msgs/msg/String".
        message: its fields, nested ones as mappings; what is left out is zero or empty.

    Raises:
        CdrError: a field has no place in it, or a value none in its field.
    """
    out = bytearray(LITTLE)
    try:
        _writer(interface)(out, message)
    except (struct.error, OverflowError, TypeError, ValueError, AttributeError) as error:
        raise CdrError(f"{interface}: {error}") from error
    return bytes(out)


def decode(interface: str, data: bytes) -> dict[str, Any]:
    """The fields of a message, nested ones as dictionaries, `uint8[]` as bytes.

    Raises:
        CdrError: the bytes are not such a message.
    """
    reader = _Reader(data)
    message = reader.message(interface)
    if len(data) - reader.at > MOST_PADDING:
        raise CdrError(f"{interface}: {len(data) - reader.at} bytes too many")
    return message


# --- writing ---


def _align(out: bytearray, size: int) -> None:
    out.extend(bytes((HEADER_BYTES - len(out)) % size))


@cache
def _writer(interface: str) -> Write:
    """Writes messages of one kind; made once of its definition."""
    parts = [(field.name, _field_writer(field), _nothing(field)) for field in fields(interface)]
    names = frozenset(name for name, _, _ in parts)

    def write(out: bytearray, message: Mapping[str, Any]) -> None:
        if not names.issuperset(message):
            strange = ", ".join(sorted(set(message) - names))
            raise CdrError(f"{interface} has no {strange}")
        for name, put, nothing in parts:
            put(out, message.get(name, nothing))

    return write


def _nothing(field: Field) -> Any:
    """What a field holds that nobody has filled."""
    if field.size is not None:
        one = _nothing(field._replace(size=None))
        return (one,) * field.size
    if field.of == "string":
        return ""
    return 0 if field.of in PRIMITIVES else {}


def _field_writer(field: Field) -> Write:
    many = field.size is not None
    if field.of in PRIMITIVES:
        return _numbers_writer(field) if many else _number_writer(PRIMITIVES[field.of])
    one = _text if field.of == "string" else _writer(field.of)
    return _each(field, one) if many else one


def _number_writer(letter: str) -> Write:
    packed = struct.Struct(f"<{letter}")
    size = packed.size

    def put(out: bytearray, value: Any) -> None:
        if size > 1:
            _align(out, size)
        out.extend(packed.pack(value))

    return put


def _numbers_writer(field: Field) -> Write:
    letter = PRIMITIVES[field.of]
    size = struct.calcsize(f"<{letter}")

    def put(out: bytearray, values: Any) -> None:
        _count(out, field, len(values))
        if not len(values):
            return  # an empty sequence is not padded for the elements that it lacks
        _align(out, size)
        if letter == "B" and isinstance(values, bytes | bytearray | memoryview):
            out.extend(bytes(cast("bytes", values)))
        else:
            out.extend(struct.pack(f"<{len(values)}{letter}", *values))

    return put


def _each(field: Field, one: Write) -> Write:
    def put(out: bytearray, values: Any) -> None:
        _count(out, field, len(values))
        for value in values:
            one(out, value)

    return put


def _count(out: bytearray, field: Field, count: int) -> None:
    """How many follow, where that is not fixed."""
    if field.size == 0:
        _align(out, 4)
        out.extend(struct.pack("<I", count))
    elif count != field.size:
        raise CdrError(f"{field.name} takes {field.size}, not {count}")


def _text(out: bytearray, text: str) -> None:
    data = text.encode()
    _align(out, 4)
    out.extend(struct.pack("<I", len(data) + 1))
    out.extend(data)
    out.append(0)


# --- reading ---


class _Reader:
    """Reads from the front; `at` is how far."""

    def __init__(self, data: bytes) -> None:
        if data[:2] not in (LITTLE[:2], BIG[:2]):
            raise CdrError(f"no CDR: it begins with {data[:HEADER_BYTES].hex() or 'nothing'}")
        if len(data) < HEADER_BYTES:
            raise CdrError("no CDR: it ends in its header")
        self._data = data
        self._order = "<" if data[1] else ">"
        self.at = HEADER_BYTES

    def message(self, interface: str) -> dict[str, Any]:
        """All fields of a message."""
        return {field.name: self._field(field) for field in fields(interface)}

    def _field(self, field: Field) -> Any:
        if field.size is None:
            return self._one(field.of)
        count = field.size or self._number("I")
        if count > len(self._data) - self.at:
            raise CdrError(f"{field.name} ends early: {count} elements")
        if field.of in PRIMITIVES:
            return self._numbers(PRIMITIVES[field.of], count)
        return [self._one(field.of) for _ in range(count)]

    def _one(self, of: str) -> Any:
        if of == "string":
            return self._text()
        return self._number(PRIMITIVES[of]) if of in PRIMITIVES else self.message(of)

    def _number(self, letter: str) -> Any:
        return self._unpack(letter, 1)[0]

    def _numbers(self, letter: str, count: int) -> Any:
        if letter == "B":
            return self._take(count)
        return list(self._unpack(letter, count)) if count else []

    def _unpack(self, letter: str, count: int) -> tuple[Any, ...]:
        size = struct.calcsize(f"<{letter}")
        self.at += (HEADER_BYTES - self.at) % size
        return struct.unpack(f"{self._order}{count}{letter}", self._take(size * count))

    def _text(self) -> str:
        length = int(self._number("I"))
        if not length:
            return ""  # some write an empty text without its NUL
        data = self._take(length)
        if data[-1]:
            raise CdrError("a text does not end with NUL")
        try:
            return data[:-1].decode()
        except UnicodeDecodeError:
            raise CdrError("a text is no UTF-8") from None

    def _take(self, count: int) -> bytes:
        data = self._data[self.at : self.at + count]
        if len(data) < count:
            raise CdrError(f"it ends early, at byte {len(self._data)}")
        self.at += count
        return data

"""Whether a network in ONNX holds all of itself: weights may be said to lie in other files.

onnxruntime would read those, by any name in the current folder, for whoever made the network. The
file is walked through as what it is, messages of [Protocol Buffers] that hold one another; the
numbers of their fields are those of onnx.proto (onnx/onnx, field numbers do not change).
"""

from __future__ import annotations

from collections.abc import Iterator

TENSOR = "tensor"
EXTERNAL_DATA, DATA_LOCATION = 13, 14
"""Fields of a tensor: where its data are, and whether they are elsewhere."""
HOLDS: dict[str, dict[int, str]] = {
    "model": {7: "graph", 20: "training", 25: "function"},
    "training": {1: "graph", 2: "graph"},
    "function": {7: "node", 11: "attribute"},
    "graph": {1: "node", 5: TENSOR, 15: "sparse"},
    "node": {5: "attribute"},
    "attribute": {5: TENSOR, 6: "graph", 10: TENSOR, 11: "graph", 22: "sparse", 23: "sparse"},
    "sparse": {1: TENSOR, 2: TENSOR},
    TENSOR: {},
}
"""The messages that a message holds, by number of the field."""
_VARINT, _FIXED_64, _BYTES, _FIXED_32 = 0, 1, 2, 5
_MOST_DIGITS = 10
"""Of a number, seven bits each."""
MOST_FIELDS, MOST_DEPTH = 1_000_000, 100
"""Large detectors have some 50,000 fields, in messages seven deep."""
_KEY_BITS = 32
"""Readers in C++ forget those above: a field would be another one to them."""


def is_whole(data: bytes) -> bool:
    """Whether no tensor of a network lies in another file.

    Raises:
        ValueError: this is no network in ONNX.
    """
    seen = 0
    inside = [("model", _fields(data, 0, len(data)))]
    while inside:
        kind, fields = inside[-1]
        for field, value, size in fields:
            seen += 1
            if seen > MOST_FIELDS or len(inside) > MOST_DEPTH:
                raise ValueError("more fields, or deeper, than any network has")
            if kind == TENSOR and (field == EXTERNAL_DATA or (field == DATA_LOCATION and value)):
                return False
            if size >= 0 and field in HOLDS[kind]:
                inside.append((HOLDS[kind][field], _fields(data, value, value + size)))
                break
        else:
            inside.pop()
    return True


def _fields(data: bytes, at: int, end: int) -> Iterator[tuple[int, int, int]]:
    """The fields of a message: number, value, and size, -1 of a number; else it begins there."""
    while at < end:
        key, at = _varint(data, at, end)
        field, wire = key >> 3, key & 7
        if not field or key >> _KEY_BITS:
            raise ValueError("no field has that number")
        value, size = 0, -1
        if wire == _VARINT:
            value, at = _varint(data, at, end)
        elif wire in (_FIXED_64, _FIXED_32):
            at += 8 if wire == _FIXED_64 else 4
        elif wire == _BYTES:
            size, value = _varint(data, at, end)
            at = value + size
        else:
            raise ValueError("groups are not used")
        if at > end:
            raise ValueError("a field ends behind its message")
        yield field, value, size


def _varint(data: bytes, at: int, end: int) -> tuple[int, int]:
    """A number, and where what follows it begins."""
    value = 0
    for digit in range(_MOST_DIGITS):
        if at + digit >= end:
            break
        byte = data[at + digit]
        value |= (byte & 0x7F) << 7 * digit
        if byte < 0x80:
            return value, at + digit + 1
    raise ValueError("a number does not end")

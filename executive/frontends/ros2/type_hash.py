"""The hash by which ROS 2 machines know that they mean the same message: RIHS01 (REP-2016).

SHA-256 of the type's description as JSON: the type itself, then all that it is made of, by name.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from functools import cache
from typing import Any

from executive.frontends.ros2.interfaces import PRIMITIVES, Field, fields

_TYPE_IDS = {
    "int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8,
    "uint64": 9, "float32": 10, "float64": 11, "bool": 15, "byte": 16, "string": 17,
}  # fmt: skip
"""type_description_interfaces/msg/FieldType."""
_NESTED = 1
_ARRAY, _BOUNDED, _SEQUENCE = 48, 96, 144
"""What is added to a type's number for so many, so many at most, as many as come."""


@cache
def type_hash(interface: str) -> str:
    """`RIHS01_` and 64 hexadecimal digits, of a message or service. Raises KeyError for others."""
    described = {
        "type_description": _described(interface),
        "referenced_type_descriptions": [
            _described(name) for name in sorted(set(_parts(interface)))
        ],
    }
    return f"RIHS01_{hashlib.sha256(json.dumps(described).encode()).hexdigest()}"


def _described(interface: str) -> dict[str, Any]:
    return {"type_name": interface, "fields": [_field(one) for one in fields(interface)]}


def _field(field: Field) -> dict[str, Any]:
    number = _TYPE_IDS.get(field.of, _NESTED)
    if field.size is None:
        many = 0
    elif field.size:
        many = _ARRAY
    else:
        many = _BOUNDED if field.most else _SEQUENCE
    kind = {
        "type_id": number + many,
        "capacity": field.size or field.most,
        "string_capacity": 0,
        "nested_type_name": field.of if number == _NESTED else "",
    }
    return {"name": field.name, "type": kind}


def _parts(interface: str) -> Iterator[str]:
    """Every message that a message is made of, however deep."""
    for field in fields(interface):
        if field.of not in PRIMITIVES and field.of != "string":
            yield field.of
            yield from _parts(field.of)

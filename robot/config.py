"""YAML files read into frozen types; mistakes are named by place and nearest valid name."""

from __future__ import annotations

import difflib
import re
from pathlib import Path
from types import UnionType
from typing import Any, TypeVar, Union, get_args, get_origin

import msgspec

from robot import yaml_nodes
from robot.errors import ConfigError, Problem
from robot.type_words import said
from robot.yaml_nodes import Node

T = TypeVar("T")


def load(path: Path | str, kind: type[T]) -> T:
    """Read a YAML file into a msgspec type.

    Raises:
        ConfigError: with every unknown key, or the first wrong type, each with its place.
    """
    return convert(yaml_nodes.read(path), kind)


def convert(node: Node, kind: type[T]) -> T:
    """Turn a node into a msgspec type; raises ConfigError as `load` does."""
    problems: list[Problem] = []
    _find_unknown(node, kind, problems)
    if problems:
        raise ConfigError(problems)
    try:
        return msgspec.convert(node.plain_data, kind)
    except msgspec.ValidationError as error:
        message, _, where = str(error).partition(" - at `")
        where = where.rstrip("`")
        at = f" at {where.removeprefix('$.')}" if where else ""
        raise ConfigError([place(node, where).problem(said(message) + at)]) from None


def place(node: Node, where: str) -> Node:
    """What stands at a msgspec path such as `$.rooms[0].name`: the key, or the item of a list."""
    found = node
    for key, index in re.findall(r"\.([\w-]+)|\[(\d+)\]", where.removeprefix("$")):
        if key in node.entries:
            found, node = node.entries[key]
        elif index and int(index) < len(node.items):
            found = node = node.items[int(index)]
        else:
            break
    return found


def nearest(name: str, valid: list[str]) -> str:
    """`did you mean 'x'?`, or the list of what is valid."""
    close = difflib.get_close_matches(name, valid, n=1, cutoff=0.5)
    if close:
        return f"did you mean {close[0]!r}?"
    return "valid: " + ", ".join(sorted(valid)[:12])


def _find_unknown(node: Node, kind: Any, problems: list[Problem]) -> None:
    """Collect every key that its struct does not have."""
    fields, value_kind = _fields_of(kind), _value_kind(kind)
    for name, (key, value) in node.entries.items():
        if fields is not None and name not in fields:
            hint = nearest(name, list(fields))
            problems.append(key.problem(f"unknown key {name!r}", hint))
            continue
        _find_unknown(value, fields[name] if fields else value_kind, problems)
    for item in node.items:
        _find_unknown(item, _item_kind(kind), problems)


def _alternatives(kind: Any) -> tuple[Any, ...]:
    """The members of a union, or the type alone."""
    return get_args(kind) if get_origin(kind) in (Union, UnionType) else (kind,)


def _fields_of(kind: Any) -> dict[str, Any] | None:
    for candidate in _alternatives(kind):
        if isinstance(candidate, type) and issubclass(candidate, msgspec.Struct):
            info = msgspec.structs.fields(candidate)
            return {field.encode_name: field.type for field in info}
    return None


def _value_kind(kind: Any) -> Any:
    for candidate in _alternatives(kind):
        if get_origin(candidate) is dict:
            return get_args(candidate)[1]
    return Any


def _item_kind(kind: Any) -> Any:
    for candidate in _alternatives(kind):
        if get_origin(candidate) in (list, tuple):
            return get_args(candidate)[0]
    return Any

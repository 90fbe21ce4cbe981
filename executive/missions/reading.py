"""Nodes of a file to typed records, with every mistake noted where it stands."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any, TypeVar

import msgspec
from msgspec import inspect as types

from executive.missions.problems import Problems
from executive.missions.schema import Record
from robot.files.config import nearest
from robot.files.type_words import in_words
from robot.files.yaml_nodes import Node

BEYOND = 1e9
"""Numbers of that size and more mean nothing here."""
T = TypeVar("T", bound=Record)

Fill = Callable[[Node], "Node | None"]
"""Puts the values of parameters into a text; None if that cannot be."""


class Mistake(Exception):
    """A value cannot be read; its problem is noted. Never leaves the reader."""


class Reader:
    """Reads records; what is wrong goes to `problems`."""

    def __init__(self, problems: Problems, fill: Fill) -> None:
        """Note problems in `problems`; texts go through `fill` first."""
        self._problems = problems
        self._fill = fill
        self._key = ""
        self._words: tuple[str, ...] | None = None

    def record(self, node: Node, kind: type[T]) -> T | None:
        """A mapping as a record; None if anything in it is wrong."""
        try:
            return self._struct(node, _info(kind))
        except Mistake:
            return None

    def readable(self, node: Node, kind: type[Record]) -> Node:
        """What can be read of a mapping: of what it holds too, so that the rest is looked at."""
        return self._pruned(node, _info(kind).fields) or Node(
            "map", node.file, node.line, node.column
        )

    def _pruned(self, node: Node, fields: Iterable[types.Field]) -> Node | None:
        """The keys of a mapping that can be read; None if there are none."""
        left = Node("map", node.file, node.line, node.column)
        known = {field.encode_name: field.type for field in fields}
        for name, (key, value) in node.entries.items():
            if name in known and (kept := self._readable(value, known[name])) is not None:
                left.entries[name] = (key, kept)
        return left if left.entries else None

    def _readable(self, node: Node, info: types.Type) -> Node | None:
        """What can be read of a value; None if it means nothing."""
        if self._is_read(node, info):
            return node
        if isinstance(info, types.Metadata):
            return self._readable(node, info.type)
        if isinstance(info, types.UnionType):
            try:
                return self._readable(node, self._choose(node, info))
            except Mistake:
                return None
        left = None
        if isinstance(info, types.StructType) and node.kind == "map":
            left = self._pruned(node, info.fields)
        elif isinstance(info, types.VarTupleType | types.ListType) and node.kind == "list":
            left = Node("list", node.file, node.line, node.column)
            items = [self._readable(item, info.item_type) for item in node.items]
            left.items = [item for item in items if item is not None]
        return left if left is not None and self._is_read(left, info) else None

    def _is_read(self, node: Node, info: types.Type) -> bool:
        try:
            self._value(node, info)
        except Mistake:
            return False
        return True

    def _value(self, node: Node, info: types.Type) -> Any:
        if isinstance(info, types.CustomType):
            return node
        if isinstance(info, types.Metadata):
            info = info.type
        if node.kind == "text":
            filled = self._fill(node) if "{" in node.text else node
            if filled is None:
                raise Mistake
            node = filled
        if isinstance(info, types.UnionType):
            info = self._choose(node, info)
        match info:
            case types.StructType():
                return self._struct(node, info)
            case types.VarTupleType() | types.ListType():
                return self._list(node, info)
            case types.DictType():
                return self._dict(node, info)
            case types.AnyType():
                return node.plain_data
            case _:
                return self._scalar(node, info)

    def _choose(self, node: Node, info: types.UnionType) -> types.Type:
        """The member of a union that fits the shape of a node best."""
        members = _members(info)
        if node.kind == "map":
            kinds = (types.StructType, types.DictType)
        elif node.kind == "list":
            kinds = (types.VarTupleType, types.ListType)
        else:
            kinds = _SCALARS.get(type(node.value), (types.StrType, types.LiteralType))
        fitting = (t for kind in kinds for t in members if isinstance(t, kind))
        found = next(fitting, None)
        if found is not None:
            return found
        words = " or ".join(dict.fromkeys(in_words(t) for t in members))
        raise self._wrong(node, f"{self._key}: {_shape(node)} where {words} should be")

    def _struct(self, node: Node, info: types.StructType) -> Any:
        fields = _fields(info)
        if node.kind != "map":
            keys = ", ".join(fields)
            raise self._wrong(node, f"{_shape(node)} where a mapping should be", f"keys: {keys}")
        found: dict[str, Any] = {}
        bad = False
        for name, (key, value) in node.entries.items():
            field = fields.get(name)
            if field is None:
                bad = True
                cure = _belongs_below(node, name, fields) or nearest(name, list(fields))
                self._problems.add(key, f"unknown key {name!r}", cure)
                continue
            self._key = name
            self._words = info.cls.words(name, node) if issubclass(info.cls, Record) else None
            try:
                found[field.name] = self._value(value, field.type)
            except Mistake:
                bad = True
        for name, field in fields.items():
            if field.required and name not in node.entries:
                bad = True
                self._problems.add(node, f"the key {name!r} is missing", "add it")
        if bad:
            raise Mistake
        return info.cls(**found)

    def _list(self, node: Node, info: types.VarTupleType | types.ListType) -> Any:
        if node.kind != "list":
            raise self._wrong(node, f"{_shape(node)} where a list should be", "begin it with -")
        if len(node.items) < (info.min_length or 0):
            raise self._wrong(node, f"a list of at least {info.min_length} should be here")
        values: list[Any] = []
        bad = False
        for item in node.items:
            try:
                values.append(self._value(item, info.item_type))
            except Mistake:
                bad = True
        if bad:
            raise Mistake
        return tuple(values)

    def _dict(self, node: Node, info: types.DictType) -> Any:
        if node.kind != "map":
            raise self._wrong(node, f"{_shape(node)} where a mapping should be")
        values: dict[str, Any] = {}
        bad = False
        for name, (_, value) in node.entries.items():
            try:
                values[name] = self._value(value, info.value_type)
            except Mistake:
                bad = True
        if bad:
            raise Mistake
        return values

    def _scalar(self, node: Node, info: types.Type) -> Any:
        value = node.value if node.kind == "text" else None
        match info:
            case types.StrType() if node.kind == "text" and value is not None:
                return self._text(node, info)
            case types.BoolType() if isinstance(value, bool):
                return value
            case types.IntType() if isinstance(value, int) and not isinstance(value, bool):
                return self._bounded(node, value, info)
            case types.FloatType() if isinstance(value, int | float) and not isinstance(
                value, bool
            ):
                return self._bounded(node, float(value), info)
            case types.LiteralType():
                valid = [str(v) for v in info.values if self._words is None or v in self._words]
                if node.text in valid:
                    return node.text
                if not valid:
                    text = f"{self._key}: {_shape(node)} means nothing here"
                    raise self._wrong(node, text, "leave it out")
                text = f"{self._key}: {_shape(node)} is none of the words that may stand here"
                raise self._wrong(node, text, nearest(node.text, valid))
            case _:
                text = f"{self._key}: {_shape(node)} where {in_words(info)} should be"
                raise self._wrong(node, text)

    def _text(self, node: Node, info: types.StrType) -> str:
        text = node.text
        if "\n" in text:  # of several lines, one might be read as a line of ours
            text = " ".join(text.split())
        if not text.strip() or len(text) < (info.min_length or 0):
            raise self._wrong(node, "an empty text")
        if info.max_length is not None and len(text) > info.max_length:
            raise self._wrong(node, f"a text of more than {info.max_length} characters")
        if info.pattern is not None and not re.search(info.pattern, text):
            cure = "lower case letters, digits and _, a letter first"
            raise self._wrong(node, f"{text!r} is no name", cure)
        return text

    def _bounded(self, node: Node, value: float, info: types.IntType | types.FloatType) -> float:
        fits = (
            -BEYOND < value < BEYOND
            and (info.gt is None or value > info.gt)
            and (info.ge is None or value >= info.ge)
            and (info.le is None or value <= info.le)
            and (info.lt is None or value < info.lt)
        )
        if not fits:
            words = in_words(info)
            limits = "" if words != in_words(type(info)()) else f" of less than {BEYOND:,.0f}"
            text = f"{self._key}: {_shape(node)} where {words}{limits} should be"
            raise self._wrong(node, text)
        return value

    def _wrong(self, node: Node, message: str, cure: str = "") -> Mistake:
        self._problems.add(node, message, cure)
        return Mistake()


_SCALARS: dict[type, tuple[type[types.Type], ...]] = {
    bool: (types.BoolType,),
    int: (types.IntType, types.FloatType, types.StrType),
    float: (types.FloatType, types.StrType),
}


@cache
def _info(kind: type[Record]) -> types.StructType:
    info = msgspec.inspect.type_info(kind)
    assert isinstance(info, types.StructType)
    return info


def _fields(info: types.StructType) -> dict[str, types.Field]:
    known = _FIELDS.get(id(info))
    if known is None:
        known = _FIELDS[id(info)] = {field.encode_name: field for field in info.fields}
    return known


_FIELDS: dict[int, dict[str, types.Field]] = {}


def _members(info: types.UnionType) -> list[types.Type]:
    """The members of a union, of unions inside it too, without the empty one."""
    known = _MEMBERS.get(id(info))
    if known is None:
        known = _MEMBERS[id(info)] = []
        for member in info.types:
            bare = member.type if isinstance(member, types.Metadata) else member
            if isinstance(bare, types.UnionType):
                known += _members(bare)
            elif not isinstance(bare, types.NoneType) and not _is_parameter(bare):
                known.append(bare)
    return known


def _belongs_below(node: Node, name: str, fields: dict[str, types.Field]) -> str:
    """The cure for a key that was not indented far enough; empty if it was not that."""
    for key, (_, value) in node.entries.items():
        if key not in fields or value.kind != "text" or value.value is not None:
            continue
        info = fields[key].type
        kinds = _members(info) if isinstance(info, types.UnionType) else [info]
        if any(isinstance(kind, types.StructType) and name in _fields(kind) for kind in kinds):
            return f"indent it further: it belongs below {key!r}"
    return ""


def _is_parameter(info: types.Type) -> bool:
    """Whether it stands for a parameter; those are filled in by now."""
    return isinstance(info, types.StrType) and (info.pattern or "").startswith(r"^\{\{")


_MEMBERS: dict[int, list[types.Type]] = {}
"""By the identity of the union; the types of records live as long as the program."""


def _shape(node: Node) -> str:
    """What stands there, for people."""
    if node.kind != "text":
        return "a list" if node.kind == "list" else "a mapping"
    if node.value is None:
        return "nothing"
    if node.plain and not isinstance(node.value, str) and len(node.text) <= 40:
        return node.text
    return repr(node.text if len(node.text) <= 40 else node.text[:37] + "...")

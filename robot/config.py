"""YAML files read into frozen types; mistakes are named by file, line and nearest valid name."""

from __future__ import annotations

import difflib
import re
from pathlib import Path
from types import UnionType
from typing import Any, TypeVar, Union, cast, get_args, get_origin

import msgspec
from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import MarkedYAMLError

from robot.errors import ConfigError, Problem

T = TypeVar("T")
MAX_BYTES = 1_000_000
MAX_DEPTH = 40


def load(path: Path | str, kind: type[T]) -> T:
    """Read a YAML file into a msgspec type.

    Raises:
        ConfigError: with every unknown key, or the first wrong type, each with file and line.
    """
    node = read_yaml(path)
    return convert(node, kind, file=str(path))


def read_yaml(path: Path | str) -> Any:
    """Read a YAML file, keeping the line of every key (ruamel's round-trip nodes).

    Raises:
        ConfigError: if it is missing, too large, too deep, not YAML, or uses aliases.
    """
    path = Path(path)
    try:
        if path.stat().st_size > MAX_BYTES:
            raise _error(path, None, f"the file is larger than {MAX_BYTES} bytes")
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise _error(path, None, "there is no such file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise _error(path, None, f"cannot be read: {error}") from None
    if re.search(r"(?m)^[^#'\"]*[:\-]\s+\*\w+", text):
        raise _error(path, None, "YAML aliases (*name) are not allowed")
    try:
        node = cast(Any, YAML(typ="rt")).load(text)
    except MarkedYAMLError as error:
        mark = cast(Any, error).problem_mark
        problem = cast(Any, error).problem
        line = None if mark is None else int(mark.line) + 1
        raise _error(path, line, f"not valid YAML: {problem}") from None
    except RecursionError:
        raise _error(path, None, f"nested deeper than {MAX_DEPTH} levels") from None
    if node is None:
        raise _error(path, None, "the file is empty")
    _check_depth(node, path)
    return node


def convert(node: Any, kind: type[T], *, file: str) -> T:
    """Turn a round-trip YAML node into a msgspec type; raises ConfigError naming line and key."""
    problems: list[Problem] = []
    _find_unknown(node, kind, file, problems)
    if problems:
        raise ConfigError(problems)
    try:
        return msgspec.convert(plain(node), kind)
    except msgspec.ValidationError as error:
        message, _, where = str(error).partition(" - at `")
        where = where.rstrip("`")
        place = f" at {where.removeprefix('$.')}" if where else ""
        line = line_of(node, where)
        raise ConfigError([Problem(message + place, file=file, line=line)]) from None


def plain(node: Any) -> Any:
    """The same data as ordinary dicts, lists and scalars."""
    if isinstance(node, dict):
        items = cast("dict[Any, Any]", node).items()
        return {str(key): plain(value) for key, value in items}
    if isinstance(node, list):
        return [plain(value) for value in cast("list[Any]", node)]
    if isinstance(node, bool) or node is None:
        return node
    for scalar in (int, float, str):
        if isinstance(node, scalar):
            return scalar(node)
    return node


def line_of(node: Any, where: str) -> int | None:
    """Line (from 1) of a msgspec path such as `$.rooms[0].name` in a round-trip node."""
    line: int | None = None
    for key, index in re.findall(r"\.([\w-]+)|\[(\d+)\]", where.removeprefix("$")):
        try:
            if isinstance(node, CommentedMap):
                line = int(node.lc.key(key)[0]) + 1  # pyright: ignore
                node = cast(Any, node[key])
            elif isinstance(node, CommentedSeq):
                line = int(node.lc.item(int(index))[0]) + 1  # pyright: ignore
                node = cast(Any, node[int(index)])
        except (KeyError, IndexError, ValueError):
            break
    if line is None and isinstance(node, CommentedMap | CommentedSeq):
        line = int(node.lc.line) + 1  # pyright: ignore
    return line


def nearest(name: str, valid: list[str]) -> str:
    """`did you mean 'x'?`, or the list of what is valid."""
    close = difflib.get_close_matches(name, valid, n=1, cutoff=0.5)
    if close:
        return f"did you mean {close[0]!r}?"
    return "valid: " + ", ".join(sorted(valid)[:12])


def _error(path: Path, line: int | None, message: str) -> ConfigError:
    return ConfigError([Problem(message, file=str(path), line=line)])


def _check_depth(node: Any, path: Path) -> None:
    stack: list[tuple[Any, int]] = [(node, 0)]
    while stack:
        value, depth = stack.pop()
        if depth > MAX_DEPTH:
            raise _error(path, None, f"nested deeper than {MAX_DEPTH} levels")
        if isinstance(value, dict):
            stack += [(child, depth + 1) for child in cast("dict[Any, Any]", value).values()]
        elif isinstance(value, list):
            stack += [(child, depth + 1) for child in cast("list[Any]", value)]


def _find_unknown(node: Any, kind: Any, file: str, problems: list[Problem]) -> None:
    """Collect every key that its struct does not have."""
    if isinstance(node, dict):
        fields = _fields_of(kind)
        value_kind = _value_kind(kind)
        for key, value in cast("dict[Any, Any]", node).items():
            if fields is not None and str(key) not in fields:
                line = None
                if isinstance(node, CommentedMap):
                    line = int(node.lc.key(key)[0]) + 1  # pyright: ignore
                hint = nearest(str(key), list(fields))
                problems.append(Problem(f"unknown key {str(key)!r}", file, line, suggestion=hint))
                continue
            _find_unknown(value, fields[str(key)] if fields else value_kind, file, problems)
    elif isinstance(node, list):
        for value in cast("list[Any]", node):
            _find_unknown(value, _item_kind(kind), file, problems)


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

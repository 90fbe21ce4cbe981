"""YAML text as nodes that know where they stand; what explodes or deceives is refused at once.

Every YAML file is read here: `robot.files.config` makes typed values of the nodes, and a mission's
reader walks over them.

The events of libyaml are read one by one, so that size, depth, anchors, tags and doubled keys are
judged before anything is built of them.
"""

from __future__ import annotations

import errno
import math
import os
import re
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any, Literal, cast

import yaml

from robot.errors import ConfigError, Problem
from robot.files import misfits, yaml_words
from robot.files.ordinary_files import read_ordinary
from robot.printable import is_printable, printable

MAX_BYTES = 2_000_000
MOST_BESIDE = 1000
"""Names in a folder that are looked at for one that was meant."""
MAX_DEPTH = 60
MAX_NODES = 150_000
MAX_TEXT = 10_000
"""Characters of one text or key: more is no name and no sentence, and every message repeats it."""
MOST_DIRECTIVES = 10
"""libyaml compares each with all before it."""

TAG_PREFIX = "tag:yaml.org,2002:"
"""What `!!` in a file stands for."""

Kind = Literal["text", "list", "map"]
Scalar = str | int | float | bool | None

_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ufffe\uffff]")
_DIRECTIVE = re.compile(r"(?:^|[\r\n\x85\u2028\u2029])%")
_INTEGER = re.compile(r"[-+]?[0-9]{1,18}")
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]{1,3})?")
_WORDS: dict[str, Scalar] = {
    "": None, "~": None, "null": None, "Null": None, "true": True, "True": True, "false": False,
    "False": False,
}  # fmt: skip


_NO_ITEMS: list[Any] = []
_NO_ENTRIES: dict[str, Any] = {}


class Node:
    """A piece of a file: a text, a list or a mapping, and where it begins (from 1)."""

    __slots__ = ("column", "entries", "file", "items", "kind", "line", "plain", "text")

    def __init__(self, kind: Kind, file: str, line: int, column: int) -> None:
        """Begin an empty one."""
        self.kind: Kind = kind
        self.file = file
        self.line = line
        self.column = column
        self.text = ""
        self.plain = False
        self.items: list[Node] = [] if kind == "list" else _NO_ITEMS
        self.entries: dict[str, tuple[Node, Node]] = {} if kind == "map" else _NO_ENTRIES

    @property
    def value(self) -> Scalar:
        """A text without quotes as what YAML takes it for: a number, true, nothing, a text."""
        return resolve(self.text) if self.plain else self.text

    def get(self, key: str) -> Node | None:
        """The value of a key of a mapping."""
        entry = self.entries.get(key)
        return entry[1] if entry else None

    def key(self, key: str) -> Node:
        """Where a key of a mapping stands; the mapping itself if it has none of that name."""
        entry = self.entries.get(key)
        return entry[0] if entry else self

    def problem(self, message: str, cure: str = "") -> Problem:
        """Something wrong here."""
        return Problem(message, self.file, self.line, self.column, cure or None)

    @property
    def plain_data(self) -> Any:
        """The same as ordinary dicts, lists and scalars."""
        if self.kind == "text":
            return self.value
        if self.kind == "list":
            return [item.plain_data for item in self.items]
        return {key: value.plain_data for key, (_, value) in self.entries.items()}


def resolve(text: str) -> Scalar:
    """What a text without quotes means (YAML 1.2's core schema, decimal numbers only)."""
    if text in _WORDS:
        return _WORDS[text]
    if text[0] not in "0123456789+-.":
        return text
    if _INTEGER.fullmatch(text):
        return int(text)
    if not _NUMBER.fullmatch(text):
        return text
    found = float(text)
    return found if math.isfinite(found) else text  # 1e999, or hundreds of digits: no number


def text_node(text: str, like: Node, *, plain: bool = False) -> Node:
    """A text in the place of another node."""
    node = Node("text", like.file, like.line, like.column)
    node.text, node.plain = text, plain
    return node


def of_data(data: object, like: Node) -> Node:
    """Plain data (dicts, lists, scalars) in the place of another node."""
    if isinstance(data, list):
        made = Node("list", like.file, like.line, like.column)
        made.items = [of_data(item, like) for item in cast("list[object]", data)]
        return made
    if isinstance(data, dict):
        made = Node("map", like.file, like.line, like.column)
        entries = cast("dict[str, object]", data).items()
        made.entries = {key: (text_node(key, like), of_data(one, like)) for key, one in entries}
        return made
    return text_node("" if data is None else str(data), like, plain=not isinstance(data, str))


def _beside(path: Path) -> str:
    """A cure for a file that is not there: one beside it that is called nearly so."""
    try:
        names = [entry.name for entry in islice(os.scandir(path.parent), MOST_BESIDE)]
    except OSError:
        return "check the path"
    near = misfits.closest(path.name, [name for name in names if is_printable(name)])
    return f"did you mean {str(path.with_name(near))!r}?" if near else "check the path"


def read_text(path: Path | str, *, limit: int = MAX_BYTES) -> str:
    """A text file, if it can be meant to be one.

    Raises:
        ConfigError: it is missing, no file, too large, or no UTF-8 text.
    """
    path = Path(path)
    try:
        data = read_ordinary(path, limit=limit)
    except FileNotFoundError:
        raise _refusal(path, "there is no such file", _beside(path)) from None
    except OSError as error:
        cure = "split it up" if error.errno == errno.EFBIG else "name a file"
        raise _refusal(path, f"cannot be read: {error.strerror}", cure) from None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        column = error.start - (data.rfind(b"\n", 0, error.start) + 1) + 1
        text = f"this is no UTF-8 text (byte {data[error.start]:#04x})"
        raise _refusal(path, text, "save it as UTF-8", line=line, column=column) from None


def read(path: Path | str, *, begin_with: str = "") -> Node:
    """The one document of a YAML file; raises ConfigError as `read_text` and `parse` do."""
    return parse(read_text(path), str(path), begin_with=begin_with)


def dump(data: Any) -> str:
    """Plain data as YAML text, written out in full, keys in their order.

    Raises:
        ConfigError: it is too deep to be read again.
    """
    inside = [data]
    for _ in range(MAX_DEPTH + 1):
        inside = [part for whole in inside for part in _parts(whole)]
    if inside:
        raise ConfigError([Problem(f"nested deeper than {MAX_DEPTH} levels")])
    return yaml.dump(data, Dumper=_Plain, sort_keys=False, allow_unicode=True, width=100)


def _parts(data: Any) -> Iterable[Any]:
    if isinstance(data, dict):
        return cast("dict[str, Any]", data).values()
    return cast("list[Any]", data) if isinstance(data, list | tuple) else ()


class _Plain(yaml.SafeDumper):
    """Writes everything out: no anchors."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002, by PyYAML's contract
        """Nothing is shared."""
        return True


def parse(text: str, file: str, *, begin_with: str = "") -> Node:
    """The one document of a YAML text.

    Args:
        text: all of it.
        file: its name, for people.
        begin_with: what somebody with an empty file is told.

    Raises:
        ConfigError: it is empty, no YAML, too deep, too large, or uses anchors, tags, double keys.
    """
    try:
        if len(_DIRECTIVE.findall(text)) > MOST_DIRECTIVES:
            said = f"more than {MOST_DIRECTIVES} lines begin with %, as directives do"
            raise _refusal(file, said, "leave them out")
        root = _Builder(file).build(_events(text))
    except yaml.MarkedYAMLError as error:
        message, cure, line, column = yaml_words.told(error, text)
        raise _refusal(file, f"not valid YAML: {message}", cure, line=line, column=column) from None
    except yaml.YAMLError:  # libyaml's reader, which stops at the first of them
        bad = _CONTROL.search(text)
        line = text.count("\n", 0, bad.start()) + 1 if bad else None
        what = (
            f"a control character stands in it ({ord(bad[0]):#04x})" if bad else "unknown letters"
        )
        cure = "save it as plain text"
        raise _refusal(file, f"not a text file: {what}", cure, line=line) from None
    if root is None:
        raise _refusal(file, "the file is empty", begin_with and f"begin with: {begin_with}")
    return root


def _events(text: str) -> Iterator[Any]:
    return cast("Any", yaml).parse(text, Loader=_LOADER)


class _Builder:
    """Makes nodes of events."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._root: Node | None = None
        self._stack: list[Node] = []
        self._keys: list[Node | None] = []
        self._count = 0

    def build(self, events: Iterator[Any]) -> Node | None:
        """The root of the one document; None if there is nothing in it."""
        for event in events:
            kind = cast("Any", type(event))
            if kind is yaml.ScalarEvent:
                node = self._begin("text", event)
                node.text = event.value
                node.plain = not event.style
                if not is_printable(node.text):
                    text = f"a text holds what cannot be printed: {printable(node.text)[:60]}"
                    self._refuse(event, text, "leave it out")
                if len(node.text) > MAX_TEXT:
                    text = f"a text of {len(node.text)} characters, at most {MAX_TEXT} are taken"
                    self._refuse(event, text, "shorten it, or check the quotes")
                self._put(node)
            elif kind is yaml.MappingStartEvent or kind is yaml.SequenceStartEvent:
                self._open(event, "map" if kind is yaml.MappingStartEvent else "list")
            elif kind is yaml.MappingEndEvent or kind is yaml.SequenceEndEvent:
                self._stack.pop()
                self._keys.pop()
            elif kind is yaml.AliasEvent:
                self._refuse(event, "aliases (*name) are not allowed", "write it out")
            elif kind is yaml.DocumentStartEvent and self._root is not None:
                self._refuse(event, "a second document begins here", "one document a file")
        if self._root is None or (self._root.kind == "text" and self._root.value is None):
            return None
        return self._root

    def _begin(self, kind: Kind, event: Any) -> Node:
        mark = event.start_mark
        self._count += 1
        if event.anchor is not None:
            self._refuse(event, "anchors (&name) are not allowed", "write it out")
        if event.tag is not None and event.tag != "!":
            tag = event.tag.replace(TAG_PREFIX, "!!", 1)
            self._refuse(event, f"tags ({tag}) are not allowed", "leave it out")
        if self._count > MAX_NODES:
            self._refuse(event, f"more than {MAX_NODES} values", "split it up")
        return Node(kind, self._file, mark.line + 1, mark.column + 1)

    def _open(self, event: Any, kind: Kind) -> None:
        node = self._begin(kind, event)
        if len(self._stack) >= MAX_DEPTH:
            self._refuse(event, f"nested deeper than {MAX_DEPTH} levels", "make it flatter")
        self._put(node)
        self._stack.append(node)
        self._keys.append(None)

    def _put(self, node: Node) -> None:
        """Put a node where it belongs: into a list, as a key, or as the value of a key."""
        if not self._stack:
            self._root = node
            return
        parent = self._stack[-1]
        if parent.kind == "list":
            parent.items.append(node)
            return
        key = self._keys[-1]
        if key is None:
            self._check_key(parent, node)
            self._keys[-1] = node
            return
        parent.entries[key.text] = (key, node)
        self._keys[-1] = None

    def _check_key(self, parent: Node, key: Node) -> None:
        if key.kind != "text":
            cure = 'a parameter stands in quotes: "{{name}}"' if key.kind == "map" else ""
            raise ConfigError([key.problem("a key must be a text", cure or "put it into quotes")])
        if key.text in parent.entries:
            line = parent.entries[key.text][0].line
            text = f"the key {key.text!r} stands here twice"
            raise ConfigError([key.problem(text, f"see line {line}")])

    def _refuse(self, event: Any, message: str, cure: str) -> None:
        mark = event.start_mark
        raise _refusal(self._file, message, cure, line=mark.line + 1, column=mark.column + 1)


def _refusal(
    path: Path | str,
    message: str,
    cure: str,
    *,
    line: int | None = None,
    column: int | None = None,
) -> ConfigError:
    return ConfigError([Problem(message, str(path), line, column, cure or None)])

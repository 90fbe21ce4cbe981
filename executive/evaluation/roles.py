"""Roles of a campaign: `{thing}`, `{goal}`: what its cases name without saying which it is.

A file says under `roles` what plays them where its cases are at home; another home brings a cast
of its own (`robot.reality.contract.Cast`). Alone in a text a role is its value; within a text it is
the words for it: `pick up the {thing}` is "pick up the red cup", `target: "{thing}"` is `red_cup`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, cast

from robot.errors import ConfigError
from robot.files.config import nearest
from robot.files.yaml_nodes import MAX_BYTES, MAX_NODES, MAX_TEXT, Node, of_data, text_node

_ROLE = re.compile(r"\{([a-z]\w*)\}")


def of(node: Node) -> Mapping[str, Any]:
    """The roles that a campaign's file fills itself."""
    roles = node.get("roles")
    return roles.plain_data if roles is not None and roles.kind == "map" else {}


def used(node: Node) -> list[str]:
    """The roles that a piece of a file names, each once, in the order of writing."""
    return list(dict.fromkeys(role for text in _texts(node) for role in _ROLE.findall(text.text)))


def filled(node: Node, roles: Mapping[str, Any]) -> Node:
    """A piece of a file with its roles played; every part stays where it stands in the file.

    Raises:
        ConfigError: a role is named that nobody plays, with the nearest that somebody does; or more
            comes of it than a file may hold.
    """
    if not roles:
        return node
    problems = [
        text.problem(f"nobody plays the role {role!r}", nearest(role, list(roles)))
        for text in _texts(node)
        for role in _ROLE.findall(text.text)
        if role not in roles
    ]
    if problems:
        raise ConfigError(problems)
    return _Stage(roles).filled(node)


def _texts(node: Node) -> list[Node]:
    inner = [*node.items, *(value for _, value in node.entries.values())]
    return [node] if node.kind == "text" else [text for one in inner for text in _texts(one)]


class _Stage:
    """Plays roles, and counts what comes of it: no more than one file may hold in so many words.

    A role may be a list of thousands, and be named thousands of times.
    """

    def __init__(self, roles: Mapping[str, Any]) -> None:
        self._roles = roles
        self._sizes: dict[str, int] = {}
        self._words: dict[str, str] = {}
        self._values = 0
        self._characters = 0

    def filled(self, node: Node) -> Node:
        if node.kind == "text":
            alone = _ROLE.fullmatch(node.text)
            return self._played(alone[1], node) if alone else self._told(node)
        self._count(node, values=1)
        made = Node(node.kind, node.file, node.line, node.column)
        made.items = [self.filled(item) for item in node.items]
        made.entries = {key: (k, self.filled(value)) for key, (k, value) in node.entries.items()}
        return made

    def _played(self, role: str, node: Node) -> Node:
        if role not in self._sizes:
            self._sizes[role] = _size(self._roles[role])
        self._count(node, values=self._sizes[role], characters=len(self._words_for(role)))
        return of_data(self._roles[role], node)

    def _told(self, node: Node) -> Node:
        named = _ROLE.findall(node.text)
        characters = len(node.text) + sum(len(self._words_for(role)) for role in named)
        if named and characters > MAX_TEXT:
            text = f"a text of {characters} characters with its roles, at most {MAX_TEXT} are taken"
            raise ConfigError([node.problem(text, "make it shorter")])
        self._count(node, values=1, characters=characters)
        words = _ROLE.sub(lambda found: self._words_for(found[1]), node.text)
        return text_node(words, node, plain=node.plain)

    def _words_for(self, role: str) -> str:
        if role not in self._words:
            self._words[role] = str(self._roles[role]).replace("_", " ")
        return self._words[role]

    def _count(self, node: Node, *, values: int, characters: int = 0) -> None:
        self._values += values
        self._characters += characters
        if self._values > MAX_NODES or self._characters > MAX_BYTES:
            text = (
                f"with its roles the file has more than {MAX_NODES} values or {MAX_BYTES} letters"
            )
            raise ConfigError([node.problem(text, "split it up")])


def _size(data: object) -> int:
    """How many values plain data are, the lists and mappings in it included."""
    if isinstance(data, dict):
        return 1 + sum(map(_size, cast("dict[str, object]", data).values()))
    return 1 + sum(map(_size, cast("list[object]", data))) if isinstance(data, list) else 1

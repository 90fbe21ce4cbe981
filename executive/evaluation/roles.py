"""Roles of a campaign: `{thing}`, `{goal}`: what its cases name without saying which it is.

A file says under `roles` what plays them where its cases are at home; another home brings a cast
of its own (`robot.reality.contract.Cast`). Alone in a text a role is its value; within a text it is
the words for it: `pick up the {thing}` is "pick up the red cup", `target: "{thing}"` is `red_cup`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from robot.config import nearest
from robot.errors import ConfigError
from robot.yaml_nodes import Node, of_data, text_node

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
        ConfigError: a role is named that nobody plays, with the nearest that somebody does.
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
    return _filled(node, roles)


def _texts(node: Node) -> list[Node]:
    inner = [*node.items, *(value for _, value in node.entries.values())]
    return [node] if node.kind == "text" else [text for one in inner for text in _texts(one)]


def _filled(node: Node, roles: Mapping[str, Any]) -> Node:
    if node.kind == "text":
        alone = _ROLE.fullmatch(node.text)
        if alone:
            return of_data(roles[alone[1]], node)
        words = _ROLE.sub(lambda found: str(roles[found[1]]).replace("_", " "), node.text)
        return text_node(words, node, plain=node.plain)
    made = Node(node.kind, node.file, node.line, node.column)
    made.items = [_filled(item, roles) for item in node.items]
    made.entries = {key: (k, _filled(value, roles)) for key, (k, value) in node.entries.items()}
    return made

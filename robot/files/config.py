"""YAML files read into frozen types; mistakes are named by place and nearest valid name."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path
from typing import TypeVar

import msgspec

from robot.errors import ConfigError, Problem
from robot.files import misfits, yaml_nodes
from robot.files.misfits import nearest
from robot.files.yaml_nodes import Node

__all__ = ["convert", "load", "nearest", "place"]

T = TypeVar("T")

MOST_PROBLEMS = 30
"""More would scroll the first of them away; a file that is all wrong is not this kind of file."""


def load(path: Path | str, kind: type[T]) -> T:
    """Read a YAML file into a msgspec type.

    Raises:
        ConfigError: with what is wrong, each with its place: keys, types, ranges.
    """
    return convert(yaml_nodes.read(path), kind)


def names_file(text: str) -> bool:
    """Whether a text names a file rather than what is shipped: by its suffix, as paths have it.

    `a.yaml/` and `a.yaml/.` do, too: they are opened like any other.
    """
    return Path(text).suffix in (".yaml", ".yml")


def convert(node: Node, kind: type[T]) -> T:
    """Turn a node into a msgspec type; raises ConfigError as `load` does."""
    data = node.plain_data
    found = islice(misfits.misfits(data, kind), MOST_PROBLEMS + 1)
    problems = [_problem(node, misfit) for misfit in found]
    if len(problems) > MOST_PROBLEMS:
        problems[-1] = Problem("and more that does not fit", node.file)
    if problems:
        raise ConfigError(problems)
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        message, _, where = str(error).partition(" - at `")
        where = where.rstrip("`")
        said = f" at {where.removeprefix('$.')}" if where else ""
        raise ConfigError([place(node, where).problem(message + said)]) from None


def _problem(node: Node, misfit: misfits.Misfit) -> Problem:
    """A misfit at its key, or at the item of a list."""
    found = node
    for part in misfit.path:
        if isinstance(part, int):
            found = node = node.items[part]
        else:
            found, node = node.entries[part]
    return found.problem(misfit.message, misfit.cure)


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

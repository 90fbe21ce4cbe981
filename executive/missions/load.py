"""A mission file to its record: what is said once, before the steps are looked at."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

from executive.missions.problems import Problems
from executive.missions.reading import Reader
from executive.missions.schema import MissionRecord, ParameterRecord
from robot.errors import ConfigError, Problem
from robot.files import config
from robot.files.yaml_nodes import Node, parse, read_text, text_node

SUFFIX = ".yaml"
_PACKED, _BESIDE = Path(__file__).with_name("samples"), Path(__file__).parents[2] / "missions"
FOLDER = _PACKED if _PACKED.is_dir() else _BESIDE
"""The shipped missions: inside the package once installed, at the top of the sources before."""


class Mission(msgspec.Struct, frozen=True, kw_only=True, eq=False):
    """A mission file that was read: its record, and its nodes for the places of what is wrong.

    `declared` are the names of all its parameters, those that cannot be read as well.
    """

    path: Path
    record: MissionRecord
    node: Node
    declared: frozenset[str] = frozenset()

    def beside(self, name: str) -> str:
        """A name of a file beside this one as a path, other names as they are."""
        if not config.names_file(name):
            return name
        return str(self.path.parent / name)


def find(name: str) -> Path:
    """The file of a mission: a path, or the name of a shipped one."""
    path = Path(name)
    # Unlike `Path.exists` this raises nothing where a folder on the way may not be entered.
    if path.suffix or os.access(path, os.F_OK):
        return path
    return next((one for one in shipped() if one.stem == name), path)


def _check_shipped(path: Path) -> None:
    """Say of a file that is not here that a shipped mission is called like it, if one is.

    Raises:
        ConfigError: so it is.
    """
    shipped_one = any(one.name == path.name for one in shipped())
    if str(path) == path.name and shipped_one and not os.path.lexists(path):
        cure = f"the one that comes along is called {path.stem!r}, without {SUFFIX}"
        raise ConfigError([Problem("there is no such file here", str(path), suggestion=cure)])


def shipped() -> list[Path]:
    """The shipped missions."""
    return sorted(FOLDER.glob(f"*{SUFFIX}"))


def load(path: Path, problems: Problems, *, text: str | None = None) -> Mission | None:
    """Read a mission file; None if nothing can be made of it, which is noted.

    Args:
        path: of the file.
        problems: takes what is wrong.
        text: what stands in it, where that is known.

    Raises:
        ConfigError: it cannot be read at all.
    """
    if text is None:
        _check_shipped(path)
        text = read_text(path)
    node = parse(text, str(path), begin_with="humanoid mission new NAME")
    if node.kind != "map":
        problems.add(node, "a mission is a mapping", "begin with: name: ...")
        return None
    record = Reader(problems, _as_it_is).record(node, MissionRecord)
    parameters = node.get("parameters")
    declared = frozenset(parameters.entries) if parameters is not None else frozenset[str]()
    if record is None:
        node = _sound(node)
        record = Reader(Problems(), _as_it_is).record(node, MissionRecord)
    if record is None:
        return None
    return Mission(path=path, record=record, node=node, declared=declared)


def _as_it_is(node: Node) -> Node:
    return node


def _sound(node: Node) -> Node:
    """What can be read of it, so that the steps are looked at all the same."""
    reader = Reader(Problems(), _as_it_is)
    sound = reader.readable(node, MissionRecord)
    if "parameters" in node.entries and "parameters" not in sound.entries:
        key, parameters = node.entries["parameters"]
        if parameters.kind != "map":  # nobody knows what it declares
            return Node("map", node.file, node.line, node.column)
        kept = Node("map", node.file, parameters.line, parameters.column)
        kept.entries = {
            name: entry
            for name, entry in parameters.entries.items()
            if reader.record(entry[1], ParameterRecord) is not None
        }
        sound.entries["parameters"] = (key, kept)
    sound.entries.setdefault("name", (node, text_node("mission", node)))
    return sound

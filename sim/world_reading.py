"""A world file with everything that is wrong in it at once, and nothing that only follows from it.

Types and ranges are checked first, then words, then geometry. Where one entry is wrong, the others
are looked at all the same: its mistaken values are left out, or something plain stands in for them,
and what depends on them is not judged.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from robot.errors import ConfigError, Problem
from robot.files import config, misfits, yaml_nodes
from robot.files.yaml_nodes import Node, of_data, text_node
from sim import world_checks, world_kinds
from sim.world_checks import Finding
from sim.world_schema import World

ROUNDS = 4
"""Leaving out a value may show that it has to be there, and a stand-in that it has another type."""
STAND_INS: Mapping[str, Mapping[str, Any]] = {
    "rooms": {"at_m": [0, 0], "size_m": [1, 1]},
    "spots": {"at_m": [0, 0]},
    "furniture": {"kind": "table", "at_m": [0, 0]},
    "objects": {"color": "gray", "shape": "box", "size_m": [0.1, 0.1, 0.1], "mass_kg": 1},
    "people": {"at_m": [0, 0]},
}
"""Values that an entry must have, and that no other goes by."""

WORDS = ("id", "name", "synonyms", "color", "floor", "category", "mass_kg", "behaviour")
"""Keys of an entry that say nothing of where it is, and how large."""


def read(path: Path) -> World:
    """Read a world file.

    Raises:
        ConfigError: with everything that is wrong, by file and line, and the nearest valid name.
    """
    node = yaml_nodes.read(path)
    unlike = world_kinds.complete(node)
    try:
        world, problems = config.convert(node, World), unlike
    except ConfigError as error:
        world, problems = None, [*unlike, *error.problems]
    mended = _Mended(node)
    if mended.is_sound():
        problems = [*problems, *_deeper(mended)]
    if problems:
        ordered = sorted(problems, key=lambda one: (one.line or 0, one.column or 0))
        raise ConfigError(ordered[: config.MOST_PROBLEMS + 1])
    assert world is not None
    return world


def _deeper(mended: _Mended) -> list[Problem]:
    """What is wrong with words and geometry."""
    world = config.convert(mended.node, World)
    named = world_checks.names(world, unsure=mended.ids)
    problems = [_problem(mended.node, finding) for finding in named]
    for finding in named:
        mended.note(finding.where)
    if mended.ids is None:
        return problems
    rest = mended.without_noted()
    fitting = world_checks.geometry(config.convert(rest, World), whole=mended.rooms_are_whole)
    told = (f for f in fitting if mended.start_is_known or not f.where.startswith("$.start"))
    return problems + [_problem(rest, finding) for finding in told]


def _in_order(path: misfits.Path) -> tuple[tuple[str, int], ...]:
    """Paths of one list in the order of its entries: the tenth after the ninth."""
    return tuple(("", step) if isinstance(step, int) else (step, 0) for step in path)


def _problem(node: Node, finding: Finding) -> Problem:
    return config.place(node, finding.where).problem(finding.message, finding.suggestion)


class _Mended:
    """A file without the values that are no values, and which entries had some.

    Attributes:
        node: of the file.
        ids: of entries with mistakes; None: nobody knows all of them.
    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self.ids: set[str] | None = set()
        self.rooms_are_whole = True
        self.start_is_known = True
        self._noted: list[Node] = []

    def is_sound(self) -> bool:
        """Mend it; returns whether anything can be made of it."""
        for _ in range(ROUNDS):
            found = list(misfits.misfits(self.node.plain_data, World))
            if not found:
                return True
            paths = list(dict.fromkeys(misfit.path for misfit in found))
            for path in sorted(paths, key=_in_order, reverse=True):  # the last of a list first
                if not path:
                    if self.node.kind != "map" or "rooms" not in self.node.entries:
                        return False
                    key = text_node("name", self.node)
                    self.node.entries.setdefault("name", (key, text_node("world", self.node)))
                else:
                    self._mend(path)
        return False

    def note(self, where: str) -> None:
        """Note the entry at a place such as `$.objects[2].on`; geometry does without it."""
        group, _, rest = where.removeprefix("$.").partition("[")
        index, _, key = rest.partition("].")
        items = self.node.entries[group][1].items if group in self.node.entries else []
        if index.isdigit() and int(index) < len(items):
            self._note(group, items[int(index)], key)

    def without_noted(self) -> Node:
        """The same without the entries that were noted."""
        rest = Node("map", self.node.file, self.node.line, self.node.column)
        for name, (key, value) in self.node.entries.items():
            if value.kind == "list":
                kept = Node("list", value.file, value.line, value.column)
                kept.items = [i for i in value.items if not any(i is n for n in self._noted)]
                rest.entries[name] = (key, kept)
            else:
                rest.entries[name] = (key, value)
        return rest

    def _note(self, group: str, entry: Node, key: str) -> None:
        if key not in WORDS:
            self._noted.append(entry)
            self.rooms_are_whole &= group != "rooms"
        name = entry.get("id")
        if name is None or name.kind != "text":
            self.ids = None
        elif self.ids is not None:
            self.ids.add(name.text)

    def _mend(self, path: misfits.Path) -> None:
        """Leave out what stands at a path, or put something in its place."""
        group = str(path[0])
        inside = self.node.get(group)
        if inside is None:
            return
        place = path[1] if len(path) > 1 else None
        if inside.kind != "list" or not isinstance(place, int):
            misspelt = group not in World.__struct_fields__ and inside.kind in ("list", "map")
            if group in STAND_INS or misspelt:  # a number stands for nothing that has an id
                self.ids = None
            self.start_is_known &= group != "start"
            del self.node.entries[group]
            return
        entry = inside.items[place]
        key = str(path[2]) if len(path) > 2 else ""
        self._note(group, entry, key)
        if entry.kind == "map" and key in entry.entries:
            del entry.entries[key]
            return
        missing = {k: v for k, v in STAND_INS.get(group, {}).items() if k not in entry.entries}
        if entry.kind != "map" or not missing:
            inside.items.pop(place)
            return
        for name, value in missing.items():
            entry.entries[name] = (text_node(name, entry), of_data(value, entry))

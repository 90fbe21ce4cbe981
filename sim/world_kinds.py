"""What a world file leaves out of an object that is a thing of the catalogue, put in."""

from __future__ import annotations

from collections.abc import Mapping

from robot.errors import Problem
from robot.files.config import nearest
from robot.files.yaml_nodes import Node, of_data, text_node
from sim.palette import COLORS
from sim.things import catalogue
from sim.things.making import MOST_VARIANT, made

OWN = ("shape", "size_m", "mass_kg")
"""What a kind and a variant decide."""
PLAIN = {"category": "thing", "color": "gray", "shape": "box", "size_m": [0.1, 0.1, 0.1],
         "mass_kg": 1.0}  # fmt: skip
"""In place of what nobody knows of an unknown kind."""


def complete(world: Node) -> list[Problem]:
    """Fill in the objects of a file that have a kind, in place; returns what is wrong with them."""
    objects = world.get("objects")
    if objects is None or objects.kind != "list":
        return []
    entries = (entry for entry in objects.items if entry.kind == "map" and "kind" in entry.entries)
    return [problem for entry in entries for problem in _complete(entry)]


def _complete(entry: Node) -> list[Problem]:
    key, kind = entry.entries["kind"]
    problems: list[Problem] = []
    for name in OWN:
        if name in entry.entries:
            cure = "leave it out; every variant: N has its own"
            problems.append(entry.key(name).problem(f"a thing of a kind has its own {name}", cure))
            del entry.entries[name]
    if kind.text not in catalogue.kinds():
        cure = nearest(kind.text, list(catalogue.kinds()))
        problems.append(key.problem(f"unknown kind {kind.text!r}", cure))
        for name in ("kind", "variant"):
            entry.entries.pop(name, None)
        _put(entry, PLAIN)
        return problems
    thing = made(kind.text, _variant(entry.get("variant")), _color(entry.get("color")))
    _put(
        entry,
        {
            "category": thing.category,
            "color": thing.color,
            "shape": thing.shape,
            "size_m": list(thing.size_m),
            "mass_kg": round(thing.mass_kg, 4),
        },
    )
    return problems


def _put(entry: Node, values: Mapping[str, object]) -> None:
    for name, value in values.items():
        if name not in entry.entries:
            entry.entries[name] = (text_node(name, entry), of_data(value, entry))


def _variant(node: Node | None) -> int:
    """A number that is none is told of with the other types."""
    value = None if node is None or node.kind != "text" else node.value
    return value if isinstance(value, int) and 0 <= value <= MOST_VARIANT else 0


def _color(node: Node | None) -> str:
    return node.text if node is not None and node.text in COLORS else ""

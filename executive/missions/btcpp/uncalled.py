"""Trees of a file that the main one does not call: each is named, and its nodes are known ones."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from executive.missions.btcpp import leaves
from executive.missions.btcpp.nodes import KINDS, NODES
from executive.missions.btcpp.ports import OLDER
from executive.missions.btcpp.xml import Element
from executive.missions.problems import Problems
from robot.errors import ConfigError
from robot.files.config import nearest


def look_at(
    name: str, root: Element, trees: Mapping[str, Element], problems: Problems, *, older: bool
) -> str:
    """The note that a tree was left out; nodes in it that nobody knows go to `problems`.

    BehaviorTree.CPP refuses a file with an unknown node in any of its trees. What is known there
    and has no equivalent here hinders nobody in a tree that is not called: the note names it.

    Args:
        name: of the tree.
        root: of the file that is imported.
        trees: all there are, by name.
        problems: takes what is wrong.
        older: whether they are of format 3.
    """
    tree = trees[name]
    foreign: dict[str, None] = {}
    elements = [*tree.children]
    for element in elements:
        elements += element.children
        kind = element.attributes.get("ID", "") if element.tag in KINDS else element.tag
        kind = OLDER.get(kind, kind) if older else kind
        if kind in leaves.refused():
            foreign[kind] = None
            continue
        error = _wrong(element, kind, trees)
        if error is not None:
            problems.take_here(error)
    where = f"line {tree.line}"
    if tree.file != root.file:
        where = f"{Path(tree.file).name}, {where}"
    note = f"left out: {where}, the tree {name!r}, which nothing calls"
    return f"{note}; in it, without equivalent: {', '.join(foreign)}" if foreign else note


def _wrong(element: Element, kind: str, trees: Mapping[str, Element]) -> ConfigError | None:
    """What cannot be meant, whatever the values of ports are."""
    if kind == "SubTree":
        called = element.attributes.get("ID", "")
        text = f"there is no tree {called!r}"
        return None if called in trees else element.wrong(text, nearest(called, [*trees]))
    if kind in NODES or kind in leaves.table():
        return None
    known = sorted(NODES if element.children else leaves.table())
    what = kind if element.children else f"the leaf {kind!r}"
    return element.wrong(f"{what} has no equivalent", nearest(kind, known))

"""A snapshot as DOT, for those who have graphviz."""

from __future__ import annotations

from collections.abc import Sequence

from executive.journal.dumps.layout import LOOKS, NAME_CHARS, cut
from executive.journal.dumps.text import ASCII_MARKS
from executive.journal.snapshot import Shown
from robot.printable import printable_line

_SHAPES = {"sequence": "box", "selector": "octagon", "parallel": "parallelogram"}


def dot(roots: Sequence[Shown], *, title: str) -> str:
    """A digraph from left to right."""
    lines = [
        "digraph tree {",
        f"  label={quoted(title)}; rankdir=LR; nodesep=0.15;",
        '  node [style="rounded,filled", fontname="sans-serif", fontsize=11];',
    ]
    for root in roots:
        for _, shown in root.walk():
            lines.append(f"  n{shown.id} [{_attributes(shown)}];")
            lines += [f"  n{shown.id} -> n{child.id};" for child in shown.children]
    return "\n".join([*lines, "}"]) + "\n"


def _attributes(shown: Shown) -> str:
    look = LOOKS[shown.state]
    label = f"{ASCII_MARKS[shown.state]} {cut(shown.name, NAME_CHARS)}".strip()
    tip = f"{shown.kind}: {shown.state}{f', {shown.note}' if shown.note else ''}"
    pairs = {
        "label": label,
        "tooltip": tip,
        "shape": _SHAPES.get(shown.kind, "box"),
        "fillcolor": look.fill,
        "color": look.line,
        "fontcolor": look.text,
    }
    return ", ".join(f"{key}={quoted(value)}" for key, value in pairs.items())


def quoted(text: str) -> str:
    """A DOT string: neither quotes, nor escapes, nor line breaks of the text mean anything."""
    return '"' + printable_line(text).replace("\\", "\\\\").replace('"', '\\"') + '"'

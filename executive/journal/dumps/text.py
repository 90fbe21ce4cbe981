"""A snapshot as lines of text: what is done, what is being done, what comes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from executive.journal.snapshot import Shown
from executive.journal.tree import State
from robot.printable import printable_line

Style = Literal["unicode", "ascii", "colour"]

MARKS: dict[State, str] = {
    "waiting": "·", "running": "▸", "done": "✓", "failed": "✗", "stopped": "■",
}  # fmt: skip
ASCII_MARKS: dict[State, str] = {
    "waiting": " ", "running": ">", "done": "+", "failed": "x", "stopped": "#",
}  # fmt: skip
COLOURS: dict[State, str] = {
    "waiting": "2", "running": "1;33", "done": "32", "failed": "31", "stopped": "35",
}  # fmt: skip
"""How a terminal shows a state: parameters of the SGR sequence (ECMA-48)."""


def picture(roots: Iterable[Shown], *, style: Style = "unicode") -> str:
    """A snapshot as text, one line a node, with how long each has taken.

    What a terminal would obey is written out, so that no name can command it.
    """
    return "\n".join(_drawn(depth, shown, style) for root in roots for depth, shown in root.walk())


def _drawn(depth: int, shown: Shown, style: Style) -> str:
    marks = ASCII_MARKS if style == "ascii" else MARKS
    note = printable_line(shown.note)
    line = f"{marks[shown.state]} {printable_line(shown.name)}"
    tail = f": {note}" if note else ""
    tail += f"  ({shown.took_s:.1f} s)" if shown.took_s else ""
    if style == "ascii":
        line, tail = (text.encode("ascii", "replace").decode() for text in (line, tail))
    if style == "colour":
        line = f"\x1b[{COLOURS[shown.state]}m{line}\x1b[0m"
        tail = f"\x1b[2m{tail}\x1b[0m" if tail else ""
    return "  " * depth + line + tail
